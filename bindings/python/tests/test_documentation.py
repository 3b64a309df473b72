"""What the documentation shows is run: docstrings, README, examples, the notebook."""

from __future__ import annotations

import ast
import doctest
import importlib
import importlib.util
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
PAGES = ["README.md", "docs/python.md", "docs/start/researcher.md"]
MODULES = [m.name for m in pkgutil.iter_modules(skelgen.__path__) if m.name != "_core"]


def snippets() -> list[tuple[str, str]]:
    """The Python in the pages, a block each."""
    found = []
    for page in PAGES:
        blocks = re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), re.DOTALL)
        assert blocks, page
        found += [(page, block) for block in blocks]
    return found


@pytest.mark.parametrize("name", MODULES)
@pytest.mark.usefixtures("workplace")
def test_docstrings(name: str) -> None:
    module = importlib.import_module(f"skelgen.{name}")
    runner = doctest.DocTestRunner()
    for test in doctest.DocTestFinder().find(module, extraglobs={"skelgen": skelgen}):
        if "networkx" not in test.name or importlib.util.find_spec("networkx"):
            runner.run(test)
    assert runner.summarize().failed == 0


def test_all_is_documented() -> None:
    """Each class and function says what it is, each function shows how it is used."""
    public = [getattr(skelgen, name) for name in skelgen.__all__]
    classes = [one for one in public if inspect.isclass(one)]
    functions = [one for one in public if inspect.isfunction(one)]
    for one in classes:
        functions += [f for name, f in vars(one).items() if inspect.isfunction(f) and not name.startswith("_")]
        functions += [f.__func__ for f in vars(one).values() if isinstance(f, classmethod) and f.__name__[0] != "_"]
    assert len(functions) > 30
    undocumented = [one.__qualname__ for one in [*classes, *functions] if not one.__doc__]
    assert not undocumented
    without = [f.__qualname__ for f in functions if ">>>" not in f.__doc__]
    assert not without


def test_the_stub_is_the_modules() -> None:
    module = importlib.import_module("skelgen._core")
    file = Path(str(module.__file__))
    body = ast.parse((file.parent / "_core.pyi").read_text(encoding="utf-8")).body
    named = {node.name for node in body if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    named |= {node.target.id for node in body if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name)}
    assert named == {name for name in vars(module) if not name.startswith("__")}
    assert (file.parent / "py.typed").exists()


@pytest.mark.parametrize(("page", "block"), snippets())
def test_snippets(workplace: Path, body: skelgen.Extraction, page: str, block: str) -> None:
    for module in re.findall(r"^(?:import|from) (\w+)", block, re.MULTILINE):
        pytest.importorskip(module)
    (workplace / "scans").mkdir()
    for scan in ("scan", "scans/a", "adult", "child", "template", "other", "a", "b"):
        skelgen.convert(SAMPLE / "body.off", f"{scan}.ply")
    (workplace / "teapot.off").write_text(
        "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"
    )
    before = set(workplace.rglob("*"))
    exec(compile(block, page, "exec"), {"skelgen": skelgen, "body": body})  # noqa: S102
    written = [workplace / name for name in re.findall(r"(?:save|to_csv)\(\"([^\"]+)", block)]
    assert set(workplace.rglob("*")) - before == set(written)


def test_the_manual_names_everything() -> None:
    text = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    missing = [name for name in skelgen.__all__ if not re.search(rf"\b{name}\b", text)]
    assert not missing
    scripts = [path.name for path in EXAMPLES.iterdir() if path.is_file() and path.name not in text]
    assert not scripts


@pytest.mark.parametrize(
    ("script", "needs", "arguments", "out"),
    [
        ("joint_table.py", [], ["scans", "joints.csv"], "joints.csv"),
        ("coloured_parts.py", ["trimesh"], ["body.off", "parts.glb"], "parts.glb"),
        ("parts_in_pyvista.py", ["pyvista"], ["body.off", "parts.vtp"], "parts.vtp"),
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
