#!/usr/bin/python3
"""Fit the trust in a skeleton, and in its sides: the weights of search/trust_table.hpp and symmetry/sides_table.hpp.

usage: calibrate.py FOLDER... [--include INCLUDE/SKELGEN] [--ablate]

Each FOLDER holds truth/NAME.json and candidates/NAME.jsonl, as find_candidates.py writes the latter. A truth has `expect` (body, refuse, either; a body where it says nothing) and, of a body whose joints
are known, `scale`, `joints` and `markers`, and `missing`, the joints of what was cut off; `group` is its maker.

A candidate is RIGHT when each hand, foot and the head lies nearer to its own marker than to the others and within 0.15
of it (head 0.2), hands, feet, elbows, knees and shoulders lie nearer to their own side's marker than to the other's, the
median of the joints' errors is at most 0.04 of the scale and none above 0.12. What comes of no body is wrong.

The log odds are linear in the evidence and in the squares of proportions, fitted with a penalty on the weights. Each mesh
counts once, one of a named maker three times: as what was found after the first try, after the fourth and after all of them,
since what the candidates say of each other changes with each.
The sides are fitted first, on candidates whose limbs are right, as they are or with left and right exchanged. The log odds that the
sides are right are linear in what tells left from right, each bounded. The trust is then fitted with the sides that the other folds decide.

What is printed is of folds: fitted without the makers that it is then judged on; how often the likeliest candidate is right,
and how often those of each tenth of probability are. Of each way to find candidates: how often these are right, and how far off, not by
folds: the likeliest are so by the table that was compiled in. And it is printed how often the likeliest is right with its joints where all
candidates together expect them. --ablate leaves out each kind of hypothesis and each
witness in turn, and prints what that changes, by folds. Needs python3-numpy.
"""
import argparse
import copy
import hashlib
import json
import os

import numpy as np

# Proportions: what is far off an adult's either way is unlikely, so that their squares are heard, too (search/trust.hpp).
CURVED = ["arm_length", "leg_length", "hip_width", "below_hips", "neck_height", "reach"]
MOST_CURVED = 1.5
TRIES = (1, 4, None)  # after which the evidence of what was found until then is fitted; None: after all
NEAR, FARTHEST, DISSENTERS = 0.05, 0.3, 3  # as search/impl/agreement.hpp and search/trust.hpp have them
EXACTNESS_IN_CURVES, SUREST = 3.3, 0.9999  # as search/impl/ladder.hpp has them
OF_A_MAKER = 3  # how often a mesh of a named maker counts: such meshes are the harder ones, and the fewer
ENDS = ["left_hand", "right_hand", "left_foot", "right_foot", "head"]
JOINTS = 21  # of human21
LIMBS_ARE_RIGHT = 0.08  # median error of joints, of the scale, below which a candidate tells what witnesses of the sides are worth
FARTHEST_OFF = 0.15  # of the scale: a joint that is farther off counts no more
BOUND = 3  # root mean squares of a witness of the sides that count at most
PAIRS = ["hand", "foot", "elbow", "knee", "shoulder"]


def judge(truth, joints):
    """(is right, per joint the error) of a candidate; (None, {}) where the truth cannot tell."""
    if truth.get("expect") in ("refuse", "quadruped"):
        return (None if truth.get("species") == "human" else False), {}
    if "joints" not in truth or truth.get("expect") == "either":
        return None, {}
    missing = truth.get("missing", ())
    if any(joint in joints for joint in missing):
        return False, {}  # what was cut off has to be said to be missing
    scale = truth["scale"]
    markers = {k: np.array(v) for k, v in truth["markers"].items() if k not in missing}
    places = {k: np.array(v) for k, v in joints.items()}
    true = {k: np.array(v) for k, v in truth["joints"].items() if k not in missing}
    far = lambda a, b: float(np.linalg.norm(a - b)) / scale
    for side in ("left_", "right_"):  # a rig without knuckles or toes has its hand or foot marked at the wrist or ankle
        for end, joint in (("hand", "wrist"), ("foot", "ankle")):
            a, b = side + end, side + joint
            if a in markers and b in true and b in places and far(markers[a], true[b]) < 1e-6:
                places[a] = places[b]
    right = True
    for end in ENDS:
        if end in markers:
            near = end in places and min((m for m in markers if m in ENDS), key=lambda m: far(places[end], markers[m])) == end
            right = right and near and far(places[end], markers[end]) <= (0.2 if end == "head" else 0.15)
    for a, b in (("left_", "right_"), ("right_", "left_")):
        for pair in PAIRS:
            if a + pair in markers and b + pair in markers:
                right = right and a + pair in places and far(places[a + pair], markers[a + pair]) < far(places[a + pair], markers[b + pair])
    errors = {k: far(places[k], v) if k in places else 1.0 for k, v in true.items()}
    values = list(errors.values())
    return right and float(np.median(values)) <= 0.04 and max(values) <= 0.12, errors


