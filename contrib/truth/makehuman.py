#!/usr/bin/env python3
"""Bake the bodies of data/sample/makehuman from MakeHuman's base mesh, with exact joints.

usage: makehuman.py FOLDER OUT

FOLDER  `src/mpfb/data` of MPFB 2, under CC0: base.obj, rigs/rig.mixamo.json, rigs/weights.mixamo.json, targets/*.target.gz
OUT     gets NAME.off, triangles of the skin alone, in metres, and NAME.json, where its joints are

A body is the base mesh and the sum of its targets. Its joints are the middles of the vertices that the rig names. Hands are posed
by linear blend skinning with the rig's weights. A mitten is the convex hull of the four fingers, a closed piece of its own.
Needs numpy and scipy.
"""

from __future__ import annotations

import gzip
import json
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation
from truth_file import Array, largest_distance, write_truth

RACES = ("african", "asian", "caucasian")
DIGITS = {"thumb": "Thumb", "index": "Index", "middle": "Middle", "ring": "Ring", "little": "Pinky"}
JOINTS = {
    "shoulder": "Arm",
    "elbow": "ForeArm",
    "wrist": "Hand",
    "hip": "UpLeg",
    "knee": "Leg",
    "ankle": "Foot",
}
METRES = 0.1  # the base mesh is in decimetres
CLOTH = 0.004  # how far a mitten is from the fingers, in metres


@dataclass(frozen=True)
class Plan:
    """What a body is made of."""

    sex: str
    age: str
    muscle: str = "average"  # or max, min
    weight: str = "average"
    hands: str = "as they are"  # or fists, spread, mittens


BODIES = {
    "baby": Plan("female", "baby"),
    "child": Plan("male", "child"),
    "heavy-woman": Plan("female", "young", weight="max"),
    "old-man": Plan("male", "old", weight="min"),
    "fists": Plan("male", "young", hands="fists"),
    "spread-fingers": Plan("female", "young", hands="spread"),
    "mittens": Plan("female", "old", hands="mittens"),
}


class Base:
    """The base mesh: vertices, the quadrangles of its skin, and which vertices each group of faces has."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        vertices: list[list[float]] = []
        self.groups: dict[str, set[int]] = {}
        skin: list[list[int]] = []
        group = ""
        for line in (folder / "base.obj").read_text(encoding="utf-8").splitlines():
            words = line.split()
            if line.startswith("v "):
                vertices.append([float(word) for word in words[1:4]])
            elif line.startswith("g "):
                group = words[1]
            elif line.startswith("f "):
                corners = [int(word.split("/")[0]) - 1 for word in words[1:]]
                self.groups.setdefault(group, set()).update(corners)
                if group == "body":
                    skin.append(corners)
        self.vertices = np.array(vertices)
        self.triangles = np.array([[f[0], f[i], f[i + 1]] for f in skin for i in range(1, len(f) - 1)])
        self.bones = self.by_bone("rig", "bones")
        self.weights = {bone: dict(rows) for bone, rows in self.by_bone("weights", "weights").items()}

    def by_bone(self, file: str, key: str) -> dict[str, Any]:
        """What a file of the rig for Mixamo says of each bone."""
        named = json.loads((self.folder / f"rigs/{file}.mixamo.json").read_text(encoding="utf-8"))[key]
        return {bone.removeprefix("mixamorig:"): said for bone, said in named.items()}

    def target(self, name: str) -> Array:
        """How far a target moves each vertex."""
        out = np.zeros_like(self.vertices)
        with gzip.open(self.folder / f"targets/{name}.target.gz", "rt", encoding="utf-8") as file:
            for line in file:
                if line.strip() and not line.startswith("#"):
                    vertex, *move = line.split()
                    out[int(vertex)] = [float(number) for number in move]
        return out

    def shaped(self, plan: Plan) -> Array:
        """The vertices of a body of all races alike, in metres."""
        out = self.vertices.copy()
        for race in RACES:
            out += self.target(f"{race}-{plan.sex}-{plan.age}") / len(RACES)
        out += self.target(f"universal-{plan.sex}-{plan.age}-{plan.muscle}muscle-{plan.weight}weight")
        return METRES * out

    def end_of(self, bone: str, end: str, vertices: Array) -> Array:
        """Where a bone's head or tail is."""
        rule = self.bones[bone][end]
        if rule["strategy"] == "CUBE":
            named = sorted(self.groups[rule["cube_name"]])
        else:
            named = rule["vertex_indices"] if rule["strategy"] == "MEAN" else [rule["vertex_index"]]
        return np.asarray(vertices[named].mean(axis=0))


