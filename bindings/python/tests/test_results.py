"""What is made of a body is what the program makes of it, is shown, stored and pickled."""

from __future__ import annotations

import copy
import csv
import json
import pickle
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import skelgen
from conftest import program, program_file, program_json, without_timings


def test_segmentation(body: skelgen.Extraction, sample: Path, workplace: Path) -> None:
    found = body.segment()
    assert found.to_dict() == program_json("segment", "-q", sample)
    assert body.segment("body").to_dict() == program_json("segment", "-q", sample, "--parts", "body")
    assert found.mask("head").sum() == (found.vertex_part == 0).sum() > 0
    assert found.colours.shape == (len(body.vertices), 3)
    found.save(workplace / "parts.json")
    assert json.loads((workplace / "parts.json").read_text()) == found.to_dict()
    found.save(workplace / "parts.ply")
    program("segment", "-q", sample, "-o", workplace / "theirs.ply")
    assert (workplace / "parts.ply").read_bytes() == (workplace / "theirs.ply").read_bytes()


def test_measures(body: skelgen.Extraction, sample: Path) -> None:
    measures = body.measure()
    theirs = program_json("measure", "-q", sample)
    theirs["bodies"][0]["mesh"]["file"] = "body.off"  # there with its folder
    assert measures.to_dict() == theirs
    assert set(measures.row()) >= {"height", "length_left_calf", "girth_waist"}
    assert measures.unit == "m"
    place, normal = measures.girth_places["waist"]
    assert np.linalg.norm(normal) == pytest.approx(1)
    assert np.linalg.norm(place - body["waist"]) < 0.2
    in_feet = skelgen.measure(body.vertices / 0.3048, body.faces)
    assert in_feet.unit is None  # no person is that high in metres, centimetres or millimetres
    assert in_feet.height == pytest.approx(measures.height / 0.3048, rel=1e-6)


def test_alignment(body: skelgen.Extraction, sample: Path, workplace: Path) -> None:
    aligned = body.align(origin="floor", scale=True)
    program("align", "-q", sample, "-o", workplace / "aligned", "--origin", "floor", "--scale")
    theirs = json.loads((workplace / "aligned" / "body.transform.json").read_text())
    assert aligned.to_dict() == theirs
    assert aligned.vertices[:, 1].min() == pytest.approx(0, abs=1e-9)
    moved = body.vertices @ aligned.matrix[:3, :3].T + aligned.matrix[:3, 3]
    np.testing.assert_allclose(aligned.vertices, moved, atol=1e-9)


@pytest.mark.parametrize(
    ("extension", "rest"), [("glb", "as-is"), ("glb", "a-pose"), ("vrm", "t-pose"), ("bvh", "as-is")]
)
def test_rig(body: skelgen.Extraction, sample: Path, workplace: Path, extension: str, rest: str) -> None:
    rig = body.rig(rest=rest)
    rig.save(workplace / f"rig.{extension}", names="mixamo")
    theirs = workplace / "theirs" / f"rig.{extension}"
    theirs.parent.mkdir()
    program("rig", "-q", sample, "-o", theirs, "--rest", rest, "--names", "mixamo")
    assert (workplace / f"rig.{extension}").read_bytes() == theirs.read_bytes()
    np.testing.assert_allclose(rig.weights.sum(axis=1), 1)
    assert rig.joints.shape == (len(body.vertices), 4)
    assert rig.vertices.shape == body.vertices.shape


@pytest.mark.parametrize("fingers", ["on", "off", "auto"])
def test_fingers(body: skelgen.Extraction, sample: Path, workplace: Path, fingers: str) -> None:
    rig = body.rig(fingers=fingers)
    assert any("index" in name for name in rig.names) == (fingers != "off")
    rig.save("rig.glb")
    program("rig", "-q", sample, "-o", "theirs.glb", "--fingers", fingers)
    assert (workplace / "rig.glb").read_bytes() == (workplace / "theirs.glb").read_bytes()
    skeleton = skelgen.extract(sample, fingers=fingers)
    assert without_timings(skeleton.to_dict()) == program_json("extract", "-q", sample, "--fingers", fingers)
    assert skeleton.segment().to_dict() == body.segment().to_dict()
    assert pickle.loads(pickle.dumps(rig)).names == rig.names  # noqa: S301