def mirrored(joints):
    """The joints with left and right exchanged."""
    other = lambda name: "right" + name[4:] if name.startswith("left_") else "left" + name[5:] if name.startswith("right_") else name
    return {other(name): place for name, place in joints.items()}


class Mesh:
    """One mesh's candidates: names, evidence (candidates x witnesses), whether each is right."""

    def __init__(self, folder, name, truth):
        self.name, self.group, self.truth = name, str(truth.get("group") or os.path.basename(folder) + ":" + name), truth
        self.is_body = truth.get("expect", "body") not in ("refuse", "quadruped")
        self.rows = [json.loads(line) for line in open(f"{folder}/candidates/{name}.jsonl")]
        self.judge_all()
        if self.rows and np.abs(self.states[-1][1] - self.evidence).max() > 1e-3:
            raise SystemExit(f"{name}: the candidates' evidence is not what they say of each other")

    def judge_all(self):
        judged = [judge(self.truth, row.get("joints", {})) for row in self.rows]
        self.is_known = all(right is not None for right, _ in judged) and self.truth.get("expect") != "either" and ("joints" in self.truth or not self.is_body)
        self.right = np.array([bool(right) for right, _ in judged])
        self.errors = [errors for _, errors in judged]
        self.evidence = np.array([list(row["evidence"].values()) + [np.clip(row["evidence"][w], -MOST_CURVED, MOST_CURVED) ** 2 for w in CURVED] for row in self.rows])
        self.states = states_of(self)
        if self.rows:
            self.evidence = self.states[-1][1]

    def sides(self):
        """(candidates, what tells their left from right, positive where it is for what is right) of those with right limbs."""
        rows, values = [], []
        if self.is_body and "joints" in self.truth:
            for row in self.rows:
                if not row.get("joints"):
                    continue
                as_is, exchanged = (np.median(list(judge(self.truth, joints)[1].values()) or [1]) for joints in (row["joints"], mirrored(row["joints"])))
                if min(as_is, exchanged) < LIMBS_ARE_RIGHT:
                    rows.append(row)
                    values.append(np.array(list(row["sides"].values())) * (1 if as_is < exchanged else -1))
        return rows, np.array(values)

    def take_sides(self, table):
        """Decides left and right anew, by a table."""
        for row in self.rows:
            if "joints" not in row or "sides" not in row:
                continue
            odds = side_odds(table, np.array(list(row["sides"].values())))
            row["evidence"]["sides"] = float(np.tanh(abs(odds) / 2))
            if odds < 0:
                row["joints"], row["doubt"] = mirrored(row["joints"]), mirrored(row["doubt"])
                row["sides"] = {name: -value for name, value in row["sides"].items()}
        self.judge_all()


def side_odds(table, values):
    return np.clip(values, -table["limits"], table["limits"]) @ table["weights"]


