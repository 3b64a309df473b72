#!/usr/bin/env python3
"""Runs every command that README.md and the manual show, in a folder that has the files they name.

run_manual.py PROGRAM SOURCES ANIMAL: what stands in `console` blocks below `$ skelgen ...` must be printed (`...`: anything),
and every command must end well unless a line of it is an error. Of `sh` blocks the lines that begin with skelgen are run.
Commands of parts that the program was built without are left out. ANIMAL is a mesh of one with four legs.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

BODIES = ["body.glb", "body.ply", "scan.ply", "walker.ply", "child.ply", "adult.obj", "template.obj"]
TEAPOT = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"


def shell(place: Path, line: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(["bash", "-c", line], cwd=place, capture_output=True, text=True, timeout=600)


def prepare(place: Path, program: Path, root: Path, animal: Path) -> None:
    """The files that the pages' commands take, made of the sample body and the animal."""
    sample = root / "data/sample"
    (place / "data").mkdir()
    shutil.copytree(sample, place / "data/sample")
    for name in ("body.off", "walk.bvh"):
        shutil.copy(sample / name, place)
    shutil.copy(root / "data/templates/human21.json", place / "mine.json")
    (place / "teapot.off").write_text(TEAPOT)
    for name in ("scans", "truth"):
        (place / name).mkdir()
    lines = [f"{program} convert body.off {name}" for name in BODIES]
    lines += [f"{program} animate body.off --clip walk.bvh -q -o walk.glb"]
    lines += [f"{program} convert body.off scans/{name}.ply" for name in ("a", "b")]
    lines += [f"{program} extract body.off -q -o body.json"]
    for line in lines:
        done = shell(place, line)
        if done.returncode:
            sys.exit(f"{line}: {done.stderr}")
    for name in ("fox.off", "running_fox.off"):
        shutil.copy(animal, place / name)
    for name in ("runner.off", "sitter.off", "dragon.glb"):  # where there is no synth
        source = "body.glb" if name.endswith("glb") else "body.off"
        shutil.copy(place / source, place / name)
    for name in ("a", "b"):
        shutil.copy(sample / "body.json", place / f"truth/{name}.json")


def commands(page: Path) -> list[tuple[str, list[str]]]:
    """Each command of a page with the lines that it prints; none where these are not shown."""
    found: list[tuple[str, list[str]]] = []
    text = page.read_text(encoding="utf-8")
    for indent, kind, block in re.findall(r"^( *)```(sh|console)\n(.*?)^\1```", text, re.DOTALL | re.MULTILINE):
        for raw in block.splitlines():
            line = raw.removeprefix(indent)
            if kind == "console" and line.startswith("$ "):
                found.append((line[2:], []))
            elif kind == "console":
                if not found:
                    sys.exit(f"{page}: a console block begins with no command")
                found[-1][1].append(line)
            elif line.startswith("skelgen ") and "shards/" not in line:  # those are run where their shards are written
                found.append((line, ["..."]))
    # Within a line, as the text of tables has them.
    found += [
        (" ".join(line.split()), ["..."]) for line in re.findall(r"`(skelgen \w+ [^`]+\.(?:glb|fbx|vrm|json))`", text)
    ]
    return found


def fault(line: str, expected: list[str], done: subprocess.CompletedProcess[str]) -> str:
    printed = (done.stderr + done.stdout).strip()
    if any(text.startswith("skelgen: error: ") for text in expected):
        if done.returncode not in (3, 4):
            return f"ends with {done.returncode} and should fail"
    elif done.returncode:
        return f"ends with {done.returncode}: {printed}"
    pattern = re.escape("\n".join(expected).strip()).replace(re.escape("..."), ".*")
    if not re.fullmatch(pattern, printed, re.DOTALL):
        return "prints\n" + printed + "\nand should print\n" + "\n".join(expected)
    return ""


def check(page: Path, prepared: Path, program: Path, root: Path, parts: set[str], left_out: list[str]) -> list[str]:
    """What is wrong with the commands of a page."""
    faults = []
    lines = [each for each in commands(page) if each[0].split()[1] in parts or each[0].split()[1].startswith("-")]
    left_out += [line for line, _ in commands(page) if (line, _) not in lines]
    if not lines:
        return faults
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "work"
        shutil.copytree(prepared, place)
        bin_folder = place / ".bin"
        bin_folder.mkdir()
        (bin_folder / "skelgen").symlink_to(program)
        for line, expected in lines:
            done = shell(place, f"PATH={bin_folder}:$PATH; {line}")
            if wrong := fault(line, expected, done):
                faults.append(f"{page.relative_to(root)}: {line}: {wrong}")
            RUN.append(line)
    return faults


RUN: list[str] = []


def main() -> int:
    program, root, animal = (Path(argument).resolve() for argument in sys.argv[1:])
    help_text = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    parts = set(
        re.findall(
            r"^  ([a-z]+) ", help_text[help_text.index("Subcommands:") : help_text.index("Example:")], re.MULTILINE
        )
    )
    pages = [root / "README.md", *sorted((root / "docs").rglob("*.md"))]
    left_out: list[str] = []
    faults: list[str] = []
    with tempfile.TemporaryDirectory() as prepared, ThreadPoolExecutor(os.cpu_count()) as pool:
        prepare(Path(prepared), program, root, animal)
        for found in pool.map(lambda page: check(page, Path(prepared), program, root, parts, left_out), pages):
            faults += found
    shown = {page.stem for page in (root / "docs/commands").glob("*.md")}
    used = {line.split()[1] for line in RUN}
    faults += [f"no page shows an example of {name}" for name in sorted(parts - used)]
    faults += [f"there is no page on {name}" for name in sorted(parts - shown)]
    print(f"{len(RUN)} commands run, {len(left_out)} left out: this program is built without their parts")
    for line in faults:
        print(line, file=sys.stderr)
    return 1 if faults or not RUN else 0


if __name__ == "__main__":
    sys.exit(main())
