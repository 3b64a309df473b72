#!/usr/bin/env python3
"""contrib/manual/: what counts as a usable skeleton, and what is read of the measuring programs' tables."""

from __future__ import annotations

import copy
import json
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "contrib/manual"))
import characters
from characters import judge
from results import rigs, speed, verbatim

SIDES = {"shoulder": (0.2, 1.4), "elbow": (0.45, 1.4), "wrist": (0.7, 1.4), "hand": (0.8, 1.4), "hip": (0.1, 0.9), "knee": (0.1, 0.5)}
SIDES |= {"ankle": (0.1, 0.1), "foot": (0.1, 0.02)}


def skeleton() -> dict:
    joints = [{"name": "head", "position": [0, 1.7, 0]}]
    for sign, side in ((1, "left"), (-1, "right")):
        joints += [{"name": f"{side}_{part}", "position": [sign * x, y, 0]} for part, (x, y) in SIDES.items()]
    return {"joints": joints}


def truth() -> dict:
    places = {joint["name"]: list(joint["position"]) for joint in skeleton()["joints"]}
    return {"scale": 1.7, "joints": {k: v for k, v in places.items() if "hand" not in k and k != "head"}, "markers": places}


def moved(name: str, by: float) -> dict:
    found = skeleton()
    for joint in found["joints"]:
        if name in joint["name"]:
            joint["position"][2] += by * 1.7
    return found


def test_usable() -> None:
    usable, error = judge(truth(), skeleton())
    assert usable and error == 0

    mirrored = copy.deepcopy(skeleton())
    for joint in mirrored["joints"]:
        joint["position"][0] *= -1
    assert not judge(truth(), mirrored)[0]

    assert judge(truth(), moved("hip", 0.11))[0]
    assert not judge(truth(), moved("hip", 0.13))[0]  # one joint is too far
    assert judge(truth(), moved("", 0.039))[0]
    assert not judge(truth(), moved("", 0.041))[0]  # all are too far
    assert abs(judge(truth(), moved("", 0.03))[1] - 0.03) < 1e-12
    assert not judge(truth(), moved("head", 0.21))[0]

    without = skeleton()
    without["joints"] = [joint for joint in without["joints"] if joint["name"] != "left_foot"]
    assert not judge(truth(), without)[0]


def test_hands_marked_at_the_wrists() -> None:
    known = truth()
    for side in ("left", "right"):
        known["markers"][f"{side}_hand"] = known["joints"][f"{side}_wrist"]
    found = skeleton()
    for joint in found["joints"]:
        if joint["name"].endswith("hand"):
            joint["position"][0] *= 3
    assert judge(known, found)[0]


def test_counts() -> None:
    """Of a right answer, a sure wrong one, a refusal, a body without a rig, a thing refused, one answered, and one that may be either."""
    right, wrong = skeleton(), moved("", 0.2)
    for found, confidence in ((right, 0.9), (wrong, 0.85)):
        found["quality"] = {"sides_confidence": confidence, "warnings": []}
    rigged, bare, thing = truth() | {"expect": "body"}, {"expect": "body", "joints": {}}, {"expect": "refuse"}
    cases = [(rigged, right), (rigged, wrong), (rigged, None), (bare, right), (thing, None), (thing, wrong), ({"expect": "either"}, wrong)]
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "truth").mkdir()
        for i, (known, _) in enumerate(cases):
            (Path(folder) / f"truth/{i}.json").write_text(json.dumps(known | {"file": str(i)}))
        characters.extract = lambda program, folder, known: cases[int(known["file"])][1]
        found = characters.score(Path(), Path(folder), 1)
    assert found["usable"] == (1, 3) and found["answered"] == (2, 3) and found["answered_without_rig"] == (1, 1), found
    assert found["refused"] == (1, 2) and found["usable_above_0.8"] == (1, 2) and found["wrong_and_sure"] == ["1", "5"], found


def test_tables() -> None:
    head = "body                         seconds      sums  2 limbs islands  stretch  above 3   volume     gaps   by rig   arms     back\n"
    row = "one                            0.100   1.0e-16    0.50%       0     2.10   0.010%     3.0%    0.10%   0.0010    1.0   0.0020\n"
    other = "two                            0.100   1.0e-16    1.50%       2     3.10   0.010%    -5.0%    0.10%   0.0030    1.0   0.0020\n"
    text = rigs("built\n" + head + row + other + "three                        refused: no body\n")
    assert "of 2 rigs" in text and "| 2.6 | 3.1 |" in text and "| -1 % | -5 % |" in text and "| 1 | 2 |" in text, text
    assert speed("== building\n| mesh | faces |\n|---|---|\n| a | 1 |\n\nGrows.\n") == "| mesh | faces |\n|---|---|\n| a | 1 |\n\nGrows.\n"
    printed = "[1/2] Building\n/home/me/meshes/faust/1.off: neck by 0.01\n    girth_neck   1.9 %\n1 meshes\n"
    assert verbatim(printed) == "```text\nfaust/1.off: neck by 0.01\n1 meshes\n```\n", verbatim(printed)


if __name__ == "__main__":
    test_usable()
    test_hands_marked_at_the_wrists()
    test_counts()
    test_tables()
