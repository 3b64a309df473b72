#!/usr/bin/python3
"""Fit the trust in a four-legged animal, and where its joints lie: quadruped/trust_table.hpp and joint_table.hpp.

usage: calibrate_quadruped.py FOLDER... [--tables FOLDER]

Each FOLDER holds truth/NAME.json and candidates/NAME.jsonl, as find_candidates.py --template quadruped writes the latter:
of every way to see an animal in a curve the evidence and the ways of its limbs. A way is RIGHT when each foot's and the
tail's end lies nearer to its own marker than to the others and within 0.12 of the scale, and the head's end within 0.26 of
the head's, nose's or crown's. People and things are wrong. The trust is fitted as calibrate.py fits that in people, each
mesh's right and wrong ways counting once together. What is printed is of folds by maker.
"""
import argparse
import collections
import json
import os

import numpy as np

import calibrate

FEET = ["left_fore_foot", "right_fore_foot", "left_hind_foot", "right_hind_foot"]
LEGS = ["left_fore_leg", "right_fore_leg", "left_hind_leg", "right_hind_leg"]
# Of each role and place among its joints: the way that it lies on, and the joint of a truth that has it.
PLACES = [
    ("pelvis", 0, "trunk", "hips"), ("waist", 0, "trunk", "spine1"), ("waist", 1, "trunk", "spine2"), ("chest", 0, "trunk", "chest"),
    ("neck", 0, "neck", "neck1"), ("neck", 1, "neck", "neck2"), ("head", 0, "neck", "head"), ("ear", 0, "neck", "ear"),
    ("shoulder_girdle", 0, "fore_leg", "fore_girdle"), ("shoulder", 0, "fore_leg", "fore_upper"), ("elbow", 0, "fore_leg", "fore_lower"),
    ("wrist", 0, "fore_leg", "fore_ankle"), ("hand", 0, "fore_leg", "fore_foot"),
    ("hip_girdle", 0, "hind_leg", "hind_girdle"), ("hip", 0, "hind_leg", "hind_upper"), ("knee", 0, "hind_leg", "hind_lower"),
    ("ankle", 0, "hind_leg", "hind_ankle"), ("foot", 0, "hind_leg", "hind_foot"),
    ("tail", 0, "tail", "tail1"), ("tail", 1, "tail", "tail2"), ("tail", 2, "tail", "tail3"), ("tail", 3, "tail", "tail4"),
]


def is_right(truth, row):
    places = {name: row["ways"][leg][0] for name, leg in zip(FEET, LEGS)}
    places["head"] = row["ways"]["neck"][-1]
    if row["ways"]["tail"]:
        places["tail"] = row["ways"]["tail"][-1]
    markers, joints = truth["markers"], truth.get("joints", {})
    ends = [e for e in FEET + ["head", "tail"] if e in markers]
    own = {e: [p[e] for p in (markers, joints) if e in p] for e in ends}
    own["head"] = own.get("head", []) + [markers[m] for m in ("nose", "head_top") if m in markers]
    for end in ends:
        if end not in places:
            return False
        far = {e: min(np.linalg.norm(np.subtract(places[end], p)) for p in own[e]) / truth["scale"] for e in ends}
        if min(far, key=far.get) != end or far[end] > (0.26 if end == "head" else 0.12):
            return False
    return True


class Mesh:
    """One mesh's ways to see an animal in it, as calibrate.Mesh has a person's candidates."""

    def __init__(self, folder, name, truth):
        self.name, self.truth = name, truth
        self.is_body = truth.get("expect") == "quadruped"
        source = str(truth.get("source", "")).split("@")[0].split(" ")[0]
        self.group = source if self.is_body and source else str(truth.get("group") or os.path.basename(folder) + ":" + name)
        self.rows = [json.loads(line) for line in open(f"{folder}/candidates/{name}.jsonl")]
        self.right = np.array([self.is_body and is_right(truth, row) for row in self.rows])
        self.evidence = np.array([list(row["evidence"].values()) for row in self.rows])
        self.errors = [{} for _ in self.rows]
        if not self.is_body:
            for row in self.rows:
                del row["ways"]


