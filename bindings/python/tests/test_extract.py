"""Skeletons are those of the program, whatever holds the mesh."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import skelgen
from conftest import program_json, real_bodies, without_timings


def test_is_the_programs_file(sample: Path, body: skelgen.Extraction) -> None:
    assert without_timings(body.to_dict()) == program_json("extract", sample)


def test_arrays_are_those_of_the_file(body: skelgen.Extraction) -> None:
    joints = body.to_dict()["joints"]
    assert body.names == tuple(joint["name"] for joint in joints)
    assert body.positions.shape == (21, 3)
    assert body.positions.tolist() == [joint["position"] for joint in joints]
    assert body.radius.tolist() == [joint["radius"] for joint in joints]
    assert [body.names[p] if p >= 0 else None for p in body.parents] == [joint["parent"] for joint in joints]
    assert body.present.all()
    assert body["left_knee"].tolist() == body.positions[body.names.index("left_knee")].tolist()
    assert body["head_top"].tolist() == body.to_dict()["end_points"]["head_top"]


@pytest.mark.parametrize("path", real_bodies() or [None], ids=lambda p: p.stem if p else "none")
def test_real_bodies_are_the_programs_to_the_last_bit(path: Path | None) -> None:
    if path is None:
        pytest.skip("SKELGEN_BODIES is not set")
    mesh = skelgen.read(path)
    try:
        found = skelgen.extract(mesh.vertices, mesh.faces, name=path.name)
    except skelgen.NoSkeletonError:
        pytest.skip("no skeleton in it")
    assert without_timings(found.to_dict()) == program_json("extract", "-q", path)


@pytest.mark.parametrize(
    "change",
    [
        np.asfortranarray,
        lambda v: v.astype(">f8"),
        lambda v: np.hstack([v, v])[:, :3],
        lambda v: v.tolist(),
        lambda v: np.vstack([v[:1], v])[1:],  # at an address that no vector instruction loads from
    ],
    ids=["columns first", "big endian", "strided", "lists", "misaligned"],
)
def test_whatever_the_layout(mesh: skelgen.Mesh, body: skelgen.Extraction, change: Any) -> None:  # noqa: ANN401
    assert skelgen.extract(change(mesh.vertices), mesh.faces, name="body.off") == body


@pytest.mark.parametrize("dtype", [np.int64, np.uint32, np.int16, np.uint64])
def test_whatever_the_indices(mesh: skelgen.Mesh, body: skelgen.Extraction, dtype: type) -> None:
    assert skelgen.extract(mesh.vertices, mesh.faces.astype(dtype), name="body.off") == body


def test_single_precision_is_converted(mesh: skelgen.Mesh, body: skelgen.Extraction) -> None:
    found = skelgen.extract(mesh.vertices.astype(np.float32), mesh.faces)
    np.testing.assert_allclose(found.positions, body.positions, atol=1e-4 * body.geodesic_diameter)


def test_arrays_are_kept_not_copied(mesh: skelgen.Mesh) -> None:
    vertices, faces = mesh.vertices.copy(), mesh.faces.copy()
    found = skelgen.extract(vertices, faces)
    assert found.vertices is vertices
    assert found.faces is faces


def test_read_only_arrays_do(mesh: skelgen.Mesh, body: skelgen.Extraction) -> None:
    vertices = mesh.vertices.copy()
    vertices.flags.writeable = False
    assert skelgen.extract(vertices, mesh.faces, name="body.off") == body


def test_arrays_stay_as_they_are(mesh: skelgen.Mesh) -> None:
    vertices, faces = mesh.vertices.copy(), mesh.faces.copy()
    body = skelgen.extract(vertices, faces)
    body.segment()
    body.rig(rest="t-pose")
    assert (vertices == mesh.vertices).all()
    assert (faces == mesh.faces).all()


def test_threads_make_no_difference(mesh: skelgen.Mesh, body: skelgen.Extraction) -> None:
    assert skelgen.extract(mesh.vertices, mesh.faces, name="body.off", threads=2) == body


def test_a_pair_is_a_mesh(mesh: skelgen.Mesh, body: skelgen.Extraction) -> None:
    assert skelgen.extract((mesh.vertices, mesh.faces), name="body.off") == body


def test_trimesh(mesh: skelgen.Mesh, body: skelgen.Extraction) -> None:
    trimesh = pytest.importorskip("trimesh")
    theirs = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    assert skelgen.extract(theirs, name="body.off") == body
    assert skelgen.extract(trimesh.Scene(theirs), name="body.off") == body


def test_open3d(mesh: skelgen.Mesh, body: skelgen.Extraction) -> None:
    o3d = pytest.importorskip("open3d", exc_type=ImportError)  # it may lack a library of the system
    legacy = o3d.geometry.TriangleMesh(
        o3d.utility.Vector3dVector(mesh.vertices), o3d.utility.Vector3iVector(mesh.faces)
    )
    assert skelgen.extract(legacy, name="body.off") == body
    tensors = o3d.t.geometry.TriangleMesh(o3d.core.Tensor(mesh.vertices), o3d.core.Tensor(mesh.faces))
    assert skelgen.extract(tensors, name="body.off") == body


def test_pyvista(mesh: skelgen.Mesh, body: skelgen.Extraction) -> None:
    pyvista = pytest.importorskip("pyvista")
    theirs = pyvista.PolyData.from_regular_faces(mesh.vertices, mesh.faces)
    assert skelgen.extract(theirs, name="body.off") == body


def test_meshio(mesh: skelgen.Mesh, body: skelgen.Extraction) -> None:
    meshio = pytest.importorskip("meshio")
    theirs = meshio.Mesh(mesh.vertices, [("line", mesh.faces[:3, :2]), ("triangle", mesh.faces)])
    assert skelgen.extract(theirs, name="body.off") == body


class Polygons:
    """As PyVista has them: each face's number of corners before these."""

    def __init__(self, points: list[list[float]], faces: list[int]) -> None:
        self.points = points
        self.faces = np.array(faces)