def test_toes(body: skelgen.Extraction, sample: Path) -> None:
    toed = skelgen.extract(sample, toes=True)
    assert without_timings(toed.to_dict()) == program_json("extract", "-q", sample, "--toes")
    assert pickle.loads(pickle.dumps(body.rig(toes=True))).names == body.rig(toes=True).names  # noqa: S301


def test_a_template_with_fingers(body: skelgen.Extraction, sample: Path) -> None:
    assert skelgen.extract(sample, template="auto").template == "human21"
    hands = skelgen.extract(sample, template="human51")
    assert hands.template == "human51"
    assert hands.positions.shape == (51, 3)
    assert (hands.positions[:21] == body.positions).all()
    assert without_timings(hands.to_dict()) == program_json("extract", "-q", sample, "--template", "human51")


def test_animation(body: skelgen.Extraction, workplace: Path) -> None:
    rig = body.rig()
    moving = rig.animate("walk.bvh")
    assert (rig.animations, moving.animations) == ((), ("walk",))
    moving.save("walking.glb")
    program("animate", "-q", "body.off", "--bvh", "walk.bvh", "-o", "theirs.glb")
    assert (workplace / "walking.glb").read_bytes() == (workplace / "theirs.glb").read_bytes()
    assert pickle.loads(pickle.dumps(moving)).animations == ("walk",)  # noqa: S301
    assert rig.animate("walking.glb").animations == ("walking",)  # a scene that moves is a clip, too


def test_pose(body: skelgen.Extraction, workplace: Path) -> None:
    posed = body.pose(like=body)
    posed.save("posed.off")
    program("pose", "-q", "body.off", "--like", "body.off", "-o", "theirs.off")
    assert (workplace / "posed.off").read_bytes() == (workplace / "theirs.off").read_bytes()
    assert posed.skeleton.names == body.names
    by_file, by_skeleton = body.pose("body.json"), body.pose(skelgen.read_skeleton("body.json"))
    assert (by_file.vertices == by_skeleton.vertices).all()


