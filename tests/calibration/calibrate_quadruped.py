#!/usr/bin/python3
"""Fit the trust in a four-legged animal, and where its joints lie: quadruped/trust_table.hpp and joint_table.hpp.

usage: calibrate_quadruped.py FOLDER... [--tables FOLDER]

Each FOLDER holds truth/NAME.json and candidates/NAME.jsonl, as find_candidates.py --template quadruped writes the latter:
of every way to see an animal in a curve the evidence and the ways of its limbs. A way is RIGHT when each foot's and the
tail's end lies nearer to its own marker than to the others and within 0.12 of the scale, and the head's end within 0.26 of
the head's, nose's or crown's. People and things are wrong. The trust is fitted as calibrate.py fits that in people, each
mesh's right and wrong ways counting once together. Where joints lie is fitted by how the ways run, on generated animals
(skelgen synth --set quadrupeds), too. What is printed is of folds by maker.
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


# What the place of a joint is told from, beside its role: see quadruped::detail::features_of (place_joints.hpp).
PLACE_SHARES, RADIUS_SHARES, BUILD = (0, 4, 8, 12, 16), (2, 6, 10, 14, 18), 12


def features(row, way, sign):
    places, size = np.array(row["ways"][way]), row["size"]
    is_leg = "leg" in way
    off = (places[list(PLACE_SHARES)] - places[-1 if is_leg else 0]) / size
    out = [off @ np.array(row["frame"]["forward"]), off @ np.array(row["frame"]["up"]), sign * (off @ np.array(row["frame"]["left"])) * is_leg]
    return np.concatenate([np.stack(out, 1).ravel(), np.array(row["radii"][way])[list(RADIUS_SHARES)] / size, list(row["evidence"].values())[:BUILD]])


def joint_samples(meshes, chosen):
    """Per role and place among its joints: maker, features and the share and offsets that the true joint has."""
    found = collections.defaultdict(list)
    for m, (i, _) in zip(meshes, chosen):
        if i < 0 or not m.right[i] or "joints" not in m.truth:
            continue
        row = m.rows[i]
        for role, ordinal, way, name in PLACES:
            for side, sign in (("left_", 1), ("right_", -1), ("", 0)):
                nodes = side + way if "leg" in way else way
                if side + name not in m.truth["joints"] or not row["ways"][nodes]:
                    continue
                place = np.array(m.truth["joints"][side + name])
                if role == "ear":
                    frame = head_frame(row)
                    off = (place - np.array(row["ways"][nodes][-1])) / row["size"]
                    value = [1.0] + [float(off @ frame[d]) for d in ("forward", "up")] + [sign * float(off @ frame["left"])]
                else:
                    value = place_on(row["ways"][nodes], place, row["frame"], row["size"], sign)
                if not sign:
                    value[3] = 0.0  # in the middle
                found[role, ordinal].append({"mesh": m, "row": row, "way": nodes, "sign": sign, "maker": m.group, "x": features(row, nodes, sign), "y": np.array(value), "place": place})
    return found


def scales_of(samples):
    """Mean and deviation of the features on each kind of way."""
    by_way = collections.defaultdict(list)
    for (role, ordinal), rows in samples.items():
        by_way[next(w for r, o, w, _ in PLACES if (r, o) == (role, ordinal))] += [r["x"] for r in rows]
    return {way: (np.mean(x, axis=0), np.std(x, axis=0) + 1e-6) for way, x in by_way.items()}


def fit_places(samples, scales, penalty):
    """Per role and place: means of share and offsets, makers counting by the root of their samples, and how they change
    with the features: by ridge regression, half of each maker's own mean taken off, as makers differ in where they put
    joints. The generator of animals is one of the makers."""
    out = {}
    for (role, ordinal), rows in samples.items():
        mean, deviation = scales[next(w for r, o, w, _ in PLACES if (r, o) == (role, ordinal))]
        x, y = (np.array([r["x"] for r in rows]) - mean) / deviation, np.array([r["y"] for r in rows])
        makers = np.array([r["maker"] for r in rows])
        counts = collections.Counter(makers)
        w = np.array([1 / np.sqrt(counts[m]) for m in makers])
        w /= w.sum()
        lift, centre = w @ x, w @ y
        x, y = x - lift, y - centre
        for maker in counts:
            k = makers == maker
            x[k] -= np.average(x[k], axis=0, weights=w[k]) / 2
            y[k] -= np.average(y[k], axis=0, weights=w[k]) / 2
        change = np.linalg.solve((x * w[:, None]).T @ x + penalty * np.eye(x.shape[1]), (x * w[:, None]).T @ y)
        out[role, ordinal] = centre - lift @ change, change
    return out


def error_of(sample, table, scales):
    """How far the joint comes to lie from the true one, relative to the truth's scale."""
    way = sample["way"].replace("left_", "").replace("right_", "")
    mean, deviation = scales[way]
    value = table[0] + np.clip((sample["x"] - mean) / deviation, -2.5, 2.5) @ table[1]
    row = sample["row"]
    frame = head_frame(row) if value[0] == 1.0 and way == "neck" else {d: np.array(row["frame"][d]) for d in ("forward", "up", "left")}
    nodes = np.array(row["ways"][sample["way"]])
    along = min(max(value[0], 0), 1) * (len(nodes) - 1)
    i = min(int(along), len(nodes) - 2)
    place = nodes[i] + (along - i) * (nodes[i + 1] - nodes[i])
    place = place + row["size"] * (value[1] * frame["forward"] + value[2] * frame["up"] + sample["sign"] * value[3] * frame["left"])
    return float(np.linalg.norm(place - sample["place"]) / sample["mesh"].truth["scale"])


