"""Calls that make no sense: each is a typed error that says what is wrong, none a crash."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import skelgen


@dataclass
class Given:
    """What wrong calls are made with."""

    v: Any  # vertices
    f: Any  # faces
    body: skelgen.Extraction
    folder: Path

    def vertices(self, vertex: int, value: Any) -> Any:  # noqa: ANN401
        out = self.v.copy()
        out[vertex] = value
        return out

    def faces(self, face: int, value: Any, dtype: Any = np.int64) -> Any:  # noqa: ANN401
        out = self.f.astype(dtype)
        out[face] = value
        return out

    def file(self, name: str, content: bytes) -> Path:
        path = self.folder / name
        path.write_bytes(content)
        return path


@pytest.fixture
def given(mesh: skelgen.Mesh, body: skelgen.Extraction, workplace: Path) -> Given:
    return Given(mesh.vertices, mesh.faces, body, workplace)


class Odd:
    """Has vertices, but no faces."""

    vertices = np.zeros((4, 3))


def no_bones(given: Given) -> skelgen.Skeleton:
    document = given.body.to_dict()
    for joint in document["joints"]:
        joint["position"] = [0.0, 0.0, 0.0]
    return skelgen.Skeleton.from_dict(document)


WRONG: list[tuple[str, Callable[[Given], Any], type[Exception], str]] = [
    # arrays of vertices
    ("flat vertices", lambda g: skelgen.extract(g.v.ravel(), g.f), ValueError, r"vertices: an array of shape \(\d+,\)"),
    ("vertices in a plane", lambda g: skelgen.extract(g.v[:, :2], g.f), ValueError, r"vertices: .*, 2\), not \(n, 3\)"),
    ("vertices of 4", lambda g: skelgen.extract(np.c_[g.v, g.v[:, 0]], g.f), ValueError, r"vertices: .*, 4\)"),
    ("vertices transposed", lambda g: skelgen.extract(g.v.T, g.f), ValueError, r"vertices: an array of shape \(3, "),
    ("vertices in 3 axes", lambda g: skelgen.extract(g.v[None], g.f), ValueError, r"vertices: an array of shape \(1, "),
    ("no vertices", lambda g: skelgen.extract(np.zeros((0, 3)), g.f), ValueError, r"vertices: .*\(0, 3\)"),
    ("three vertices", lambda g: skelgen.extract(g.v[:3], g.f), ValueError, r"vertices: .*\(3, 3\)"),
    ("vertices a number", lambda g: skelgen.extract(1.5, g.f), ValueError, r"vertices: an array of shape \(\)"),
    ("vertices None", lambda g: skelgen.extract(None, g.f), ValueError, r"vertices: "),
    ("complex vertices", lambda g: skelgen.extract(g.v.astype(complex), g.f), ValueError, "vertices: .*complex128"),
    ("vertices yes and no", lambda g: skelgen.extract(g.v > 0, g.f), ValueError, "vertices: .*bool"),
    ("vertices of text", lambda g: skelgen.extract(g.v.astype(str), g.f), ValueError, "vertices: .*<U"),
    ("vertices of objects", lambda g: skelgen.extract(g.v.astype(object), g.f), ValueError, "vertices: .*object"),
    ("ragged vertices", lambda g: skelgen.extract([[0, 1, 2], [0, 1]], g.f), ValueError, "vertices: "),
    ("a vertex nowhere", lambda g: skelgen.extract(g.vertices(9, np.nan), g.f), ValueError, "vertices: .*vertex 9 are"),
    ("a vertex far out", lambda g: skelgen.extract(g.vertices(8, np.inf), g.f), ValueError, "vertices: .*vertex 8 are"),
    ("a coordinate", lambda g: skelgen.extract(g.vertices((7, 2), -np.inf), g.f), ValueError, "vertices: .*vertex 7 a"),
    (
        "too large",
        lambda g: skelgen.extract(g.v.astype(np.longdouble) * np.longdouble("1e4000"), g.f),
        ValueError,
        "fin",
    ),
    # arrays of faces
    ("flat faces", lambda g: skelgen.extract(g.v, g.f.ravel()), ValueError, r"faces: an array of shape \(\d+,\)"),
    ("edges as faces", lambda g: skelgen.extract(g.v, g.f[:, :2]), ValueError, r"faces: .*, 2\), not \(m, 3\)"),
    ("quads", lambda g: skelgen.extract(g.v, np.c_[g.f, g.f[:, 0]]), ValueError, r"faces: .*, 4\)"),
    ("no faces", lambda g: skelgen.extract(g.v, np.zeros((0, 3), int)), ValueError, r"faces: .*\(0, 3\)"),
    ("real faces", lambda g: skelgen.extract(g.v, g.f.astype(float)), ValueError, "faces: .*float64"),
    ("faces yes and no", lambda g: skelgen.extract(g.v, g.f > 0), ValueError, "faces: .*bool"),
    ("ragged faces", lambda g: skelgen.extract(g.v, [[0, 1, 2], [0, 1]]), ValueError, "faces: "),
    ("a face of -1", lambda g: skelgen.extract(g.v, g.faces(3, -1)), ValueError, "faces: names vertex -1"),
    ("a face too far", lambda g: skelgen.extract(g.v, g.faces(3, len(g.v))), ValueError, "faces: names vertex 6890"),
    ("int32 -1", lambda g: skelgen.extract(g.v, g.faces(3, -1, np.int32)), ValueError, "faces: face 3 names vertex -1"),
    (
        "int32 too far",
        lambda g: skelgen.extract(g.v, g.faces(4, 6890, np.int32)),
        ValueError,
        "face 4 names vertex 6890",
    ),
    ("wraps around", lambda g: skelgen.extract(g.v, g.faces(3, 2**32)), ValueError, "faces: names vertex 4294967296"),
    (
        "huge unsigned",
        lambda g: skelgen.extract(g.v, g.faces(3, 2**64 - 1, np.uint64)),
        ValueError,
        "faces: names vertex 1",
    ),
    ("one vertex", lambda g: skelgen.extract(g.v, np.zeros((50, 3), int)), ValueError, ""),
    ("one place", lambda g: skelgen.extract(np.zeros_like(g.v), g.f), ValueError, ""),
    ("on a line", lambda g: skelgen.extract(g.v * [1, 0, 0], g.f), ValueError, ""),
    ("in a plane", lambda g: skelgen.extract(g.v * [1, 1, 0], g.f), (ValueError, skelgen.NoSkeletonError), ""),
    # other meshes
    ("no mesh", lambda _: skelgen.extract(object()), ValueError, "mesh: object has no vertices and faces"),
    ("a number", lambda _: skelgen.extract(3), ValueError, "mesh: int has no"),
    ("None", lambda _: skelgen.extract(None), ValueError, "mesh: NoneType has no"),
    ("an array alone", lambda g: skelgen.extract(g.v), ValueError, "mesh: ndarray has no"),
    ("without faces", lambda _: skelgen.extract(Odd()), ValueError, "mesh: Odd has no"),
    ("one of two bodies", lambda g: skelgen.extract(g.v, g.f, component=2), ValueError, "number 2"),
    # files
    ("no file", lambda _: skelgen.extract("nowhere.off"), FileNotFoundError, "nowhere.off"),
    ("a folder", lambda g: skelgen.extract(g.folder), ValueError, ""),
    ("an empty file", lambda g: skelgen.extract(g.file("empty.off", b"")), ValueError, "empty.off"),
    ("a torn file", lambda g: skelgen.extract(g.file("torn.ply", b"ply\nformat ascii 1.0\n")), ValueError, "torn.ply"),
    ("noise", lambda g: skelgen.extract(g.file("noise.stl", bytes(range(256)) * 9)), ValueError, "noise.stl"),
    ("no animation", lambda _: skelgen.read("body.off", animation="run"), ValueError, ""),
    ("unknown format", lambda g: skelgen.convert(g.body, "body.xyz"), ValueError, "body.xyz"),
    ("no folder", lambda g: g.body.save("nowhere/body.json"), OSError, "nowhere"),
    ("no folder for a mesh", lambda g: g.body.align().save("nowhere/body.ply"), OSError, "nowhere"),
    ("no folder for a rig", lambda g: g.body.rig().save("nowhere/body.glb"), OSError, "nowhere"),
    ("no folder for a curve", lambda g: g.body.curve.save("nowhere/body.swc"), OSError, "nowhere"),
    ("no folder for parts", lambda g: g.body.segment().save("nowhere/body.ply"), OSError, "nowhere"),
    ("no skeleton file", lambda _: skelgen.read_skeleton("body.off"), ValueError, "body.off"),
    ("no skeleton at all", lambda _: skelgen.read_skeleton("none.json"), FileNotFoundError, "none.json"),
    ("half a skeleton", lambda _: skelgen.Skeleton.from_dict({"format": "skelgen-skeleton"}), ValueError, "missing"),
    ("nothing to do", lambda _: skelgen.batch("*.nothing"), ValueError, "paths: there is no mesh at"),
    # options
    ("no template", lambda g: skelgen.extract(g.v, g.f, template="human99"), ValueError, "template: 'human99'"),
    ("template 5", lambda g: skelgen.extract(g.v, g.f, template=5), TypeError, "template: 5 is not"),  # type: ignore[arg-type]
    ("fingers yes", lambda g: skelgen.extract(g.v, g.f, fingers=True), TypeError, "fingers: True is not"),  # type: ignore[arg-type]
    ("threads None", lambda g: skelgen.extract(g.v, g.f, threads=None), TypeError, "threads: None is not"),  # type: ignore[arg-type]
    ("fingers", lambda g: skelgen.extract(g.v, g.f, fingers="six"), ValueError, "fingers: 'six' is none of"),
    ("fingers of a rig", lambda g: g.body.rig(fingers="six"), ValueError, "fingers: 'six' is none of"),
    ("component -1", lambda g: skelgen.extract(g.v, g.f, component=-1), ValueError, "component"),
    ("component x", lambda g: skelgen.extract(g.v, g.f, component="x"), TypeError, "component: 'x' is"),  # type: ignore[arg-type]
    ("threads 0", lambda g: skelgen.extract(g.v, g.f, threads=0), ValueError, "threads"),
    ("threads 10^12", lambda g: skelgen.extract(g.v, g.f, threads=10**12), (TypeError, ValueError), ""),
    ("unknown option", lambda g: skelgen.extract(g.v, g.f, speed=3), TypeError, "speed"),  # type: ignore[call-arg]
    ("no name", lambda g: skelgen.extract(g.v, g.f, name=""), ValueError, "name: '' is no name"),
    ("parts", lambda g: g.body.segment("organs"), ValueError, "parts: 'organs' is none of bones, body"),
    ("a part", lambda g: g.body.segment().mask("tail"), KeyError, "tail.*head, neck"),
    ("a joint", lambda g: g.body["tail"], KeyError, "tail.*left_knee"),
    ("a joint's number", lambda g: g.body[0], KeyError, "0 is none of"),
    ("joints one by one", lambda g: list(g.body), TypeError, "not iterable"),  # type: ignore[call-overload]
    ("rest", lambda g: g.body.rig(rest="x-pose"), ValueError, "rest: 'x-pose' is none of"),
    ("names", lambda g: g.body.rig().save("x.glb", names="maya"), ValueError, "names: 'maya' is none of .*mixamo, vrm"),
    ("a rig as text", lambda g: g.body.rig().save("x.txt"), ValueError, "x.txt"),
    ("VRM as it is", lambda g: g.body.rig().save("x.vrm"), ValueError, ""),
    ("BVH that moves", lambda g: g.body.rig().animate("walk.bvh").save("x.bvh"), ValueError, "x.bvh"),
    ("no clip", lambda g: g.body.rig().animate("run.bvh"), FileNotFoundError, "run.bvh"),
    ("a mesh as clip", lambda g: g.body.rig().animate("body.off"), ValueError, "body.off"),
    ("origin", lambda g: g.body.align("head"), ValueError, "origin: 'head' is none of"),
    ("like nothing", lambda g: g.body.pose(None), ValueError, "mesh: NoneType"),
    ("without bones", lambda g: g.body.pose(no_bones(g)), ValueError, "bones"),
    (
        "values",
        lambda g: g.body.correspond(g.body).transfer(g.v[:9]),
        ValueError,
        r"values: an array of shape \(9, 3\)",
    ),
    ("detail", lambda g: skelgen.curve(g.v, g.f, detail="hairs"), ValueError, "detail: 'hairs' is none of"),
    ("spacing", lambda g: skelgen.curve(g.v, g.f, spacing=-1), ValueError, "spacing"),
    ("spacing nowhere", lambda g: skelgen.curve(g.v, g.f, spacing=np.nan), ValueError, "spacing"),
    ("a curve as text", lambda g: g.body.curve.save("curve.txt"), ValueError, "curve.txt"),
    ("measures as text", lambda g: g.body.measure().save("measures.txt"), ValueError, "measures.txt"),
    ("options of a batch", lambda g: skelgen.batch(g.folder, template="human99"), ValueError, "human99"),
    ("an option of a batch", lambda g: skelgen.batch(g.folder, speed=3), TypeError, "speed"),
    ("half a job", lambda g: skelgen.batch(g.folder, jobs=1.5), TypeError, ""),  # type: ignore[arg-type]
    ("jobs", lambda g: skelgen.batch(g.folder, jobs=0), ValueError, "jobs: 0"),
]


@pytest.mark.parametrize(("call", "error", "message"), [w[1:] for w in WRONG], ids=[w[0] for w in WRONG])
def test_wrong_call(given: Given, call: Callable[[Given], Any], error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message or None):
        call(given)


def test_there_are_enough() -> None:
    assert len(WRONG) >= 60
    assert len({name for name, *_ in WRONG}) == len(WRONG)


@pytest.mark.usefixtures("workplace")
def test_nothing_is_left_of_a_failed_write(body: skelgen.Extraction, workplace: Path) -> None:
    before = sorted(workplace.iterdir())
    with pytest.raises(ValueError, match=r"posed\.xyz"):
        body.pose(body).save("posed.xyz")
    assert sorted(workplace.iterdir()) == before