@pytest.mark.parametrize("component", [1, 2])
def test_one_of_two_bodies(body: skelgen.Extraction, workplace: Path, component: int) -> None:
    count = len(body.vertices)
    vertices = np.concatenate([body.vertices, 0.8 * body.vertices + [3, 0, 0]])
    skelgen.convert((vertices, np.concatenate([body.faces, body.faces + count])), "two.off")
    chosen = skelgen.extract("two.off", component=component)
    rig, posed, aligned = chosen.rig(), chosen.pose(like="body.json"), chosen.align(origin="floor")
    for result in (rig, posed, aligned):
        assert (result.source_vertices == np.arange(count) + (component - 1) * count).all()
        assert (result.faces == body.faces).all()
    assert (body.rig().source_vertices == np.arange(count)).all()
    rig.save("rig.glb")
    posed.save("posed.off")
    program("rig", "-q", "two.off", "--component", component, "-o", "theirs.glb")
    program("pose", "-q", "two.off", "--component", component, "--pose", "body.json", "-o", "theirs.off")
    assert (workplace / "rig.glb").read_bytes() == (workplace / "theirs.glb").read_bytes()
    assert (workplace / "posed.off").read_bytes() == (workplace / "theirs.off").read_bytes()
    aligned.save("aligned.off")
    program("align", "-q", "two.off", "--component", component, "--origin", "floor", "-o", "theirs")
    assert (workplace / "aligned.off").read_bytes() == (workplace / "theirs" / "two.off").read_bytes()
    assert chosen.measure().to_dict() == program_json("measure", "-q", "two.off", "--component", component)
    maps = chosen.correspond(chosen)
    assert maps.to_dict() == program_json(
        *("correspond", "-q", "two.off", "two.off", "--confidence", "--places"),
        *("--from-component", component, "--component", component),
    )
    assert (maps.vertex_to_vertex // count == component - 1).all()
    assert chosen.segment().to_dict() == program_json("segment", "-q", "two.off", "--component", component)


def test_materials_are_kept(body: skelgen.Extraction, workplace: Path) -> None:
    skelgen.convert("body.off", "plain.obj")
    (workplace / "paint.mtl").write_text("newmtl vermilion\nKd 0.9 0.2 0.1\n")
    painted = "mtllib paint.mtl\nusemtl vermilion\n" + (workplace / "plain.obj").read_text()
    (workplace / "painted.obj").write_text(painted)
    skelgen.convert("painted.obj", "ours.glb")
    program("convert", "painted.obj", "theirs.glb")
    found = skelgen.extract("painted.obj")
    found.pose("body.json").save("ours_posed.glb")
    program("pose", "-q", "painted.obj", "--pose", "body.json", "-o", "theirs_posed.glb")
    found.rig().save("ours_rigged.glb")
    program("rig", "-q", "painted.obj", "-o", "theirs_rigged.glb")
    for kind in ("", "_posed", "_rigged"):
        ours, theirs = ((workplace / f"{whose}{kind}.glb").read_bytes() for whose in ("ours", "theirs"))
        assert b"vermilion" in ours
        assert ours == theirs
    moved = skelgen.Mesh(body.vertices, body.faces)
    moved.save("moved.glb")
    assert b"vermilion" not in (workplace / "moved.glb").read_bytes()


def test_correspondence(body: skelgen.Extraction, sample: Path) -> None:
    found = body.correspond(sample)
    assert found.to_dict() == program_json("correspond", "-q", sample, sample, "--confidence", "--places")
    assert found.transfer(body.vertices).shape == body.vertices.shape
    np.testing.assert_allclose(found.weights.sum(axis=1), 1)
    assert (found.corners == body.faces[found.vertex_to_face]).all()
    apart = np.linalg.norm(found.transfer(body.vertices, smooth=True) - body.vertices, axis=1)
    assert apart.mean() < 1e-3 * body.geodesic_diameter
    for several in ([body, sample], (body, sample), iter([body, sample])):
        assert [one.to_dict() for one in skelgen.correspond(body, several)] == [found.to_dict()] * 2


def test_results_are_stored(body: skelgen.Extraction, workplace: Path) -> None:
    body.save("skeleton.json")
    assert skelgen.read_skeleton("skeleton.json") == body
    body.measure().save("measures.json")
    assert json.loads((workplace / "measures.json").read_text()) == body.measure().to_dict()
    body.curve.save("curve.swc")
    assert (workplace / "curve.swc").read_text().startswith("#")
    for name in ("copy.ply", "copy.obj", "copy.glb", "copy.stl", "copy.off.gz"):
        skelgen.convert(body, name) if name != "copy.obj" else skelgen.convert("body.off", name)
        assert skelgen.read(name).faces.shape == body.faces.shape


def results(body: skelgen.Extraction) -> list[Any]:
    return [
        body,
        body.segment(),
        body.measure(),
        body.align(),
        body.pose(body),
        body.curve,
        body.rig(),
        skelgen.Skeleton.from_dict(body.to_dict()),
        skelgen.Mesh(body.vertices, body.faces),
        body.correspond(body),
    ]


def test_results_are_pickled_and_copied(body: skelgen.Extraction) -> None:
    for result in results(body):
        for again in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result)):  # noqa: S301
            assert repr(again) == repr(result)
            assert type(again) is type(result)


def test_a_pickled_extraction_is_of_use(body: skelgen.Extraction) -> None:
    again = pickle.loads(pickle.dumps(body))  # noqa: S301
    assert again == body
    assert again.segment().to_dict() == body.segment().to_dict()


def test_a_pickled_refusal_says_why() -> None:
    error = pickle.loads(pickle.dumps(skelgen.NoSkeletonError("none", "no_body", [{"surface": "s"}])))  # noqa: S301
    assert (str(error), error.code, error.trail) == ("none", "no_body", [{"surface": "s"}])


