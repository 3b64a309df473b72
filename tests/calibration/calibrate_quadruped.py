#!/usr/bin/python3
"""Fit the trust in a four-legged animal, and where its joints lie: quadruped/trust_table.hpp and joint_table.hpp.

usage: calibrate_quadruped.py FOLDER... [--tables FOLDER]

Each FOLDER holds truth/NAME.json and candidates/NAME.jsonl, as find_candidates.py --template quadruped writes the latter:
of every way to see an animal in a curve the evidence and the ends of its limbs. A way is RIGHT when each foot's and the
tail's end lies nearer to its own marker than to the others and within 0.12 of the scale, and the head's end within 0.26 of
the head's, nose's or crown's. People and things are wrong. The trust is fitted as calibrate.py fits that in people, each
mesh's right and wrong ways counting once together. How far off its way a joint lies, and in which of the directions that
place_joints.hpp names, is fitted on generated animals (skelgen synth --set quadrupeds), too. What is printed is of folds by maker.
"""
import argparse
import collections
import json
import os
import re

import numpy as np
from sklearn.tree import DecisionTreeRegressor

import calibrate

FEET = ["left_fore_foot", "right_fore_foot", "left_hind_foot", "right_hind_foot"]
# Of each role and place among its joints, as the table has them: the joint of a truth that has it, but for its side.
PLACES = [
    ("pelvis", 0, "hips"), ("waist", 0, "spine1"), ("waist", 1, "spine2"), ("chest", 0, "chest"),
    ("neck", 0, "neck1"), ("neck", 1, "neck2"), ("head", 0, "head"), ("ear", 0, "ear"),
    ("shoulder_girdle", 0, "fore_girdle"), ("shoulder", 0, "fore_upper"), ("elbow", 0, "fore_lower"), ("wrist", 0, "fore_ankle"), ("hand", 0, "fore_foot"),
    ("hip_girdle", 0, "hind_girdle"), ("hip", 0, "hind_upper"), ("knee", 0, "hind_lower"), ("ankle", 0, "hind_ankle"), ("foot", 0, "hind_foot"),
    ("tail", 0, "tail1"), ("tail", 1, "tail2"), ("tail", 2, "tail3"), ("tail", 3, "tail4"),
]
SIDES = ["left_", "right_", ""]
OF_SIZE = 16  # the first of the directions that are the size forward, up and outward


def is_right(truth, row):
    places = row["ends"]
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


def balanced(used):
    """What each way counts: a mesh's right ones once together, its wrong ones, too."""
    return np.concatenate([np.where(m.right, 1 / max(m.right.sum(), 1), 1 / max((~m.right).sum(), 1)) for m in used])


RATE, QUESTIONS = 0.1, 3  # how much of each tree is taken, how deep it is


def fit(meshes, penalty, trees):
    """A linear table, and trees that are boosted on it."""
    table, used = calibrate.fit(meshes, penalty, balanced), [m for m in meshes if len(m.rows)]
    x = np.concatenate([m.evidence for m in used])
    y = np.concatenate([m.right for m in used]).astype(float)
    table["trees"] = boost(x, y, balanced(used), calibrate.odds_of(table, x), trees)
    return table


def boost(x, y, w, odds, count):
    """Trees that move log odds to what was found, each fitted to a random half. A tree: `witness` and `bound` of the questions,
    2 i + 1 below i where the witness is at most the bound and 2 i + 2 where it is above, and `voice` of the leaves."""
    x, random, out = x.astype(np.float32), np.random.default_rng(1), []
    for k in range(count):
        half = random.random(len(x)) < 0.5
        p = calibrate.logistic(odds)
        tree = DecisionTreeRegressor(max_depth=QUESTIONS, max_features=0.4, min_samples_leaf=30, random_state=k)
        tree.fit(x[half], (y - p)[half], sample_weight=w[half])
        leaf = tree.apply(x)
        error, spread = (np.bincount(leaf[half], (w * v)[half], tree.tree_.node_count) for v in (y - p, p * (1 - p)))
        voice = np.clip(RATE * error / (spread + 1e-3), -1, 1)
        odds = odds + voice[leaf]
        out.append(full_tree(tree.tree_, voice))
    return out


