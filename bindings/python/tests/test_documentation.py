"""What the documentation shows is run: docstrings, README, examples, the notebook."""

from __future__ import annotations

import doctest
import importlib
import inspect
import pkgutil
import re
import runpy
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
import skelgen
from conftest import ROOT, SAMPLE

EXAMPLES = ROOT / "bindings" / "python" / "examples"
MODULES = [m.name for m in pkgutil.iter_modules(skelgen.__path__) if m.name != "_core"]


@pytest.mark.parametrize("name", MODULES)
@pytest.mark.usefixtures("workplace")
def test_docstrings(name: str) -> None:
    module = importlib.import_module(f"skelgen.{name}")
    result = doctest.testmod(module, extraglobs={"skelgen": skelgen})
    assert result.failed == 0


def test_each_function_has_an_example() -> None:
    functions = [getattr(skelgen, name) for name in skelgen.__all__ if inspect.isfunction(getattr(skelgen, name))]
    methods = [f for name, f in inspect.getmembers(skelgen.Extraction, inspect.isfunction) if not name.startswith("_")]
    assert len(functions) > 8
    for function in [*functions, *methods]:
        text = inspect.getdoc(function) or ""
        refers = "`Extraction." in text  # the method there has the example
        inherited = function.__qualname__.split(".")[0] == "Skeleton"
        assert ">>>" in text or refers or inherited, f"{function.__qualname__} has no example"
        assert inspect.getdoc(function)


def test_readme(workplace: Path) -> None:
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    assert blocks
    (workplace / "scans").mkdir()
    for scan in ("scan.ply", "scans/a.ply", "adult.ply", "child.ply"):
        skelgen.convert(SAMPLE / "body.off", scan)
    for block in blocks:
        exec(compile(block, "README.md", "exec"), {})  # noqa: S102


@pytest.mark.parametrize(
    ("script", "needs", "arguments", "out"),
    [
        ("joint_table.py", [], ["scans", "joints.csv"], "joints.csv"),
        ("coloured_parts.py", ["trimesh"], ["body.off", "parts.glb"], "parts.glb"),
        ("carry_texture.py", ["trimesh"], ["template.ply", "body.off", "carried.ply"], "carried.ply"),
        ("smpl_start_values.py", [], ["body.off", "start.json", "model.npz"], "start.json"),
        ("follow_bvh.py", [], ["body.off", "walk.bvh", "walking.glb"], "walking.glb"),
    ],
)
def test_examples(
    workplace: Path, monkeypatch: pytest.MonkeyPatch, script: str, needs: list[str], arguments: list[str], out: str
) -> None:
    for module in needs:
        pytest.importorskip(module)
    (workplace / "scans").mkdir()
    shutil.copy("body.off", "scans/a.off")
    skelgen.convert("body.off", "template.ply")
    np.savez("model.npz", J=np.random.default_rng(1).normal(size=(24, 3)))
    monkeypatch.setattr(sys, "argv", [script, *arguments])
    runpy.run_path(str(EXAMPLES / script), run_name="__main__")
    assert (workplace / out).stat().st_size > 100


def test_smpl_start_values_pose_the_model(workplace: Path) -> None:
    """A model posed by them has its bones where the body has them."""
    example = runpy.run_path(str(EXAMPLES / "smpl_start_values.py"))
    body = skelgen.extract("body.off")
    joints = np.array([body[name] if name else [np.nan] * 3 for name in example["JOINTS"]])
    rng = np.random.default_rng(3)
    rest = np.where(np.isnan(joints), 0.0, joints) + rng.normal(scale=0.05, size=(24, 3))
    rest = rest @ np.linalg.qr(rng.normal(size=(3, 3)))[0] * 2
    values = example["start_values"](rest, joints)
    pose = np.concatenate([values["global_orient"], values["body_pose"]]).reshape(24, 3)
    turned: list[np.ndarray] = []
    for joint, parent in enumerate(example["PARENTS"]):
        angle = np.linalg.norm(pose[joint])
        x, y, z = pose[joint] / max(angle, 1e-12)
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        own = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
        turned.append(own if parent < 0 else turned[parent] @ own)
    for joint, ahead in example["AHEAD"].items():
        bone, wanted = turned[joint] @ (rest[ahead] - rest[joint]), joints[ahead] - joints[joint]
        assert bone @ wanted / np.linalg.norm(bone) / np.linalg.norm(wanted) > 0.999
    assert (workplace / "body.off").exists()


def test_every_example_is_run() -> None:
    source = Path(__file__).read_text(encoding="utf-8")
    scripts = {path.name for path in EXAMPLES.glob("*.py")}
    assert scripts
    assert all(f'"{name}"' in source for name in scripts)


@pytest.mark.usefixtures("workplace")
def test_notebook() -> None:
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    pytest.importorskip("networkx")
    notebook = nbformat.read(EXAMPLES / "first_steps.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    assert any("<svg" in output.get("data", {}).get("text/html", "") for output in outputs)