def fit_sides(meshes, without=None, penalty=2.0):
    """Weights and limits of what tells left from right, by a logistic regression without offset; a witness left out."""
    values = np.concatenate([m.side_values for m in meshes])
    w = np.concatenate([np.full(len(m.side_values), (OF_A_MAKER if kind_of(m) == "makers" else 1) / len(m.side_values)) for m in meshes])
    if without is not None:
        values[:, without] = 0
    spread = np.sqrt(np.average(values**2, axis=0, weights=w)) + 1e-12
    beta = logistic_regression(np.clip(values / spread, -BOUND, BOUND), 1, w, penalty)
    return {"weights": beta / spread, "limits": BOUND * spread}


def fit_sides_by_folds(meshes):
    """Per fold the table of the others; prints how often they decide right. The meshes take sides by them."""
    told = []
    for m in meshes:
        rows, m.side_values = m.sides()
        if rows:
            told.append(m)
            names = list(rows[0]["sides"])

    def measure(without=None):
        tables = [fit_sides([m for m in told if fold_of(m.group) != fold], without) for fold in range(5)]
        odds = {m.name + m.group: side_odds(tables[fold_of(m.group)], np.where(np.arange(len(names)) == without, 0, m.side_values)) for m in told}
        of = lambda kind, value: np.mean([np.mean(value(odds[m.name + m.group])) for m in told if kind_of(m) == kind])
        return tables, "; ".join(
            f"{kind}: right {of(kind, lambda x: x > 0):.3f}, log loss {of(kind, lambda x: np.log1p(np.exp(-x))):.3f}, wrong above .95 {of(kind, lambda x: x < -np.log(19)):.3f}" for kind in ("makers", "others") if any(kind_of(m) == kind for m in told)
        )

    tables, text = measure()
    print(f"sides of {sum(len(m.side_values) for m in told)} candidates of {len(told)} meshes: {text}")
    for k, name in enumerate(names):
        print(f"  without {name:6s} {measure(k)[1]}")
    for m in meshes:
        m.take_sides(tables[fold_of(m.group)])
    return fit_sides(told), names, told


def places_of(rows):
    """Joints' places, candidates x joints x 3, and the joints' names; not a number where a joint is absent."""
    names = sorted({name for row in rows for name in row["joints"]})
    absent = [np.nan] * 3
    return np.array([[row["joints"].get(name, absent) for name in names] for row in rows]), names


def agreements_of(rows):
    """search::agreement of each candidate with each, 0 with itself."""
    places, _ = places_of(rows)
    out = np.zeros((len(rows), len(rows)))
    for i, row in enumerate(rows):
        distances = np.minimum(np.linalg.norm(places - places[i], axis=2) / row["extent"], FARTHEST)
        both = np.isfinite(distances).sum(axis=1)
        mean = np.nansum(distances, axis=1) / np.maximum(both, 1)
        out[i] = np.where(2 * both >= JOINTS, np.exp(-((mean / NEAR) ** 2)), 0)
        out[i, i] = 0
    return out


def expected_joints(mesh, p, best):
    """One candidate's joints where all together expect them, as search/impl/consensus.hpp has it."""
    places, names = places_of(mesh.rows)
    p = np.minimum(p, SUREST)
    weights = p / (1 - p) * np.where([row["evidence"]["fitted"] == 0 for row in mesh.rows], EXACTNESS_IN_CURVES, 1)
    pairs = [(k, names.index("right" + name[4:])) for k, name in enumerate(names) if name.startswith("left_") and "right" + name[4:] in names]
    across = np.nan_to_num(np.stack([places[:, a] - places[:, b] for a, b in pairs], axis=1)) if pairs else np.zeros((len(places), 1, 3))
    present = np.isfinite(places[:, :, 0])
    heard = ((across * across[best]).sum(axis=(1, 2)) >= 0) & (present == present[best]).all(axis=1)
    out = {}
    for k in np.flatnonzero(present[best]):
        at, seen = places[best, k], places[heard, k]
        span = np.linalg.norm(seen - at, axis=1).max()
        for _ in range(30 if span > 0 else 0):
            share = weights[heard] / np.maximum(np.linalg.norm(seen - at, axis=1), 1e-4 * span)
            at = share @ seen / share.sum()
        out[names[k]] = at
    return out