def test_repr_is_one_line(body: skelgen.Extraction) -> None:
    for result in results(body):
        assert repr(result).startswith(type(result).__name__ + "(")
        assert "\n" not in repr(result)


def test_notebooks_get_a_picture(body: skelgen.Extraction) -> None:
    page = body._repr_html_()
    assert page.count("<circle") == 21
    assert "left_knee" in page
    assert "nan" not in page
    across = [
        float(page.split(f"<title>{side}_hip")[0].rsplit('cx="', 1)[1].split('"')[0]) for side in ("left", "right")
    ]
    assert across[0] > across[1]  # as one sees a person from the front
    for result in results(body):
        if not isinstance(result, skelgen.Correspondence):
            page = result._repr_html_()
            assert page.count("<svg") + page.count("<table>") == 1
            assert "nan" not in page
    assert body.segment()._repr_html_().count("<path") == len(body.segment().parts)


def test_results_cannot_be_changed(body: skelgen.Extraction) -> None:
    with pytest.raises(ValueError, match="read-only"):
        body.positions[0] = 0
    body.to_dict()["joints"].clear()
    assert len(body.to_dict()["joints"]) == 21


def test_batch(workplace: Path) -> None:
    (workplace / "sub").mkdir()
    (workplace / "sub" / "torn.off").write_text("OFF\n1")
    skelgen.convert("body.off", "sub/body.ply")
    found = skelgen.batch(workplace, jobs=2)
    assert len(found) == 3
    rows = [next(found).row(), *(result.row() for result in found)]
    assert [(Path(row["file"]).name, row["status"]) for row in rows] == [
        ("body.off", "ok"),
        ("body.ply", "ok"),
        ("torn.off", "bad_input"),
    ]
    assert rows[0]["crotch_x"] == rows[1]["crotch_x"]
    assert "torn.off" in rows[2]["error"]
    assert len(skelgen.batch("sub/*.ply")) == 1


def test_tables_are_those_of_the_program(workplace: Path) -> None:
    (workplace / "in").mkdir()
    skelgen.convert("body.off", "in/body.ply")
    (workplace / "in" / "torn.off").write_text("OFF\n1")
    ran = subprocess.run(  # noqa: S603
        [program_file(), "batch", "-q", "in", "-o", "out", "--csv", "bodies.csv", "--npz", "bodies.npz"],
        capture_output=True,
        check=False,
    )
    assert ran.returncode == 5
    with (workplace / "bodies.csv").open(newline="", encoding="utf-8") as file:
        theirs = list(csv.DictReader(file))
    ours = [result.row(measures=True) for result in skelgen.batch("in", jobs=1)]
    columns = [name for name in ours[0] if name not in {"file", "error", "seconds"}]
    assert list(theirs[0]) == list(ours[0])
    for name in columns:
        if isinstance(value := ours[0][name], float):
            assert float(theirs[0][name]) == value
        else:
            assert theirs[0][name] == str(value)
    assert [row["status"] for row in theirs] == ["ok", "bad_input"]
    with np.load("bodies.npz") as arrays:
        assert arrays["files"].tolist() == ["body.ply", "torn.off"]
        assert arrays["status"].tolist() == ["ok", "bad_input"]
        assert arrays["positions"].shape == (2, 21, 3)
        knee = arrays["joints"].tolist().index("left_knee")
        assert arrays["positions"][0, knee].tolist() == [ours[0][f"left_knee_{axis}"] for axis in "xyz"]
        assert np.isnan(arrays["positions"][1]).all()
        assert arrays["measured"][0, arrays["measures"].tolist().index("height")] == ours[0]["height"]
        assert arrays["radius"].shape == arrays["confidence"].shape == (2, 21)


def test_batch_for_pandas(workplace: Path) -> None:
    pandas = pytest.importorskip("pandas")
    table = pandas.DataFrame(result.row() for result in skelgen.batch(workplace / "body.off"))
    assert table.loc[0, "status"] == "ok"
    assert table.filter(regex="_[xyz]$").shape == (1, 63)
