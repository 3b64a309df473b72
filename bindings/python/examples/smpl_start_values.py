"""Start values for fitting SMPL to a scan: translation, scale and the pose of each bone, from the joints.

python smpl_start_values.py scan.ply start.json [model.npz]

The model is your own: an .npz with SMPL's `J_regressor` (24, n; not sparse) and `v_template` (n, 3), or with its
joints in the rest pose as `J` (24, 3). Without one, the joints are written where SMPL counts them.
"""

import json
import sys
from typing import Any

import numpy as np
import numpy.typing as npt
import skelgen

Array = npt.NDArray[np.float64]

# SMPL's 24 joints, by skelgen's names; None: skelgen has no such joint.
JOINTS = [
    "crotch", "left_hip", "right_hip", "waist", "left_knee", "right_knee", None, "left_ankle", "right_ankle", "chest",
    "left_foot", "right_foot", "neck", None, None, "head", "left_shoulder", "right_shoulder", "left_elbow",
    "right_elbow", "left_wrist", "right_wrist", "left_hand", "right_hand",
]  # fmt: skip
PARENTS = [-1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 12, 13, 14, 16, 17, 18, 19, 20, 21]
# The joint that each bone of one direction leads to.
AHEAD = {1: 4, 2: 5, 4: 7, 5: 8, 7: 10, 8: 11, 12: 15, 16: 18, 17: 19, 18: 20, 19: 21, 20: 22, 21: 23}
TRUNK = [0, 1, 2, 3, 9, 12, 16, 17]


def rotation_between(a: Array, b: Array) -> Array:
    """The shortest rotation from one direction to another, (3, 3)."""
    a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
    axis, cosine = np.cross(a, b), float(a @ b)
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    turn: Array = np.eye(3) + cross + cross @ cross / max(1 + cosine, 1e-9)
    return turn


def best_rotation(rest: Array, found: Array) -> Array:
    """The rotation that brings centred points nearest to others (Kabsch), (3, 3)."""
    u, _, v = np.linalg.svd(rest.T @ found)
    turn: Array = v.T @ np.diag([1, 1, np.sign(np.linalg.det(v.T @ u.T))]) @ u.T
    return turn


def axis_angle(rotation: Array) -> Array:
    """A rotation as SMPL has it: its axis, as long as its angle."""
    angle = np.arccos(np.clip((np.trace(rotation) - 1) / 2, -1, 1))
    axis = np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]])
    turn: Array = axis * (0.5 * angle / max(float(np.sin(angle)), 1e-9))
    return turn


def start_values(rest: Array, joints: Array) -> dict[str, Any]:
    """Of SMPL's joints in the rest pose and where they are to be, (24, 3) each, NaN where that is not known."""
    trunk = [j for j in TRUNK if not np.isnan(joints[j]).any()]
    a, b = rest[trunk] - rest[trunk].mean(axis=0), joints[trunk] - joints[trunk].mean(axis=0)
    scale = float(np.sqrt((b**2).sum() / (a**2).sum()))
    turned = [best_rotation(a, b)] * 24  # each joint's turn in the world; the trunk's is that of all of it
    pose = np.zeros((24, 3))
    pose[0] = axis_angle(turned[0])
    for joint in range(1, 24):
        parent = turned[PARENTS[joint]]
        turned[joint] = parent
        if joint in AHEAD and not np.isnan(joints[[joint, AHEAD[joint]]]).any():
            now = parent @ (rest[AHEAD[joint]] - rest[joint])
            turned[joint] = rotation_between(now, joints[AHEAD[joint]] - joints[joint]) @ parent
        pose[joint] = axis_angle(parent.T @ turned[joint])
    return {
        "scale": scale,
        "transl": (joints[0] / scale - rest[0]).tolist(),
        "global_orient": pose[0].tolist(),
        "body_pose": pose[1:].ravel().tolist(),
    }


def main(scan: str, out: str, model: str = "") -> None:
    """Write the start values."""
    body = skelgen.extract(scan)
    joints = np.array([body[name] if name else [np.nan] * 3 for name in JOINTS])
    values: dict[str, Any] = {"joints": [None if np.isnan(j).any() else j.tolist() for j in joints]}
    if model:
        with np.load(model) as arrays:
            rest = arrays["J"] if "J" in arrays else arrays["J_regressor"] @ arrays["v_template"]
        values |= start_values(rest, joints)
    with open(out, "w", encoding="utf-8") as file:
        json.dump(values, file, indent=1)


if __name__ == "__main__":
    main(*sys.argv[1:])
