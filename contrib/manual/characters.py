#!/usr/bin/env python3
"""How many rigged characters get a usable skeleton, and how much of what is no body is refused.

characters.py PROGRAM FOLDER [--jobs N]

FOLDER/truth/NAME.json says which mesh in FOLDER/files or FOLDER/meshes it is of (`file` or `mesh`), and what is to be found.
Keys are `expect` (`body`, `either` or `refuse`), `scale` (the largest extent), `joints`, `markers`. A mesh that has to be posed has
an `animation` with `name` and `time`.

A skeleton is usable when its limbs and sides are the rig's, the median of its joints' errors is at most 0.04 of the extent and none
is above 0.12. Of what may be `either` nothing is counted. What is no body is right where it is refused, or answered
below a confidence of 0.5 with a warning.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from math import dist
from pathlib import Path

ENDS = ("left_hand", "right_hand", "left_foot", "right_foot", "head")
PAIRS = ("hand", "foot", "elbow", "knee", "shoulder")


def judge(truth: dict, found: dict) -> tuple[bool, float]:
    """Whether a skeleton is usable, and the mean error of its joints."""
    scale, markers, joints = truth["scale"], truth["markers"], truth["joints"]
    places = {joint["name"]: joint["position"] for joint in found["joints"] if joint.get("position")}
    # A rig without knuckles or toes has its hand or foot marked where its wrist or ankle is.
    for side in ("left_", "right_"):
        for end, joint in (("hand", "wrist"), ("foot", "ankle")):
            marked = markers.get(side + end), joints.get(side + joint)
            if None not in marked and dist(*marked) < 1e-6 * scale and side + joint in places:
                places[side + end] = places[side + joint]

    def apart(name: str, marker: str) -> float:
        return dist(places[name], markers[marker]) / scale if name in places else 1.0

    limbs = all(
        apart(end, end) <= (0.2 if end == "head" else 0.15) and all(apart(end, end) <= apart(end, other) for other in ENDS if other in markers)
        for end in ENDS
        if end in markers
    )
    sides = all(
        apart(f"{side}_{part}", f"{side}_{part}") < apart(f"{side}_{part}", f"{other}_{part}")
        for part in PAIRS
        for side, other in (("left", "right"), ("right", "left"))
        if f"{side}_{part}" in markers and f"{other}_{part}" in markers
    )
    errors = [dist(places[name], place) / scale if name in places else 1.0 for name, place in joints.items()]
    usable = limbs and sides and statistics.median(errors) <= 0.04 and max(errors) <= 0.12
    return usable, statistics.mean(errors)


def extract(program: Path, folder: Path, truth: dict) -> dict | None:
    """The skeleton of the mesh that a truth is of; none where it is refused or takes more than two minutes."""
    file = truth.get("file") or truth["mesh"]
    mesh = next(folder / meshes / file for meshes in ("files", "meshes") if (folder / meshes).is_dir())
    command = [program, "extract", mesh, "-q", "-o", "-"]
    if animation := truth.get("animation"):
        command += ["--animation", animation["name"], "--time", animation["time"]]
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=120)
    except subprocess.TimeoutExpired:
        return None
    if done.returncode not in (0, 3, 4):
        sys.exit(f"{mesh}: {done.stderr}")
    return json.loads(done.stdout) if done.returncode == 0 else None


def score(program: Path, folder: Path, jobs: int) -> dict:
    """Counts, as (so many, of so many), and lists of names."""
    truths = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in sorted((folder / "truth").glob("*.json"))}
    with ThreadPoolExecutor(jobs) as pool:
        found = dict(zip(truths, pool.map(lambda truth: extract(program, folder, truth), truths.values())))
    judged: dict[str, tuple[bool, float]] = {}  # answered ones that have a rig
    answered = {True: [0, 0], False: [0, 0]}  # with a rig, and bodies without
    refused, sure, unusable = [0, 0], [], []
    above = [0, 0]
    for name, truth in truths.items():
        quality = (found[name] or {}).get("quality", {})
        confidence = quality.get("sides_confidence", 0)
        if truth["expect"] == "refuse":
            right = found[name] is None or (confidence < 0.5 and bool(quality.get("warnings")))
            refused[0] += right
            refused[1] += 1
        elif truth["expect"] == "either":
            continue
        else:
            rigged = bool(truth.get("joints"))
            answered[rigged][0] += found[name] is not None
            answered[rigged][1] += 1
            right = not rigged
            if found[name] is not None and rigged:
                judged[name] = judge(truth, found[name])
                right = judged[name][0]
                above[0] += right and confidence > 0.8
                above[1] += confidence > 0.8
            if not right:
                unusable.append(name)
        if found[name] is not None and not right and confidence > 0.8:
            sure.append(name)
    good = [error for usable, error in judged.values() if usable]
    return {
        "usable": (len(good), answered[True][1]),
        "mean_error": statistics.mean(good) if good else None,
        "answered": tuple(answered[True]),
        "answered_without_rig": tuple(answered[False]),
        "refused": tuple(refused),
        "usable_above_0.8": tuple(above),
        "wrong_and_sure": sure,
        "unusable": unusable,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description="How many rigged characters get a usable skeleton.")
    parser.add_argument("program", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    options = parser.parse_args()
    print(json.dumps(score(options.program, options.folder, options.jobs), indent=1))


if __name__ == "__main__":
    main()