def full_tree(tree, voice):
    """With all of its questions, at its full depth: where it had none, one that is always answered alike."""
    questions = 2**QUESTIONS - 1
    out = {"witness": np.zeros(questions, int), "bound": np.full(questions, np.float32(1e30)), "voice": np.zeros(questions + 1)}

    def fill(node, place):
        if place >= questions:
            out["voice"][place - questions] = voice[node]
            return
        is_leaf = tree.children_left[node] < 0
        if not is_leaf:
            out["witness"][place], out["bound"][place] = tree.feature[node], np.float32(tree.threshold[node])
        fill(node if is_leaf else tree.children_left[node], 2 * place + 1)
        fill(node if is_leaf else tree.children_right[node], 2 * place + 2)

    fill(0, 0)
    return out


def probability(table, evidence):
    odds = calibrate.odds_of(table, evidence)
    x, rows = evidence.astype(np.float32), np.arange(len(evidence))
    for tree in table["trees"]:
        place = np.zeros(len(evidence), int)
        for _ in range(QUESTIONS):
            place = 2 * place + 1 + (x[rows, tree["witness"][place]] > tree["bound"][place])
        odds = odds + tree["voice"][place - len(tree["witness"])]
    return calibrate.logistic(odds)


def trees_text(trees):
    """As the rows of an array of QuestionTree."""
    in_row = lambda values, form: ", ".join(form.format(v) for v in values)
    return ",\n    ".join(
        f"{{{{{in_row(t['witness'], '{}')}}}, {{{in_row(t['bound'], '{:.9g}')}}}, {{{in_row(t['voice'], '{:.4g}')}}}}}" for t in trees
    )


def folds_of(meshes):
    """The fold of each mesh: makers of animals one by one, others at random."""
    makers = sorted({m.group for m in meshes if m.is_body})
    return [makers.index(m.group) if m.is_body else calibrate.fold_of(m.group, len(makers)) for m in meshes]


def by_folds(meshes, penalty, trees):
    folds, chosen = folds_of(meshes), [(-1, 0.0)] * len(meshes)
    for fold in set(folds):
        table = fit([m for m, f in zip(meshes, folds) if f != fold], penalty, trees)
        for k, m in enumerate(meshes):
            if folds[k] == fold and len(m.rows):
                p = probability(table, m.evidence)
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


def joint_samples(meshes, chosen):
    """Per role and place among its joints: maker, and offset and directions, in sizes, of each such joint that is known."""
    found = collections.defaultdict(list)
    for m, (i, _) in zip(meshes, chosen):
        if i < 0 or not m.right[i] or "joints" not in m.rows[i]:
            continue
        row = m.rows[i]
        known = {"head": m.truth["markers"].get("head"), **m.truth.get("joints", {})}  # where rigs lack it heads are marked
        for role, ordinal, name in PLACES:
            for side in SIDES:
                true, found_one = known.get(side + name), row["joints"].get(side + name)
                if not true or not found_one:
                    continue
                found[role, ordinal].append({"mesh": m.name, "maker": m.group, "offset": np.subtract(true, found_one["place"]) / row["size"],
                                             "directions": np.array(found_one["directions"]) / row["size"], "sized": row["size"] / m.truth["scale"]})
    return found