def test_polygons_are_cut_into_triangles() -> None:
    corners = [[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 9.0)]
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    box = Polygons(corners, [n for quad in quads for n in (4, *quad)])
    curve = skelgen.curve(box, detail="all")
    assert len(curve.nodes) >= 2
    np.testing.assert_allclose(np.median(curve.nodes, axis=0), [0.5, 0.5, 4.5], atol=0.3)


def test_missing_joints_have_no_place(mesh: skelgen.Mesh, body: skelgen.Extraction) -> None:
    wrist, elbow = body["left_wrist"], body["left_elbow"]
    cut = (mesh.vertices - (0.5 * (wrist + elbow))) @ (wrist - elbow) > 0
    arm = skelgen.extract(mesh.vertices, mesh.faces).segment().vertex_part
    names = skelgen.segment(body).parts
    gone = cut & np.isin(arm, [names.index("left_forearm"), names.index("left_hand")])
    found = skelgen.extract(mesh.vertices, mesh.faces[~gone[mesh.faces].any(axis=1)])
    hand = found.names.index("left_hand")
    assert not found.present[hand]
    assert np.isnan(found.positions[hand]).all()
    assert found.confidence[hand] == 0
    assert "missing" in repr(found)


def test_no_body_is_refused_with_a_code() -> None:
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    with pytest.raises(skelgen.NoSkeletonError) as raised:
        skelgen.extract(corners, faces)
    assert raised.value.code
    assert isinstance(raised.value.trail, list)


def test_curve(body: skelgen.Extraction, sample: Path) -> None:
    alone = skelgen.curve(sample)
    assert alone.to_dict() == program_json("curve", sample, "-o", "-")
    assert sorted(v for region in alone.regions for v in region.tolist()) == list(range(len(body.vertices)))
    assert len(body.curve.nodes) == len(body.curve.radii)


def test_curve_for_networkx(sample: Path) -> None:
    nx = pytest.importorskip("networkx")
    curve = skelgen.curve(sample)
    graph = curve.to_networkx()
    assert nx.is_tree(graph)
    assert graph.number_of_edges() == len(curve.edges)
    assert graph.nodes[0]["position"].tolist() == curve.nodes[0].tolist()
