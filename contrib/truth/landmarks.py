#!/usr/bin/env python3
"""Truth files of SCAPE's and PSB's bodies, by landmarks on their surfaces: of your own copies of both.

landmarks.py MESHES LANDMARKS -o TRUTH [--names FILE]: LANDMARKS holds for each mesh a text file of its name with a line for each
landmark: a vertex (counted from 0), or x y z, with the landmark's name before it or in the order of NAMES (--names has others, a
line each). A joint is the middle between two landmarks on opposite sides of it. Needs numpy, for PLY trimesh, too.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from truth_file import MARKERS, Array, largest_distance, read_mesh, write_truth

# The order in which the 36 landmarks of these bodies are given.
NAMES = """right_toe left_toe right_heel left_heel right_knee left_knee right_knee_in left_knee_in waist_right waist_left between_legs
right_finger left_finger right_elbow left_elbow right_elbow_in left_elbow_in right_shoulder_up left_shoulder_up right_shoulder_low
left_shoulder_low right_tit left_tit cornea cornea_back neck_front neck_back right_eye left_eye nose mouth right_ear left_ear
head_top right_hip_side left_hip_side""".split()

PAIRS = {"neck": ("neck_front", "neck_back"), "waist": ("waist_right", "waist_left")} | {
    f"{side}_{joint}": (f"{side}_{joint}{one}", f"{side}_{joint}{other}")
    for side in ("left", "right")
    for joint, one, other in (("shoulder", "_up", "_low"), ("elbow", "", "_in"), ("knee", "", "_in"))
}
ON_SURFACE = {
    "left_hand": "left_finger",
    "right_hand": "right_finger",
    "left_foot": "left_toe",
    "right_foot": "right_toe",
}


def read_landmarks(path: Path, vertices: Array, names: list[str]) -> dict[str, Array]:
    found: dict[str, Array] = {}
    lines = [line.split() for line in path.read_text(encoding="utf-8").splitlines() if line.strip() and line[0] != "#"]
    for number, words in enumerate(lines):
        name = words.pop(0) if not words[0].lstrip("+-.").replace(".", "")[:1].isdigit() else None
        if name is None:
            if number >= len(names):
                raise SystemExit(f"{path}: line {number + 1} is one more than there are names: give them by --names")
            name = names[number]
        if len(words) not in (1, 3):
            raise SystemExit(f"{path}: line {number + 1} is neither a vertex nor x y z")
        if len(words) == 1 and not 0 <= int(words[0]) < len(vertices):
            raise SystemExit(f"{path}: line {number + 1} names a vertex that the mesh does not have")
        found[name] = vertices[int(words[0])] if len(words) == 1 else np.array(words, float)
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description="Makes truth files of bodies by landmarks on their surfaces.")
    parser.add_argument("meshes", type=Path)
    parser.add_argument("landmarks", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True, help="folder of truth files to write")
    parser.add_argument("--names", type=Path, help="names of the landmarks, a line each")
    options = parser.parse_args()
    names = options.names.read_text(encoding="utf-8").split() if options.names else NAMES
    count = 0
    for path in sorted(options.meshes.iterdir()):
        marks = [
            file for file in options.landmarks.glob(f"{path.stem}.*") if file.suffix.lower() not in (".off", ".ply")
        ]
        if path.suffix.lower() not in (".off", ".ply") or not marks:
            continue
        vertices, faces = read_mesh(path)
        there = read_landmarks(marks[0], vertices, names)
        joints = {
            name: (there[one] + there[other]) / 2
            for name, (one, other) in PAIRS.items()
            if one in there and other in there
        }
        markers = {name: there[mark] for name, mark in ON_SURFACE.items()} | {"head": there["head_top"]}
        markers |= {name: joints[name] for name in MARKERS if name in joints}
        source = "middles of landmarks on the surface"
        write_truth(
            options.output / f"{path.stem}.json", path.name, largest_distance(vertices, faces), source, joints, markers
        )
        count += 1
    if not count:
        raise SystemExit(f"{options.landmarks}: holds no landmarks of a mesh in {options.meshes}")
    print(f"{count} truth files in {options.output}")


if __name__ == "__main__":
    main()