def balanced(used):
    """What each way counts: a mesh's right ones once together, its wrong ones, too."""
    return np.concatenate([np.where(m.right, 1 / max(m.right.sum(), 1), 1 / max((~m.right).sum(), 1)) for m in used])


def folds_of(meshes):
    """The fold of each mesh: makers of animals one by one, others at random."""
    makers = sorted({m.group for m in meshes if m.is_body})
    return [makers.index(m.group) if m.is_body else calibrate.fold_of(m.group, len(makers)) for m in meshes]


def by_folds(meshes, penalty, trees):
    folds, chosen = folds_of(meshes), [(-1, 0.0)] * len(meshes)
    for fold in set(folds):
        table = calibrate.fit([m for m, f in zip(meshes, folds) if f != fold], penalty, trees, 0, balanced)
        for k, m in enumerate(meshes):
            if folds[k] == fold and len(m.rows):
                p = calibrate.probability(table, m.evidence)
                chosen[k] = int(np.argmax(p)), float(p.max())
    return chosen


def scaling_of(meshes, chosen):
    """Factor and addend of the log odds of the likeliest way, from makers left out (Platt's scaling)."""
    rows = [(m, i, p) for m, (i, p) in zip(meshes, chosen) if i >= 0]
    x = np.array([[calibrate.log_odds(p), 1.0] for _, _, p in rows])
    y, beta = np.array([m.right[i] for m, i, _ in rows], float), np.array([1.0, 0.0])
    for _ in range(200):  # held to what it would be without: few meshes tell little
        p = calibrate.logistic(x @ beta)
        step = np.linalg.solve((x * (p * (1 - p))[:, None]).T @ x + np.eye(2), x.T @ (p - y) + beta - [1, 0])
        beta -= step * min(1.0, 0.2 / np.abs(step).max())
    print("log odds of the likeliest: times {:.3f}, plus {:.3f}".format(*beta))
    return beta


def place_on(way, place, frame, size, sign):
    """Share of the way, and forward, up and outward of it in sizes, of a place."""
    way = np.array(way)
    fine = np.array([way[min(int(s), len(way) - 2)] * (1 - (s - min(int(s), len(way) - 2))) + way[min(int(s), len(way) - 2) + 1] * (s - min(int(s), len(way) - 2)) for s in np.linspace(0, len(way) - 1, 101)])
    i = int(np.argmin(np.linalg.norm(fine - place, axis=1)))
    off = (np.array(place) - fine[i]) / size
    return [i / 100] + [float(off @ np.array(frame[d])) for d in ("forward", "up")] + [sign * float(off @ np.array(frame["left"]))]


def head_frame(row):
    """The directions at the head, as place_joints.hpp has them."""
    neck, left = np.array(row["ways"]["neck"]), np.array(row["frame"]["left"])
    forward = neck[-1] - neck[round(0.7 * (len(neck) - 1))]
    forward /= np.linalg.norm(forward) + 1e-12
    up = np.cross(forward, left)
    up /= np.linalg.norm(up) + 1e-12
    return {"forward": forward, "up": up, "left": np.cross(up, forward)}


def joint_places(meshes, chosen):
    """Per role and place the mean share and offsets over makers, each counting by the root of its animals."""
    found = collections.defaultdict(lambda: collections.defaultdict(list))
    for m, (i, _) in zip(meshes, chosen):
        if i < 0 or not m.right[i] or "joints" not in m.truth:
            continue
        row = m.rows[i]
        for role, ordinal, way, name in PLACES:
            for side, sign in (("left_", 1), ("right_", -1), ("", 0)):
                if side + name not in m.truth["joints"]:
                    continue
                place = np.array(m.truth["joints"][side + name])
                nodes = row["ways"][side + way if "leg" in way else way]
                if not nodes:
                    continue
                if role == "ear":
                    frame = head_frame(row)
                    off = (place - np.array(nodes[-1])) / row["size"]
                    value = [1.0] + [float(off @ frame[d]) for d in ("forward", "up")] + [sign * float(off @ frame["left"])]
                else:
                    value = place_on(nodes, place, row["frame"], row["size"], sign)
                found[role, ordinal][m.group].append(value)
    out = {}
    for key, makers in found.items():
        w = np.array([np.sqrt(len(v)) for v in makers.values()])
        out[key] = np.average([np.mean(v, axis=0) for v in makers.values()], axis=0, weights=w), sum(map(len, makers.values())), len(makers)
    return out