def report_places(samples, penalty):
    """Mean errors per joint of makers left out, without and with what the features tell."""
    makers = sorted({r["maker"] for rows in samples.values() for r in rows} - {"skelgen"})  # of real animals
    for name, strength in (("means alone", 1e9), ("with features", penalty)):
        errors = collections.defaultdict(list)
        for maker in makers:
            rest = {k: [r for r in rows if r["maker"] != maker] or rows for k, rows in samples.items()}
            scales = scales_of(rest)
            tables = fit_places(rest, scales, strength)
            for key, rows in samples.items():
                for r in rows:
                    if r["maker"] == maker:
                        errors[key].append((r["mesh"].name, error_of(r, tables[key], scales)))
        animals = collections.defaultdict(list)
        for rows in errors.values():
            for mesh, error in rows:
                animals[mesh].append(error)
        print(f"joints, makers left out, {name}: {np.mean([np.mean(v) for v in animals.values()]):.4f};", ", ".join(f"{k[0]}{k[1]} {np.mean([e for _, e in v]):.3f}" for k, v in errors.items()))


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


def write_joints(path, tables, scales):
    """Puts the numbers into the table; what is before the first of them stays."""
    numbers = lambda values: ", ".join(f"{v:.3g}" for v in values)
    head = open(path).read().split("/// Mean and deviation of the features")[0]
    with open(path, "w") as f:
        f.write(head + "/// Mean and deviation of the features on each way, by Way.\ninline constexpr std::array<WayScale, 5> way_scales{{\n")
        for way in ("fore_leg", "hind_leg", "trunk", "neck", "tail"):
            f.write("    {{{" + numbers(scales[way][0]) + "}},\n     {{" + numbers(scales[way][1]) + "}}},\n")
        f.write("}};\n\ninline constexpr std::array<JointPlace, " + str(len(PLACES)) + "> joint_places{{\n")
        for role, ordinal, way, _ in PLACES:
            centre, change = tables[role, ordinal]
            f.write(f"    {{JointRole::{role}, {ordinal}, Way::{way}, {{{{{numbers(centre)}}}}},\n     {{{{")
            f.write(",\n       ".join("{{" + numbers(column) + "}}" for column in change.T) + "}}},\n")
        f.write("""}};

/// Of a role; its last one where there are not so many. Templates keep to that (core/template_rules.hpp).
[[nodiscard]] constexpr const JointPlace& place_of(JointRole role, int ordinal) {
    const JointPlace* out = joint_places.data();
    for (const JointPlace& place : joint_places)
        if (place.role == role && place.ordinal <= ordinal) out = &place;
    return *out;
}

} // namespace skelgen::quadruped
""")


def likeliest(mesh):
    """The likeliest way by the table that the program has, and how likely it is."""
    p = [row["probability"] for row in mesh.rows]
    return (int(np.argmax(p)), float(max(p))) if p else (-1, 0.0)


def fit_trust(meshes, a):
    """Fits the trust and writes it; returns which way is the likeliest in each mesh, by what is fitted without its maker."""
    chosen = by_folds(meshes, a.penalty, a.trees)
    scaling = scaling_of(meshes, chosen)
    scaled = [(i, float(calibrate.logistic(scaling[0] * calibrate.log_odds(p) + scaling[1])) if i >= 0 else 0.0) for i, p in chosen]
    calibrate.report(meshes, scaled)
    print("wrong:", [(m.name, round(p, 2)) for m, (i, p) in zip(meshes, scaled) if m.is_body and (i < 0 or not m.right[i])])
    table = calibrate.fit(meshes, a.penalty, a.trees, 0, balanced)
    table["offset"] = scaling[0] * table["offset"] + scaling[1]
    table["weights"] = scaling[0] * table["weights"]
    table["trees"] = [{**tree, "voice": scaling[0] * tree["voice"]} for tree in table["trees"]]
    if a.tables:
        write_trust(a.tables + "/trust_table.hpp", table, meshes)
    return chosen


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--tables", help="folder of the tables to write: include/skelgen/quadruped")
    parser.add_argument("--penalty", type=float, default=8.0)
    parser.add_argument("--trees", type=int, default=100)
    parser.add_argument("--place-penalty", type=float, default=0.3)
    parser.add_argument("--joints-alone", action="store_true", help="the trust's table stays as it is")
    a = parser.parse_args()
    meshes = []
    for folder in a.folders:
        for file in sorted(os.listdir(folder + "/truth")):
            truth = json.load(open(f"{folder}/truth/{file}"))
            if os.path.exists(f"{folder}/candidates/{file[:-5]}.jsonl") and truth.get("expect") != "either" and truth.get("style") != "quadruped":  # animals without truth
                meshes.append(Mesh(folder, file[:-5], truth))
    if a.joints_alone:
        chosen = [likeliest(m) for m in meshes]
    else:
        chosen = fit_trust(meshes, a)
    samples = joint_samples(meshes, chosen)
    report_places(samples, a.place_penalty)
    scales = scales_of(samples)
    tables = fit_places(samples, scales, a.place_penalty)
    if a.tables:
        write_joints(a.tables + "/joint_table.hpp", tables, scales)


if __name__ == "__main__":
    main()