def fit_weights(rows, penalty):
    """Weights of the directions: by ridge regression, makers counting by the root of their samples. Each maker has an
    offset of its own beside that, forward, up and outward, as makers differ in where they put joints; it is forgotten
    (a mixed model: Laird & Ware, Random-Effects Models for Longitudinal Data, 1982). The generator is one of the makers."""
    makers = sorted({r["maker"] for r in rows})
    counts = collections.Counter(r["maker"] for r in rows)
    count, taste = len(rows[0]["directions"]), 5 / len(makers)
    own = slice(OF_SIZE, OF_SIZE + 3)
    x, y, w = np.zeros((len(rows), 3, count + 3 * len(makers))), np.array([r["offset"] for r in rows]), np.array([1 / np.sqrt(counts[r["maker"]]) for r in rows])
    for k, r in enumerate(rows):
        x[k, :, :count] = r["directions"].T
        first = count + 3 * makers.index(r["maker"])
        x[k, :, first : first + 3] = r["directions"][own].T
    scale = np.sqrt((x[:, :, :count] ** 2).sum(axis=1).mean(axis=0)) + 1e-9
    x[:, :, :count] /= scale
    ridge = np.full(x.shape[2], taste)
    ridge[:count] = penalty
    ridge[own] = penalty / 1000  # what all have in common
    w /= w.sum()
    square, right = np.einsum("k,kai,kaj->ij", w, x, x, optimize=True), np.einsum("k,kai,ka->i", w, x, y, optimize=True)
    return np.linalg.solve(square + np.diag(ridge), right)[:count] / scale


def error_of(row, weights):
    """How far the joint comes to lie from the true one, relative to the truth's scale."""
    return float(np.linalg.norm(weights @ row["directions"] - row["offset"]) * row["sized"])


def report_places(samples, penalty):
    """Mean errors per joint of makers left out, and with all fitted."""
    makers = sorted({r["maker"] for rows in samples.values() for r in rows} - {"skelgen"})  # of real animals
    for name, left_out in (("makers left out", makers), ("all makers fitted", ["nobody"]), ("generated ones, all fitted", ["skelgen"])):
        errors, animals = collections.defaultdict(list), collections.defaultdict(list)
        for key, rows in samples.items():
            for maker in left_out:
                weights = fit_weights([r for r in rows if r["maker"] != maker or name.startswith("gen")] or rows, penalty)
                for r in rows:
                    if r["maker"] == maker or maker == "nobody" and r["maker"] in makers:
                        errors[key].append(error_of(r, weights))
                        animals[r["mesh"]].append(errors[key][-1])
        print(f"joints, {name}: {np.mean([np.mean(v) for v in animals.values()]):.4f};", ", ".join(f"{k[0]}{k[1]} {np.mean(v):.3f}" for k, v in errors.items()))


def write_trust(path, table, meshes):
    numbers = lambda values: ",\n    ".join(f"{v:.5g}" for v in values)
    rows, animals = sum(len(m.rows) for m in meshes), sum(m.is_body for m in meshes)
    with open(path, "w") as f:
        f.write(f"""// Written by `./dev calibrate`: what the probability that an animal is seen rightly is made of. No unit. Fitted on {rows}
// ways to see one in {animals} animals and {len(meshes) - animals} people and things; tests/calibration/calibrate_quadruped.py says how.
#pragma once

#include <array>

#include <skelgen/quadruped/boosted_trees.hpp>
#include <skelgen/quadruped/limbs.hpp>

namespace skelgen::quadruped {{

inline constexpr double trust_offset = {table["offset"]:.5g};
inline constexpr std::array<double, witness_count> trust_weights{{
    {numbers(table["weights"])}}};
inline constexpr std::array<double, witness_count> trust_means{{
    {numbers(table["means"])}}};
inline constexpr std::array<QuestionTree, {len(table["trees"])}> trust_trees{{{{
    {trees_text(table["trees"])}}}}};

}} // namespace skelgen::quadruped
""")


def write_joints(path, samples, penalty):
    """Puts the weights into the table; ways and shares stay."""
    before, after = re.split(r"(?s)(?<=direction_weights\{\{\n).*?(?=\}\};)", open(path).read())
    rows = ["    {{" + ", ".join(f"{v:.3g}" for v in fit_weights(samples[role, ordinal], penalty)) + "}},\n" for role, ordinal, _ in PLACES]
    with open(path, "w") as file:
        file.write(before + "".join(rows) + after)


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
    table = fit(meshes, a.penalty, a.trees)
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
    parser.add_argument("--place-penalty", type=float, default=0.012)
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
    if a.tables:
        write_joints(a.tables + "/joint_table.hpp", samples, a.place_penalty)


if __name__ == "__main__":
    main()