def states_of(mesh):
    """(candidates, their evidence) after some of the tries: what they say of each other changes with each."""
    rows, out = mesh.rows, []
    if not rows:
        return out
    names = list(rows[0]["evidence"])
    column = {name: names.index(name) for name in ("agreed", "heard", "others_lack", "fitted")}
    lacking = mesh.evidence[:, [names.index(name) for name in ("lacks_head", "lacks_limbs", "cut_limbs")]].sum(axis=1)
    agreements = agreements_of(rows)
    tries = sorted({row["try"] for row in rows})
    for count in dict.fromkeys(len(tries) if most is None else min(most, len(tries)) for most in TRIES):
        which = [i for i, row in enumerate(rows) if row["try"] <= tries[count - 1]]
        evidence, others = mesh.evidence[which].copy(), len(which) - 1
        in_curves = lacking[which][evidence[:, column["fitted"]] == 0]
        evidence[:, column["agreed"]] = agreements[np.ix_(which, which)].sum(axis=1) / (others + DISSENTERS)
        evidence[:, column["heard"]] = others / (others + DISSENTERS)
        evidence[:, column["others_lack"]] = np.maximum(0, in_curves.mean() - lacking[which]) if len(in_curves) else 0
        out.append((which, evidence))
    return out


def read_meshes(folders):
    meshes, witnesses = [], None
    for folder in folders:
        for file in sorted(os.listdir(folder + "/truth")):
            name = file[:-5]
            if not os.path.exists(f"{folder}/candidates/{name}.jsonl"):
                continue
            mesh = Mesh(folder, name, json.load(open(f"{folder}/truth/{file}")))
            if mesh.rows:
                witnesses = list(mesh.rows[0]["evidence"]) + [w + " squared" for w in CURVED]
            if mesh.is_known:
                meshes.append(mesh)
    return meshes, witnesses


def weights_of_rows(used):
    """What each candidate of each state counts: each mesh once, or OF_A_MAKER times."""
    of = lambda m: (OF_A_MAKER if kind_of(m) == "makers" else 1) / len(m.states)
    return np.concatenate([np.full(len(which), of(m) / len(which)) for m in used for which, _ in m.states])


def fit(meshes, penalty):
    """Weights, means and offset of a logistic regression by Newton's method."""
    used = [m for m in meshes if len(m.rows)]
    x = np.concatenate([evidence for m in used for _, evidence in m.states])
    y = np.concatenate([m.right[which] for m in used for which, _ in m.states]).astype(float)
    w = weights_of_rows(used)
    mean = np.average(x, axis=0, weights=w)
    deviation = np.sqrt(np.average((x - mean) ** 2, axis=0, weights=w))
    deviation[deviation < 1e-9] = 1
    z = np.hstack([(x - mean) / deviation, np.ones((len(x), 1))])
    ridge = np.full(z.shape[1], penalty)
    ridge[-1] = 0
    beta = logistic_regression(z, y, w, ridge)
    return {"weights": beta[:-1] / deviation, "means": mean, "offset": beta[-1]}


def logistic_regression(z, y, w, ridge):
    """Weights that make y likeliest, by Newton's method. z: rows x columns, w: of the rows, ridge: penalty on the squares."""
    beta = np.zeros(z.shape[1])
    for _ in range(60):
        p = logistic(z @ beta)
        gradient = z.T @ (w * (p - y)) + ridge * beta
        hessian = (z * (w * p * (1 - p))[:, None]).T @ z + np.diag(np.broadcast_to(ridge, len(beta))) + 1e-9 * np.eye(len(beta))
        step = np.linalg.solve(hessian, gradient)
        beta -= step
        if np.abs(step).max() < 1e-9:
            break
    return beta


def logistic(x):
    return 1 / (1 + np.exp(-x))


def odds_of(table, evidence):
    return table["offset"] + (evidence - table["means"]) @ table["weights"]


def probability(table, evidence):
    return logistic(odds_of(table, evidence))


def fold_of(group, folds=5):
    return int(hashlib.sha256(group.encode()).hexdigest(), 16) % folds