@dataclass
class Pose:
    """Vertices and the places of bones, which turns carry along."""

    vertices: Array
    places: dict[str, Array]
    base: Base

    def turn(self, bones: list[str], axis: Array, degrees: float) -> None:
        """Turns the first of a chain of bones, and what hangs on it, about its head."""
        centre = self.places[bones[0]].copy()
        rotation = Rotation.from_rotvec(np.radians(degrees) * axis / np.linalg.norm(axis))
        share = np.zeros(len(self.vertices))
        for bone in bones:
            for vertex, weight in self.base.weights[bone].items():
                share[vertex] += weight
            if bone != bones[0]:
                self.places[bone] = centre + rotation.apply(self.places[bone] - centre)
        moved = centre + rotation.apply(self.vertices - centre)
        self.vertices = self.vertices + np.clip(share, 0, 1)[:, None] * (moved - self.vertices)


def digit_bones(side: str, digit: str) -> list[str]:
    return [f"{side}Hand{DIGITS[digit]}{n}" for n in (1, 2, 3)]


def palm_axes(places: dict[str, Array], side: str) -> tuple[Array, Array]:
    """Along the knuckles from the little finger to the index, and out of the palm."""
    knuckle = {digit: places[digit_bones(side, digit)[0]] for digit in DIGITS}
    across = knuckle["index"] - knuckle["little"]
    along = knuckle["middle"] - places[f"{side}Hand"]
    out_of_palm = np.cross(across, along) * (-1 if side == "Left" else 1)
    return across, out_of_palm


def bend_fingers(pose: Pose, side: str) -> None:
    """A fist: fingers curled into the palm, the thumb beside them."""
    across, out_of_palm = palm_axes(pose.places, side)
    for digit in ("index", "middle", "ring", "little"):
        bones = digit_bones(side, digit)
        hinge = np.cross(pose.places[bones[1]] - pose.places[bones[0]], out_of_palm)
        for n, degrees in enumerate((65, 85, 55)):
            pose.turn(bones[n:], hinge, degrees)
    bones = digit_bones(side, "thumb")
    thumb = pose.places[bones[2]] - pose.places[bones[0]]
    pose.turn(bones, np.cross(thumb, out_of_palm - 0.4 * across / np.linalg.norm(across)), 25)
    pose.turn(bones[1:], np.cross(pose.places[bones[2]] - pose.places[bones[1]], -across), 25)


def spread_fingers(pose: Pose, side: str) -> None:
    across, out_of_palm = palm_axes(pose.places, side)
    for digit, degrees in (("index", 12), ("ring", -9), ("little", -18)):
        bones = digit_bones(side, digit)
        along = pose.places[bones[1]] - pose.places[bones[0]]
        pose.turn(bones, np.cross(along, across), degrees)