def write_trust(path, table, meshes):
    numbers = lambda values: ",\n    ".join(f"{v:.5g}" for v in values)
    rows, animals = sum(len(m.rows) for m in meshes), sum(m.is_body for m in meshes)
    with open(path, "w") as f:
        f.write(f"""// Written by `./dev calibrate`: what the probability that an animal is seen rightly is made of. No unit. Fitted on {rows}
// ways to see one in {animals} animals and {len(meshes) - animals} people and things; tests/calibration/calibrate_quadruped.py says how.
#pragma once

#include <array>

#include <skelgen/core/boosted_trees.hpp>
#include <skelgen/quadruped/limbs.hpp>

namespace skelgen::quadruped {{

inline constexpr double trust_offset = {table["offset"]:.5g};
inline constexpr std::array<double, witness_count> trust_weights{{
    {numbers(table["weights"])}}};
inline constexpr std::array<double, witness_count> trust_means{{
    {numbers(table["means"])}}};
inline constexpr std::array<core::QuestionTree, {len(table["trees"])}> trust_trees{{{{
    {calibrate.trees_text(table["trees"])}}}}};

}} // namespace skelgen::quadruped
""")


def write_joints(path, places):
    """Puts the numbers into the table's rows; the rest of the file stays."""
    lines = []
    for line in open(path):
        if line.strip().startswith("JointPlace{JointRole::"):
            role, ordinal, way = [word.strip() for word in line.split("JointRole::")[1].split(",")[:3]]
            if (role, int(ordinal)) in places:
                value = places[role, int(ordinal)][0]
                if role in ("pelvis", "waist", "chest", "neck", "head", "tail"):
                    value[3] = 0  # in the middle
                line = f"    JointPlace{{JointRole::{role}, {ordinal}, {way}, " + ", ".join(f"{v:.3g}" for v in value) + "},\n"
        lines.append(line)
    open(path, "w").writelines(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--tables", help="folder of the tables to write: include/skelgen/quadruped")
    parser.add_argument("--penalty", type=float, default=8.0)
    parser.add_argument("--trees", type=int, default=100)
    a = parser.parse_args()
    meshes = []
    for folder in a.folders:
        for file in sorted(os.listdir(folder + "/truth")):
            truth = json.load(open(f"{folder}/truth/{file}"))
            if os.path.exists(f"{folder}/candidates/{file[:-5]}.jsonl") and truth.get("expect") != "either" and truth.get("style") != "quadruped":  # animals without truth
                meshes.append(Mesh(folder, file[:-5], truth))
    chosen = by_folds(meshes, a.penalty, a.trees)
    scaling = scaling_of(meshes, chosen)
    scaled = [(i, float(calibrate.logistic(scaling[0] * calibrate.log_odds(p) + scaling[1])) if i >= 0 else 0.0) for i, p in chosen]
    calibrate.report(meshes, scaled)
    print("wrong:", [(m.name, round(p, 2)) for m, (i, p) in zip(meshes, scaled) if m.is_body and (i < 0 or not m.right[i])])
    table = calibrate.fit(meshes, a.penalty, a.trees, 0, balanced)
    table["offset"] = scaling[0] * table["offset"] + scaling[1]
    table["weights"] = scaling[0] * table["weights"]
    table["trees"] = [{**tree, "voice": scaling[0] * tree["voice"]} for tree in table["trees"]]
    places = joint_places(meshes, chosen)
    for (role, ordinal), (value, count, makers) in places.items():
        print(f"  {role} {ordinal}: share {value[0]:.3f}, forward {value[1]:.3f}, up {value[2]:.3f}, outward {value[3]:.3f} ({count} of {makers} makers)")
    if a.tables:
        write_trust(a.tables + "/trust_table.hpp", table, meshes)
        write_joints(a.tables + "/joint_table.hpp", places)


if __name__ == "__main__":
    main()
