#!/usr/bin/env python3
"""Truth files of FAUST's registrations, by the joint regressor of SMPL: of your own copies of both.

faust.py REGISTRATIONS MODEL -o TRUTH: a folder of tr_reg_NNN.ply or .off (6890 vertices each), and SMPL's model or its regressor
alone (.npz, .npy, .pkl). Needs numpy, for PLY trimesh, and for a .pkl scipy, too.
"""

from __future__ import annotations

import argparse
import pickle
from pathlib import Path
from typing import Any

import numpy as np
from truth_file import MARKERS, Array, largest_distance, read_mesh, write_truth

# The joint of SMPL that stands for each of ours; the others of SMPL's spine have no like.
SMPL = {
    "crotch": 0, "left_hip": 1, "right_hip": 2, "left_knee": 4, "right_knee": 5, "left_ankle": 7, "right_ankle": 8,
    "left_foot": 10, "right_foot": 11, "neck": 12, "left_shoulder": 16, "right_shoulder": 17, "left_elbow": 18,
    "right_elbow": 19, "left_wrist": 20, "right_wrist": 21, "left_hand": 22, "right_hand": 23,
}  # fmt: skip
HEAD = 15
JOINTS = 24


class Plain(pickle.Unpickler):
    """Of a pickled model only arrays and sparse matrices are made; all else stays an empty object, whatever it would run."""

    class Other:
        def __init__(self, *_: Any) -> None:
            self.state: Any = None

        def __setstate__(self, state: Any) -> None:
            self.state = state

    def find_class(self, module: str, name: str) -> Any:
        if module.split(".")[0] in ("numpy", "scipy") and name in (
            "_reconstruct", "ndarray", "dtype", "scalar", "csc_matrix", "csr_matrix", "coo_matrix",
        ):  # fmt: skip
            return super().find_class(module, name)
        return self.Other


def read_regressor(path: Path) -> Array:
    """(24, vertices): each joint as a weighted mean of vertices."""
    if path.suffix == ".pkl":
        with path.open("rb") as file:
            found = Plain(file, encoding="latin1").load()["J_regressor"]
    else:
        found = np.load(path)
        if path.suffix == ".npz":
            found = found["J_regressor"]
    regressor = np.asarray(found.todense() if hasattr(found, "todense") else found, float)
    if (
        regressor.ndim != 2
        or regressor.shape[0] < JOINTS
        or not np.allclose(regressor[:JOINTS].sum(axis=1), 1, atol=1e-3)
    ):
        raise SystemExit(f"{path}: holds no regressor of SMPL's joints, {JOINTS} rows of weights that sum to one")
    return regressor[:JOINTS]


def main() -> None:
    parser = argparse.ArgumentParser(
        description="Makes truth files of FAUST's registrations by SMPL's joint regressor."
    )
    parser.add_argument("registrations", type=Path)
    parser.add_argument("model", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True, help="folder of truth files to write")
    options = parser.parse_args()
    regressor = read_regressor(options.model)
    meshes = sorted(path for path in options.registrations.iterdir() if path.suffix.lower() in (".off", ".ply"))
    if not meshes:
        raise SystemExit(f"{options.registrations}: holds no OFF or PLY file")
    for path in meshes:
        vertices, faces = read_mesh(path)
        if len(vertices) != regressor.shape[1]:
            raise SystemExit(f"{path}: has {len(vertices)} vertices, not the {regressor.shape[1]} that the model has")
        places = regressor @ vertices
        joints = {name: places[number] for name, number in SMPL.items()}
        markers = {name: joints[name] for name in MARKERS} | {"head": places[HEAD]}
        source = "SMPL joint regressor on the registered mesh"
        write_truth(
            options.output / f"{path.stem}.json", path.name, largest_distance(vertices, faces), source, joints, markers
        )
    print(f"{len(meshes)} truth files in {options.output}")


if __name__ == "__main__":
    main()
