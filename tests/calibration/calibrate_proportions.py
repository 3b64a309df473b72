#!/usr/bin/python3
"""Fit the proportions of people and figures: search/proportions_table.hpp.

usage: calibrate_proportions.py SKELGEN_CANDIDATES FOLDER... --table FILE [--skeletons FOLDER] [--without FOLD] [--jobs N]

Each FOLDER holds truth/NAME.json, with joints as calibrate.py says, and the meshes in files/ or meshes/. Into each body
whose rig has shoulders, elbows, wrists, hips, knees and ankles a body in any pose is laid whose joints are held to them.
A rig's head joint is where its neck ends, so the head starts from the surface's top above that.
`--skeletons`: SET/NAME.json as `skelgen batch` writes them, of research bodies in FOLDER/meshes/SET, whose truths say less
than what is found in them. The mean and the covariance of all their proportions are written. The prior that the
fits have is the table's that is compiled in: to be repeated until it does not change. A maker's meshes count
together as the root of their number. Needs python3-numpy.
"""
import argparse
import collections
import json
import os
import subprocess
import tempfile
from multiprocessing.pool import ThreadPool

import numpy as np

from calibrate import fold_of
from find_candidates import mesh_of

NAMES = ["crotch", "waist", "chest", "neck", "head"] + [side + name for side in ("left_", "right_") for name in ("shoulder", "elbow", "wrist", "hand", "hip", "knee", "ankle", "foot")]
LIMBS = ["shoulder", "elbow", "wrist", "hip", "knee", "ankle"]
UNCERTAIN = ["waist", "chest", "head", "left_hand", "right_hand"]  # where the model has them is a convention of its own
PROPORTIONS = 17
SHRINKAGE = 0.1  # of correlations: there are not many makers
LEAST_DEVIATION = 0.05


def places_of_rig(truth):
    """Joints to start from, those that are known among them; none where the rig lacks limbs."""
    known = {name: np.array(place) for name, place in truth["joints"].items() if name.split("_", 1)[-1] in LIMBS}
    if len(known) < 12:
        return None
    start, markers = dict(known), {name: np.array(place) for name, place in truth["markers"].items()}
    for side in ("left_", "right_"):
        start[side + "hand"] = markers.get(side + "hand", start[side + "wrist"])
        start[side + "foot"] = markers.get(side + "foot", start[side + "ankle"])
    hips, shoulders = ((start["left_" + joint] + start["right_" + joint]) / 2 for joint in ("hip", "shoulder"))
    up = shoulders - hips
    for name, part in (("crotch", 0), ("waist", 0.33), ("chest", 0.7), ("neck", 1.05)):
        start[name] = hips + part * up
    return start, known


def measured(program, mesh, start, known):
    """The proportions of a body whose joints are known; none where nothing is enclosed."""
    lists = lambda places: {name: list(map(float, place)) for name, place in places.items()}
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump({"start": lists(start), "known": lists(known)}, file)
        file.flush()
        found = subprocess.run([program, mesh[0], "known", file.name, *mesh[3:]], capture_output=True, text=True, timeout=120)
    return np.array(json.loads(found.stdout)) if found.stdout else None


def bodies_of(folders, skeletons):
    """(maker, mesh, joints to start from, known ones)."""
    for folder in map(os.path.abspath, folders):
        for file in sorted(os.listdir(folder + "/truth")):
            if not file.endswith(".json"):
                continue
            truth = json.load(open(f"{folder}/truth/{file}"))
            if truth.get("expect") == "body" and "joints" in truth:
                mesh, places = mesh_of(folder, file[:-5], truth, "human21"), places_of_rig(truth)
                if mesh and places:
                    yield truth.get("group") or file, mesh, *places
        for one in sorted(os.listdir(skeletons)) if skeletons and os.path.isdir(folder + "/meshes") else []:
            for file in sorted(os.listdir(f"{skeletons}/{one}")):
                mesh = f"{folder}/meshes/{one}/{file[:-5]}.off"
                if file.endswith(".json") and os.path.exists(mesh):
                    start = {joint["name"]: joint["position"] for joint in json.load(open(f"{skeletons}/{one}/{file}"))["joints"]}
                    yield one, (mesh, "", ""), start, {name: start[name] for name in NAMES if name not in UNCERTAIN}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--table", required=True)
    parser.add_argument("--skeletons")
    parser.add_argument("--without", type=int, help="fold of makers that is left out")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    a = parser.parse_args()
    bodies = list(bodies_of(a.folders, a.skeletons))
    with ThreadPool(a.jobs) as pool:
        of_all = pool.map(lambda body: measured(a.program, *body[1:]), bodies, 1)
    used = [(maker, x) for (maker, *_), x in zip(bodies, of_all) if x is not None and fold_of(maker) != a.without]
    counts = collections.Counter(maker for maker, _ in used)
    weights = np.array([counts[maker] ** -0.5 for maker, _ in used])
    x = np.array([proportions for _, proportions in used])
    mean = np.average(x, axis=0, weights=weights)
    covariance = np.cov(x.T, aweights=weights, ddof=0)
    covariance = (1 - SHRINKAGE) * covariance + np.diag(SHRINKAGE * np.diag(covariance) + LEAST_DEVIATION**2)
    numbers = lambda values: ", ".join(f"{v:.5g}" for v in values)
    rows = ",\n    ".join(numbers(covariance[i, : i + 1]) for i in range(PROPORTIONS))
    with open(a.table, "w") as file:
        file.write(f"""// Written by `./dev calibrate --proportions`: what search/impl/proportions.hpp holds bodies to. Logarithms, without
// unit. Fitted on {len(used)} bodies by {len(counts)} makers; tests/calibration/calibrate_proportions.py says how.
#pragma once

#include <array>

namespace skelgen::search::detail {{

inline constexpr int proportion_count = {PROPORTIONS};
/// Of the head from the neck to the top, upper arm, forearm to the fingertips, trunk, thigh, shin, foot, the widths between the
/// shoulders and between the hips; of the radii of head, trunk, chest, shoulder, wrist, thigh, knee and ankle.
inline constexpr std::array<double, {PROPORTIONS}> proportion_means{{
    {numbers(mean)}}};
/// The covariance's lower triangle by rows.
inline constexpr std::array<double, {PROPORTIONS * (PROPORTIONS + 1) // 2}> proportion_covariance{{
    {rows}}};

}} // namespace skelgen::search::detail
""")
    print(f"{len(used)} bodies by {len(counts)} makers; standard deviations {numbers(np.sqrt(np.diag(covariance)))}")


if __name__ == "__main__":
    main()
