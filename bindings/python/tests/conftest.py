"""What several tests need: the sample body, and the program that comes with the package."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import skelgen

ROOT = Path(__file__).parents[3]
SAMPLE = ROOT / "data" / "sample"


@pytest.fixture(scope="session")
def sample() -> Path:
    """The sample body's file."""
    return SAMPLE / "body.off"


@pytest.fixture(scope="session")
def mesh(sample: Path) -> skelgen.Mesh:
    """The sample body."""
    return skelgen.read(sample)


@pytest.fixture(scope="session")
def body(sample: Path) -> skelgen.Extraction:
    """The sample body, found."""
    return skelgen.extract(sample)


@pytest.fixture
def workplace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, body: skelgen.Extraction) -> Path:
    """An empty folder to be in, but for the sample, its skeleton and a clip."""
    for file in ("body.off", "walk.bvh"):
        shutil.copy(SAMPLE / file, tmp_path)
    body.save(tmp_path / "body.json")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def program_file() -> str:
    """The program that comes with the package."""
    found = shutil.which("skelgen", path=os.fspath(Path(sys.executable).parent))
    assert found, "the program does not come with the package"
    return found


def program(*arguments: object) -> str:
    """What it prints."""
    command = [program_file(), *map(str, arguments)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout  # noqa: S603


def program_json(*arguments: object) -> dict[str, Any]:
    """The same, of JSON, without what a clock says."""
    document: dict[str, Any] = json.loads(program(*arguments))
    document.pop("timings_ms", None)
    return document


def without_timings(document: dict[str, Any]) -> dict[str, Any]:
    """A skeleton's file without what a clock says."""
    return {key: value for key, value in document.items() if key != "timings_ms"}


def real_bodies() -> list[Path]:
    """The meshes that SKELGEN_BODIES names; none where it is not set."""
    folder = os.environ.get("SKELGEN_BODIES")
    if not folder:
        return []
    return sorted(p for p in (Path(folder) / "meshes").rglob("*") if p.suffix in {".off", ".ply", ".obj"})