def mitten(pose: Pose, side: str) -> tuple[Array, npt.NDArray[np.int64]]:
    """The convex hull of the four fingers, a little away from these."""
    named: set[int] = set()
    for digit in ("index", "middle", "ring", "little"):
        for bone in digit_bones(side, digit):
            named |= {v for v, w in pose.base.weights[bone].items() if w > 0.5}
    skin = sorted(named & pose.base.groups["body"])
    places = pose.vertices[skin]
    directions = Rotation.random(60, random_state=1).apply(np.array([CLOTH, 0, 0]))
    around = np.vstack([places + direction for direction in directions])
    hull = ConvexHull(around)
    corners = {v: i for i, v in enumerate(hull.vertices)}
    faces = np.array([[corners[v] for v in face] for face in hull.simplices])
    out = around[hull.vertices]
    middle = out.mean(axis=0)
    for face in faces:
        a, b, c = out[face]
        if np.dot(np.cross(b - a, c - a), a - middle) < 0:
            face[1], face[2] = face[2], face[1]
    return out, faces


def bake(
    base: Base, plan: Plan
) -> tuple[Array, npt.NDArray[np.int64], dict[str, dict[str, Array]], dict[str, list[str]]]:
    """Vertices, triangles, joints by kind, and which digits are one with others."""
    vertices = base.shaped(plan)
    places = {bone: base.end_of(bone, "head", vertices) for bone in base.bones}
    top = base.end_of("Head", "tail", vertices)
    pose = Pose(vertices, places, base)
    for side in ("Left", "Right"):
        if plan.hands == "fists":
            bend_fingers(pose, side)
        if plan.hands == "spread":
            spread_fingers(pose, side)
    used = np.unique(base.triangles)
    row = np.full(len(vertices), -1)
    row[used] = np.arange(len(used))
    out, faces = pose.vertices[used], row[base.triangles]
    fused: dict[str, list[str]] = {}
    if plan.hands == "mittens":
        for side in ("Left", "Right"):
            more, around = mitten(pose, side)
            faces = np.vstack([faces, around + len(out)])
            out = np.vstack([out, more])
            fused[f"{side.lower()}_index_1"] = ["middle", "ring", "little"]
    joints: dict[str, Array] = {}
    fingers: dict[str, Array] = {}
    toes: dict[str, Array] = {}
    markers: dict[str, Array] = {"head": top}
    for side in ("Left", "Right"):
        for joint, bone in JOINTS.items():
            joints[f"{side.lower()}_{joint}"] = pose.places[f"{side}{bone}"]
        for joint in ("shoulder", "elbow", "knee"):
            markers[f"{side.lower()}_{joint}"] = joints[f"{side.lower()}_{joint}"]
        markers[f"{side.lower()}_hand"] = pose.places[f"{side}HandMiddle1"]
        markers[f"{side.lower()}_foot"] = pose.places[f"{side}ToeBase"]
        for digit in DIGITS:
            for n, bone in enumerate(digit_bones(side, digit), 1):
                fingers[f"{side.lower()}_{digit}_{n}"] = pose.places[bone]
        for toe in range(1, 6):
            for n in (1, 2):
                cube = sorted(base.groups[f"joint-{side[0].lower()}-toe-{toe}-{n}"])
                toes[f"{side.lower()}_toe{toe}_{n}"] = pose.vertices[cube].mean(axis=0)
    return out, faces, {"joints": joints, "markers": markers, "fingers": fingers, "toes": toes}, fused


def write_off(path: Path, vertices: Array, faces: npt.NDArray[np.int64]) -> None:
    lines = ["OFF", f"{len(vertices)} {len(faces)} 0"]
    lines += [" ".join(f"{number:.4f}".rstrip("0").rstrip(".") for number in place) for place in vertices]
    lines += [f"3 {a} {b} {c}" for a, b, c in faces]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def main() -> None:
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    base, out = Base(Path(sys.argv[1])), Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    for name, plan in BODIES.items():
        vertices, faces, places, fused = bake(base, plan)
        write_off(out / f"{name}.off", vertices, faces)
        write_truth(
            out / f"{name}.json",
            f"{name}.off",
            largest_distance(vertices, faces),
            "the joints of MakeHuman's rig for Mixamo, CC0",
            places["joints"],
            places["markers"],
            {"fingers": places["fingers"], "toes": places["toes"]},
            fused,
        )


if __name__ == "__main__":
    main()
