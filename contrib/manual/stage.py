#!/usr/bin/env python3
"""Stages the manual's sources: docs/, with the options that the program tells and the figures that it draws.

stage.py PROGRAM DOCS OUT
"""

from __future__ import annotations

import json
import math
import shutil
import struct
import subprocess
import sys
import zlib
from pathlib import Path

MARK = "<!-- options -->"


def run(program: Path, *arguments: object) -> None:
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, arguments))}: {done.stderr}")


def fill_options(program: Path, pages: Path, work: Path) -> None:
    """Puts each command's options where its page has the mark."""
    run(program, "documentation", work)
    told = {page.name for page in (work / "commands").glob("*.md")}
    written = {page.name for page in pages.glob("*.md")}
    # synth and view are commands of some builds only.
    if told - written or written - told - {"synth.md", "view.md"}:
        sys.exit(f"pages of commands that there are not, or commands without a page: {told ^ written}")
    for name in sorted(written):
        page = pages / name
        text = page.read_text(encoding="utf-8")
        if text.count(MARK) != 1:
            sys.exit(f"{page} has no mark {MARK}")
        options = work / "commands" / name
        there = options.read_text(encoding="utf-8") if options.exists() else "This build has no such command.\n"
        page.write_text(text.replace(MARK, there), encoding="utf-8")


def reduced(curve: dict) -> str:
    """A curve's ends and junctions, joined by straight lines, as OBJ."""
    edges = [(edge[0], edge[1]) for edge in curve["edges"]]
    near: dict[int, list[int]] = {}
    for a, b in edges:
        near.setdefault(a, []).append(b)
        near.setdefault(b, []).append(a)
    kept = sorted(node for node, others in near.items() if len(others) != 2)
    lines = set()
    for node in kept:
        for following in near[node]:
            last, at = node, following
            while len(near[at]) == 2:
                last, at = at, next(other for other in near[at] if other != last)
            lines.add((min(node, at), max(node, at)))
    number = {node: i + 1 for i, node in enumerate(kept)}
    places = [curve["nodes"][node] for node in kept]
    text = "".join("v {} {} {}\n".format(*place) for place in places)
    return text + "".join(f"l {number[a]} {number[b]}\n" for a, b in sorted(lines))


def draw_stages(program: Path, body: Path, out: Path, work: Path) -> None:
    """A figure for each stage of the method, of the sample body."""
    out.mkdir(parents=True, exist_ok=True)
    skeleton, curve = work / "body.json", work / "curve.json"
    run(program, "extract", body, "-o", skeleton)
    run(program, "curve", body, "-o", curve)
    document = json.loads(curve.read_text(encoding="utf-8"))
    (work / "reduced.obj").write_text(reduced(document), encoding="utf-8")
    # The surface alone: a curve too short to be seen.
    place = document["nodes"][0]
    beside = [place[0] + 1e-6 * math.dist(place, [0, 0, 0]), *place[1:]]
    (work / "none.obj").write_text("v {} {} {}\nv {} {} {}\nl 1 2\n".format(*place, *beside), encoding="utf-8")
    joints = json.loads(skeleton.read_text(encoding="utf-8"))["joints"]
    (work / "joints.json").write_text(
        json.dumps({"joints": {joint["name"]: joint["position"] for joint in joints}}), encoding="utf-8"
    )
    drawn = {  # stage: its curve, and its crosses
        "1-surface": (work / "none.obj", None),
        "2-curve": (curve, None),
        "3-embedding": (work / "reduced.obj", None),
        "4-refinement": (curve, work / "joints.json"),
    }
    for name, (line, crosses) in drawn.items():
        # A mesh in a folder is shown without a skeleton where the folder of skeletons has none: in a frame, with a caption.
        stage = work / name
        for kind, file in (("mesh", body), ("curve", line), ("truth", crosses), ("skeleton", None)):
            (stage / kind).mkdir(parents=True)
            if file:
                shutil.copy(file, stage / kind / ("body" + file.suffix))
        arguments = ["--skeleton", stage / "skeleton", "--curve", stage / "curve", "--size", "300x420"]
        if crosses:
            arguments += ["--truth", stage / "truth"]
        run(program, "render", stage / "mesh", *arguments, "--view", "three-quarter", "-o", stage / "framed.png")
        cut(stage / "framed.png", out / f"{name}.png", margin=8, caption=40)
    run(program, "render", body, "--size", "284x362", "-o", out / "5-symmetry.png")
    options = ["--size", "520x420", "--view", "three-quarter", "--names"]
    run(program, "render", body, *options, "-o", out / "6-anatomy.png")
    stages = ["1-surface", "2-curve", "3-embedding", "4-refinement", "5-symmetry"]
    strip([out / f"{stage}.png" for stage in stages], out / "all.png")


