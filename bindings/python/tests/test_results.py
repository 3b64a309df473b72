"""What is made of a body is what the program makes of it, is shown, stored and pickled."""

from __future__ import annotations

import copy
import json
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import skelgen
from conftest import program, program_json


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


def test_animation(body: skelgen.Extraction, workplace: Path) -> None:
    rig = body.rig()
    moving = rig.animate("walk.bvh")
    assert (rig.animations, moving.animations) == ((), ("walk",))
    moving.save("walking.glb")
    program("animate", "-q", "body.off", "--bvh", "walk.bvh", "-o", "theirs.glb")
    assert (workplace / "walking.glb").read_bytes() == (workplace / "theirs.glb").read_bytes()
    assert pickle.loads(pickle.dumps(moving)).animations == ("walk",)  # noqa: S301


def test_pose(body: skelgen.Extraction, workplace: Path) -> None:
    posed = body.pose(like=body)
    posed.save("posed.off")
    program("pose", "-q", "body.off", "--like", "body.off", "-o", "theirs.off")
    assert (workplace / "posed.off").read_bytes() == (workplace / "theirs.off").read_bytes()
    assert posed.skeleton.names == body.names
    by_file, by_skeleton = body.pose("body.json"), body.pose(skelgen.read_skeleton("body.json"))
    assert (by_file.vertices == by_skeleton.vertices).all()


def test_correspondence(body: skelgen.Extraction, sample: Path) -> None:
    found = body.correspond(sample)
    assert found.to_dict() == program_json("correspond", "-q", sample, sample, "--confidence")
    assert found.transfer(body.vertices).shape == body.vertices.shape
    many = skelgen.correspond(body, [body, sample])
    assert [one.to_dict() for one in many] == [found.to_dict()] * 2


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
    rows = [result.row() for result in found]
    assert [(Path(row["file"]).name, row["status"]) for row in rows] == [
        ("body.off", "ok"),
        ("body.ply", "ok"),
        ("torn.off", "bad_input"),
    ]
    assert rows[0]["crotch_x"] == rows[1]["crotch_x"]
    assert "torn.off" in rows[2]["error"]
    assert len(skelgen.batch("sub/*.ply")) == 1


def test_batch_for_pandas(workplace: Path) -> None:
    pandas = pytest.importorskip("pandas")
    table = pandas.DataFrame(result.row() for result in skelgen.batch(workplace / "body.off"))
    assert table.loc[0, "status"] == "ok"
    assert table.filter(regex="_[xyz]$").shape == (1, 63)