def choose(mesh, p):
    return int(np.argmax(p)) if len(p) else -1


def report(meshes, chosen):
    """Prints how often the likeliest candidate is right, and how reliable its probability is."""
    bodies = [m for m in meshes if m.is_body]
    right = sum(i >= 0 and m.right[i] for m, (i, _) in zip(meshes, chosen) if m.is_body)
    possible = sum(m.right.any() for m in bodies)
    together = [judge(m.truth, expected_joints(m, m.by_folds, i)) for m, (i, _) in zip(meshes, chosen) if m.is_body and i >= 0 and "joints" in m.truth]
    off = np.mean([np.mean(np.minimum(list(errors.values()) or [FARTHEST_OFF], FARTHEST_OFF)) for _, errors in together])
    print(f"bodies {len(bodies)}: likeliest candidate right {right}, some candidate right {possible}")
    print(f"  with its joints where all together expect them: right {sum(r for r, _ in together)}, off {off:.4f}")
    none = [(m, p) for m, (i, p) in zip(meshes, chosen) if not m.is_body and i >= 0]
    print(f"no bodies {sum(not m.is_body for m in meshes)}: above .5 {[m.name for m, p in none if p >= 0.5]}")
    print("wrong above .8:", [m.name for m, (i, p) in zip(meshes, chosen) if i >= 0 and p > 0.8 and not m.right[i]])
    for low in np.arange(0, 1, 0.1):
        tenth = [(m.right[i], p) for m, (i, p) in zip(meshes, chosen) if i >= 0 and low <= p < low + 0.1 + (low > 0.85)]
        if tenth:
            print(f"  {low:.1f}: {len(tenth):4d} candidates, right {np.mean([r for r, _ in tenth]):.2f}, said {np.mean([p for _, p in tenth]):.2f}")


def by_folds(meshes, penalty):
    chosen = [None] * len(meshes)
    for fold in range(5):
        table = fit([m for m in meshes if fold_of(m.group) != fold], penalty)
        for k, m in enumerate(meshes):
            if fold_of(m.group) == fold:
                p = probability(table, m.evidence) if len(m.rows) else np.array([])
                i = choose(m, p)
                m.by_folds = p
                chosen[k] = (i, float(p[i]) if i >= 0 else 0.0)
    return chosen


def report_kinds(meshes):
    """Prints, per way to find candidates, on how many bodies one of its is right, and its likeliest and its cheapest one, and how far
    off these are: the joints' mean error, each at most FARTHEST_OFF of the scale. A body that it finds none of counts as that."""
    bodies = [m for m in meshes if m.is_body and "joints" in m.truth]
    off = lambda m, i: float(np.mean(np.minimum(list(m.errors[i].values()) or [FARTHEST_OFF], FARTHEST_OFF)))
    for kind in sorted({row["hypothesis"][1] for m in bodies for row in m.rows}):
        found = [(m, which) for m in bodies if (which := [i for i, row in enumerate(m.rows) if row["hypothesis"][1] == kind])]
        means = lambda offs: f"off {(sum(offs) + FARTHEST_OFF * (len(bodies) - len(found))) / len(bodies):.4f}"
        text = f"some right {sum(m.right[which].any() for m, which in found)}, the best {means([min(off(m, i) for i in which) for m, which in found])}"
        picked = {"likeliest": lambda m, i: -m.rows[i]["probability"], "cheapest": lambda m, i: m.rows[i]["evidence"]["fit_cost"]}
        for name, value in picked.items():
            if name == "cheapest" and not all(m.rows[i]["evidence"]["fitted"] for m, which in found for i in which):
                continue  # a template in a curve has no cost
            chosen = [(m, min(which, key=lambda i: value(m, i))) for m, which in found]
            text += f"; {name} right {sum(m.right[i] for m, i in chosen)}, {means([off(m, i) for m, i in chosen])}"
        print(f"  {kind}: on {len(found)} of {len(bodies)} bodies, {text}")


def log_odds(p):
    p = np.clip(p, 1e-6, 1 - 1e-6)
    return np.log(p / (1 - p))