Mesh = tuple[list[list[float]], list[list[int]]]


def read_off(file: Path) -> Mesh:
    words = file.read_text(encoding="utf-8").split()[1:]
    vertices, faces = int(words[0]), int(words[1])
    numbers = words[3:]
    faces_from = 3 * vertices
    return (
        [[float(word) for word in numbers[i : i + 3]] for i in range(0, faces_from, 3)],
        [[int(word) for word in numbers[i + 1 : i + 4]] for i in range(faces_from, faces_from + 4 * faces, 4)],
    )


def write_off(mesh: Mesh, file: Path) -> None:
    vertices, faces = mesh
    lines = ["OFF", f"{len(vertices)} {len(faces)} 0", *(" ".join(map(repr, vertex)) for vertex in vertices)]
    lines += ["3 " + " ".join(map(str, face)) for face in faces]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")


def turned(mesh: Mesh, degrees: float) -> Mesh:
    """A mesh turned about an axis that slants, as a scanner may have it."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    about_x = [(x, c * y - s * z, s * y + c * z) for x, y, z in mesh[0]]
    return [[c * x - s * y, s * x + c * y, z] for x, y, z in about_x], mesh[1]


def ring(mesh: Mesh, place: list[float], normal: list[float]) -> list[list[list[float]]]:
    """The segments in which a plane cuts a mesh, of the loop that is the nearest to the place."""
    vertices, faces = mesh
    heights = [sum(n * (x - p) for n, x, p in zip(normal, vertex, place)) for vertex in vertices]
    places: dict[tuple[int, int], list[float]] = {}
    beside: dict[tuple[int, int], list[tuple[int, int]]] = {}
    for face in faces:
        cut_edges = []
        for a, b in zip(face, face[1:] + face[:1]):
            if (heights[a] < 0) != (heights[b] < 0):
                edge = (min(a, b), max(a, b))
                t = heights[edge[0]] / (heights[edge[0]] - heights[edge[1]])
                places[edge] = [x + t * (y - x) for x, y in zip(vertices[edge[0]], vertices[edge[1]])]
                cut_edges.append(edge)
        if len(cut_edges) == 2:
            beside.setdefault(cut_edges[0], []).append(cut_edges[1])
            beside.setdefault(cut_edges[1], []).append(cut_edges[0])
    loops, seen = [], set()
    for start in beside:
        loop, waiting = [], [start]
        while waiting:
            edge = waiting.pop()
            if edge not in seen:
                seen.add(edge)
                loop.append(edge)
                waiting += beside[edge]
        if loop:
            loops.append(loop)

    def away(loop: list[tuple[int, int]]) -> float:
        return math.dist([sum(places[edge][i] for edge in loop) / len(loop) for i in range(3)], place)

    nearest = min(loops, key=away)
    return [[places[edge], places[other]] for edge in nearest for other in beside[edge] if edge < other]


def rings(mesh: Mesh, measures: dict) -> str:
    """Where a tape lies, of each girth, as lines of OBJ."""
    segments = [
        part for plane in measures["girth_places"].values() for part in ring(mesh, plane["place"], plane["normal"])
    ]
    text = "".join("v {} {} {}\n".format(*end) for part in segments for end in part)
    return text + "".join(f"l {2 * i + 1} {2 * i + 2}\n" for i in range(len(segments)))


def draw_commands(program: Path, sample: Path, out: Path, work: Path) -> None:
    """A picture for each command whose work is seen on the sample body."""
    out.mkdir(parents=True, exist_ok=True)
    body, clip = sample / "body.off", sample / "walk.bvh"

    def folder(name: str) -> Path:
        (work / name).mkdir()
        return work / name

    def sheet(name: str, meshes: Path, *options: object) -> None:
        run(program, "render", meshes, "-o", out / f"{name}.png", "--size", "300x420", *options)

    nothing = folder("nothing")

    def bare(name: str, meshes: Path, *options: object) -> None:
        """Without skeletons, which the sheet of each says by a frame and a caption: these are cut off."""
        pictures = []
        for mesh in sorted(meshes.iterdir()):
            alone = folder(f"{name}-{mesh.stem}")
            shutil.copy(mesh, alone)
            framed = work / f"{name}-{mesh.stem}.png"
            view = ["--size", "300x420", "--view", "three-quarter"]
            run(program, "render", alone, "--skeleton", nothing, "-o", framed, *view, *options)
            cut(framed, framed, margin=8, caption=40)
            pictures.append(framed)
        strip(pictures, out / f"{name}.png")

    shown = folder("align")
    write_off(turned(read_off(body), 50), shown / "as-it-lies.off")
    run(program, "align", shown / "as-it-lies.off", "-q", "-o", work / "aligned")
    shutil.copy(work / "aligned/as-it-lies.off", shown / "turned.off")
    sheet("align", shown, "--view", "0.3,0.2,1")

    shown = folder("convert")
    run(program, "animate", body, "--clip", clip, "-q", "-o", work / "walk.glb")
    for moment in ("0", "0.3", "0.6", "0.9"):
        options = ["--animation", "1", "--time", moment]
        run(program, "convert", work / "walk.glb", shown / f"at-{moment}-s.off", *options)
    bare("convert", shown)

    shown = folder("pose")
    posed = shown / "frame-18.off"
    shutil.copy(body, shown / "as-it-is.off")
    run(program, "pose", body, "--clip", clip, "--frame", 18, "-q", "-o", posed)
    sheet("pose", shown, "--view", "three-quarter")

    run(program, "correspond", body, posed, "-q", "-o", work / "map.json", "--ply", folder("like"))
    bare("correspond", work / "like")

    run(program, "measure", body, "-o", work / "measures.json")
    (work / "rings.obj").write_text(
        rings(read_off(body), json.loads((work / "measures.json").read_text(encoding="utf-8"))["bodies"][0]),
        encoding="utf-8",
    )
    for kind, file in (("girths", body), ("girth-lines", work / "rings.obj")):
        shutil.copy(file, folder(kind) / ("girths" + file.suffix))
    bare("measure", work / "girths", "--curve", work / "girth-lines")

    run(program, "render", body, "--truth", sample / "body.json", "--size", "300x420", "-o", out / "evaluate.png")


def strip(pictures: list[Path], out: Path) -> None:
    """Pictures of one kind side by side, as high as the lowest."""
    parts = [pixel_rows(picture.read_bytes()) for picture in pictures]
    header, size, height = parts[0][0], parts[0][2], min(len(rows) for _, rows, _ in parts)
    write_png([bytearray().join(rows[y] for _, rows, _ in parts) for y in range(height)], header, size, out)


def pixel_rows(data: bytes) -> tuple[bytes, list[bytearray], int]:
    """The header of a PNG with eight bits a channel, its rows of pixels, and bytes a pixel."""
    at, header, packed = 8, b"", b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        chunk = data[at + 8 : at + 8 + length]
        header = chunk if kind == b"IHDR" else header
        packed += chunk if kind == b"IDAT" else b""
        at += length + 12
    width, height, depth, colour = struct.unpack(">IIBB", header[:10])
    if depth != 8 or colour not in (2, 6) or header[12]:
        sys.exit("a picture is not as the program writes it")
    size = 3 if colour == 2 else 4
    raw, stride = zlib.decompress(packed), width * size
    rows, above = [], bytearray(stride)
    for y in range(height):
        start = y * (stride + 1)
        way, row = raw[start], bytearray(raw[start + 1 : start + 1 + stride])
        for x in range(stride):
            left = row[x - size] if x >= size else 0
            corner = above[x - size] if x >= size else 0
            guess = left + above[x] - corner
            paeth = min((left, above[x], corner), key=lambda value: abs(guess - value))
            row[x] = (row[x] + (0, left, above[x], (left + above[x]) // 2, paeth)[way]) & 255
        rows.append(row)
        above = row
    return header, rows, size


def cut(source: Path, target: Path, margin: int, caption: int) -> None:
    """A picture without its margin, and without what is written below it."""
    header, rows, size = pixel_rows(source.read_bytes())
    kept = [row[margin * size : len(row) - margin * size] for row in rows[margin : len(rows) - margin - caption]]
    write_png(kept, header, size, target)


def write_png(rows: list[bytearray], header: bytes, size: int, target: Path) -> None:
    """Rows of pixels of so many bytes each, with the kind of colours that a header has."""
    header = struct.pack(">II", len(rows[0]) // size, len(rows)) + header[8:]

    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    pixels = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 9)
    target.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b""))


def main() -> None:
    program, docs, out = (Path(argument).resolve() for argument in sys.argv[1:4])
    work = out.parent / "work"
    for folder in (out, work):
        shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(docs, out)
    work.mkdir(parents=True)
    fill_options(program, out / "commands", work)
    draw_stages(program, docs.parent / "data/sample/body.off", out / "stages", work)
    draw_commands(program, docs.parent / "data/sample", out / "commands", work)


if __name__ == "__main__":
    main()
