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
    header = struct.pack(">II", len(kept[0]) // size, len(kept)) + header[8:]

    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    pixels = zlib.compress(b"".join(b"\0" + bytes(row) for row in kept), 9)
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


if __name__ == "__main__":
    main()