def kind_of(mesh):
    """Whether its truth names its maker; other groups are a folder and a body in it."""
    return "others" if ":" in mesh.group else "makers"


def fit_joints(meshes, chosen, near=0.03):
    """Offset and weights of a joint's log odds to lie within `near` of the scale: of the whole's log odds and of -log(1 + doubt)."""
    x, y = [], []
    for m, (i, p) in zip(meshes, chosen):
        if i < 0 or not m.errors[i]:
            continue
        odds = np.log(max(p, 1e-6) / max(1 - p, 1e-6))
        for joint, error in m.errors[i].items():
            if joint in m.rows[i]["doubt"]:
                x.append([odds, -np.log1p(m.rows[i]["doubt"][joint]), 1.0])
                y.append(error <= near)
    x, y, beta = np.array(x), np.array(y, float), np.zeros(3)
    for _ in range(50):
        p = 1 / (1 + np.exp(-x @ beta))
        beta -= np.linalg.solve((x * (p * (1 - p))[:, None]).T @ x + 1e-6 * np.eye(3), x.T @ (p - y))
    p = 1 / (1 + np.exp(-x @ beta))
    print(f"joints {len(y)}: above .7 {np.mean(p > 0.7):.2f} of them, of these within {near} {np.mean(y[p > 0.7]):.3f}; above .9 {np.mean(y[p > 0.9]):.3f}")
    return beta


def write_table(path, table, joint, witnesses, meshes):
    makers = len({m.group for m in meshes})
    rows = sum(len(m.rows) for m in meshes)
    straight = len(witnesses) - len(CURVED)
    numbers = lambda values: ",\n    ".join(f"{v:.5g}" for v in values)
    with open(path, "w") as f:
        f.write(f"""// Written by `./dev calibrate`: what the probability that a skeleton is right is made of. No unit. Fitted on {rows} candidates of
// {len(meshes)} meshes by {makers} makers; tests/calibration/calibrate.py says how, and how well on makers left out.
#pragma once

#include <array>

#include <skelgen/search/evidence.hpp>

namespace skelgen::search {{

inline constexpr double trust_offset = {table["offset"]:.5g};
inline constexpr std::array<double, witness_count> trust_weights{{
    // {", ".join(witnesses[:6])}, ... in the order of Witness
    {numbers(table["weights"][:straight])}}};
inline constexpr std::array<double, witness_count> trust_means{{
    {numbers(table["means"][:straight])}}};
/// Of the squares of those that `curved_witnesses` names, in its order.
inline constexpr std::array<double, curved_witnesses.size()> trust_square_weights{{
    {numbers(table["weights"][straight:])}}};
inline constexpr std::array<double, curved_witnesses.size()> trust_square_means{{
    {numbers(table["means"][straight:])}}};
inline constexpr double joint_trust_offset = {joint[2]:.4g}, joint_trust_of_whole = {joint[0]:.4g}, joint_trust_of_doubt = {joint[1]:.4g};

}} // namespace skelgen::search
""")


def write_sides_table(path, table, names, meshes):
    numbers = lambda values: ", ".join(f"{v:.4g}" for v in values)
    with open(path, "w") as f:
        f.write(f"""// Written by `./dev calibrate`: what the probability that left and right are told apart rightly is made of. Fitted on
// {sum(len(m.side_values) for m in meshes)} candidates of {len(meshes)} meshes by {len({m.group for m in meshes})} makers whose limbs are right; tests/calibration/calibrate.py says how, and how well on
// makers left out.
#pragma once

#include <array>

namespace skelgen::symmetry {{

/// What a unit of each SideWitness (sides.hpp) adds to the log odds: of {", ".join(names)}.
inline constexpr std::array<double, {len(names)}> side_weights{{{numbers(table["weights"])}}};
/// What counts of it at most: three root mean squares.
inline constexpr std::array<double, {len(names)}> side_limits{{{numbers(table["limits"])}}};

}} // namespace skelgen::symmetry
""")


