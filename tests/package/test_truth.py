#!/usr/bin/env python3
"""contrib/truth/: a regressor and landmarks whose joints are known give truth files with these joints, which evaluate reads.

test_truth.py PROGRAM SOURCES: ends with 77, for skipped, where numpy is not there.
"""

from __future__ import annotations

import json
import pickle
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("numpy is not there")
    sys.exit(77)
try:
    import scipy.sparse
except ImportError:
    scipy = None


def run(*command: object, fails: bool = False) -> str:
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    assert (done.returncode != 0) == fails, (command, done.stdout, done.stderr)
    return done.stdout + done.stderr


def test_faust(program: Path, root: Path, work: Path) -> None:
    truth = json.loads((root / "data/sample/body.json").read_text())["joints"]
    sys.path.insert(0, str(root / "contrib/truth"))
    from faust import SMPL  # noqa: PLC0415
    from truth_file import read_mesh  # noqa: PLC0415

    # A regressor that gives the sample's own joints: the mean of all vertices, and as much of four others as it takes.
    vertices, _ = read_mesh(root / "data/sample/body.off")
    regressor = np.full((24, len(vertices)), 1 / len(vertices))
    corners = [0, 2000, 4000, 6000]
    frame = np.vstack([vertices[corners].T, np.ones(4)])
    for name, number in [*SMPL.items(), ("head", 15)]:
        missing = np.append(np.array(truth[name]) - vertices.mean(axis=0), 0)
        regressor[number, corners] += np.linalg.solve(frame, missing)
    (work / "registrations").mkdir()
    (work / "registrations/tr_reg_000.off").write_bytes((root / "data/sample/body.off").read_bytes())
    np.savez(work / "model.npz", J_regressor=regressor)
    with (work / "model.pkl").open("wb") as file:
        pickle.dump(
            {"J_regressor": scipy.sparse.csc_matrix(regressor), "other": work}, file
        )  # a class that is not made
    for model in ("model.npz", "model.pkl"):
        run(
            sys.executable,
            root / "contrib/truth/faust.py",
            work / "registrations",
            work / model,
            "-o",
            work / model[6:],
        )
        written = json.loads((work / model[6:] / "tr_reg_000.json").read_text())
        assert set(written["joints"]) == set(SMPL)
        for name, place in written["joints"].items():
            assert np.allclose(place, truth[name], atol=1e-9), name
        assert abs(written["scale"] / 2.0251 - 1) < 0.05  # along edges, which is longer than along the surface
    (work / "found").mkdir()
    run(program, "extract", work / "registrations/tr_reg_000.off", "-q", "-o", work / "found/tr_reg_000.json")
    assert "solved 1/1" in run(program, "evaluate", work / "npz", work / "found")
    np.savez(work / "short.npz", J_regressor=np.full((24, 100), 0.01))
    command = (
        sys.executable,
        root / "contrib/truth/faust.py",
        work / "registrations",
        work / "short.npz",
        "-o",
        work / "no",
    )
    assert "has 6890 vertices, not the 100 that the model has" in run(*command, fails=True)


def test_landmarks(program: Path, root: Path, work: Path) -> None:
    from landmarks import NAMES, PAIRS  # noqa: PLC0415

    (work / "meshes").mkdir()
    (work / "marks").mkdir()
    (work / "meshes/a.off").write_bytes((root / "data/sample/body.off").read_bytes())
    numbers = [17 * i + 3 for i in range(len(NAMES))]
    vertices = (root / "data/sample/body.off").read_text().split()[4:]
    place = {name: np.array(vertices[3 * i : 3 * i + 3], float) for name, i in zip(NAMES, numbers)}
    ways = {
        "vertices": "\n".join(map(str, numbers)),
        "places": "\n".join("{} {} {}".format(*place[name]) for name in NAMES),
        "names": "# shuffled\n" + "\n".join(f"{name} {i}" for name, i in reversed(list(zip(NAMES, numbers)))),
    }
    for way, text in ways.items():
        (work / "marks/a.txt").write_text(text + "\n")
        run(sys.executable, root / "contrib/truth/landmarks.py", work / "meshes", work / "marks", "-o", work / way)
        written = json.loads((work / way / "a.json").read_text())
        assert set(written["joints"]) == set(PAIRS)
        for name, (one, other) in PAIRS.items():
            assert np.allclose(written["joints"][name], (place[one] + place[other]) / 2), (way, name)
    (work / "marks/a.txt").write_text("99999\n")
    message = run(
        sys.executable,
        root / "contrib/truth/landmarks.py",
        work / "meshes",
        work / "marks",
        "-o",
        work / "no",
        fails=True,
    )
    assert "line 1 names a vertex that the mesh does not have" in message


def main() -> None:
    program, root = (Path(argument).resolve() for argument in sys.argv[1:3])
    for test in (test_faust, test_landmarks):
        with tempfile.TemporaryDirectory() as folder:
            test(program, root, Path(folder))
    print("truth files as they should be")


if __name__ == "__main__":
    main()