def without(mesh, keep=None, witness=None):
    """The mesh with the candidates that `keep` wants alone, or with a witness that says nothing."""
    out = copy.copy(mesh)
    if keep is not None:
        kept = [i for i, row in enumerate(mesh.rows) if keep(row)]
        out.rows, out.errors = [mesh.rows[i] for i in kept], [mesh.errors[i] for i in kept]
        out.right, out.evidence = mesh.right[kept], mesh.evidence[kept] if kept else np.array([])
        out.states = states_of(out)  # those left out say nothing of the others any more
        if kept:
            out.evidence = out.states[-1][1]
    elif len(mesh.rows):
        out.evidence = mesh.evidence.copy()
        out.evidence[:, witness] = 0
        out.states = [(which, np.where(np.arange(evidence.shape[1]) == witness, 0, evidence)) for which, evidence in mesh.states]
    return out


def measures(meshes, penalty):
    """Of folds: how many bodies' likeliest candidates are right, how many things' are above .5, log loss."""
    chosen = by_folds(meshes, penalty)
    right = sum(i >= 0 and m.right[i] for m, (i, _) in zip(meshes, chosen) if m.is_body)
    false = sum(p >= 0.5 for m, (i, p) in zip(meshes, chosen) if not m.is_body and i >= 0)
    loss = -np.mean([np.log(max(p if m.right[i] else 1 - p, 1e-6)) for m, (i, p) in zip(meshes, chosen) if i >= 0])
    return right, false, loss


def ablate(meshes, witnesses, penalty):
    kinds = {
        "bodies at rest": lambda row: row["hypothesis"][1] != "rest_fit",
        "bodies in any pose": lambda row: row["hypothesis"][1] != "posed_fit",
        "envelopes": lambda row: row["hypothesis"][0] != "envelope",
        "envelopes without lone pieces": lambda row: row["hypothesis"][0] != "alike_pieces",
        "rounded surfaces": lambda row: row["hypothesis"][0] != "rounded",
        "limbs that are lacking": lambda row: row["evidence"]["lacks_head"] + row["evidence"]["lacks_limbs"] == 0,
    }
    right, false, loss = measures(meshes, penalty)
    print(f"left out: nothing: right {right}, things above .5: {false}, log loss {loss:.4f}")
    for name, keep in kinds.items():
        r, f, l = measures([without(m, keep=keep) for m in meshes], penalty)
        print(f"left out: {name}: right {r - right:+d}, things above .5 {f - false:+d}, log loss {l - loss:+.4f}")
    for k, name in enumerate(witnesses):
        r, f, l = measures([without(m, witness=k) for m in meshes], penalty)
        print(f"left out: witness {name}: right {r - right:+d}, things above .5 {f - false:+d}, log loss {l - loss:+.4f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--include", help="folder include/skelgen, whose tables are to be written")
    parser.add_argument("--penalty", type=float, default=2.0)
    parser.add_argument("--ablate", action="store_true")
    a = parser.parse_args()
    meshes, witnesses = read_meshes(a.folders)
    print(len(meshes), "meshes,", sum(len(m.rows) for m in meshes), "candidates of", len({m.group for m in meshes}), "makers")
    sides, side_names, told = fit_sides_by_folds(meshes)
    chosen = by_folds(meshes, a.penalty)
    report(meshes, chosen)
    report_kinds(meshes)
    joint = fit_joints(meshes, chosen)
    table = fit(meshes, a.penalty)
    spread = np.std(np.concatenate([m.evidence for m in meshes if len(m.rows)]), axis=0)
    for name, weight, deviation in sorted(zip(witnesses, table["weights"], spread), key=lambda t: -abs(t[1] * t[2])):
        print(f"  {name:16s} weight {weight:8.3f} times spread {weight * deviation:6.2f}")
    if a.ablate:
        ablate(meshes, witnesses, a.penalty)
    if a.include:
        write_sides_table(a.include + "/symmetry/sides_table.hpp", sides, side_names, told)
        write_table(a.include + "/search/trust_table.hpp", table, joint, witnesses, meshes)


if __name__ == "__main__":
    main()
