"""Many bodies."""

from __future__ import annotations

import contextlib
import glob
import operator
import os
import time
from collections import deque
from collections.abc import Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import _core
from ._errors import NoSkeletonError
from ._extraction import Extraction, extract
from ._mesh import PathLike, is_path

_TETRAHEDRON = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


@dataclass(frozen=True)
class BatchResult:
    """What came of one mesh."""

    file: Path
    extraction: Extraction | None  #: None where it failed
    error: Exception | None  #: why
    seconds: float

    @property
    def status(self) -> str:
        """As in the summary of `skelgen batch`: ok, no_skeleton, bad_input, or internal: a fault of skelgen's own."""
        if self.error is None:
            return "ok"
        if isinstance(self.error, NoSkeletonError):
            return "no_skeleton"
        return "bad_input" if isinstance(self.error, (ValueError, OSError)) else "internal"

    def row(self, *, measures: bool = False) -> dict[str, Any]:
        """Flat, for pandas, with the columns of `skelgen batch --csv`.

        Args:
            measures: whether the body is measured, too, beside the file, how it went, and x, y, z and confidence of
                each joint.

        Raises:
            ValueError: measures are wanted, and the skeleton's template is not human21.

        >>> [result.row()["status"] for result in skelgen.batch("body.off")]
        ['ok']
        """
        out: dict[str, Any] = {
            "file": str(self.file),
            "status": self.status,
            "error": None if self.error is None else str(self.error),
            "seconds": self.seconds,
        }
        if self.extraction is not None:
            out["sides_confidence"] = self.extraction.quality.sides_confidence
            for j, name in enumerate(self.extraction.names):
                for axis, value in zip("xyz", self.extraction.positions[j].tolist(), strict=True):
                    out[f"{name}_{axis}"] = value
                out[f"{name}_confidence"] = float(self.extraction.confidence[j])
            if measures:
                out |= self.extraction.measure().row()
        return out


class Batch(Iterator[BatchResult]):
    """An iterator over the skeletons of many meshes, in the order of their files.

    `len` is the number of files, as tqdm wants it, however many are done.
    """

    def __init__(self, files: list[Path], jobs: int, options: dict[str, Any]) -> None:
        self.files = files
        self._jobs = jobs
        self._options = options
        self._results = self._run()

    def __len__(self) -> int:
        return len(self.files)

    def __next__(self) -> BatchResult:
        return next(self._results)

    def __repr__(self) -> str:
        return f"Batch({len(self.files)} meshes, jobs={self._jobs})"

    def _run(self) -> Iterator[BatchResult]:
        """Results as they are done, in order; a few more than are asked for are worked on."""
        pool = ThreadPoolExecutor(self._jobs)
        waiting: deque[Future[BatchResult]] = deque()
        try:
            for file in self.files:
                waiting.append(pool.submit(self._one, file))
                if len(waiting) > 2 * self._jobs:
                    yield waiting.popleft().result()
            while waiting:
                yield waiting.popleft().result()
        finally:  # Ctrl-C does not wait for what is at work
            pool.shutdown(wait=False, cancel_futures=True)

    def _one(self, file: Path) -> BatchResult:
        start = time.perf_counter()
        extraction: Extraction | None = None
        error: Exception | None = None
        try:
            extraction = extract(file, **self._options)
        except Exception as raised:  # noqa: BLE001
            error = raised
        return BatchResult(file, extraction, error, time.perf_counter() - start)


def batch(paths: PathLike | Iterable[PathLike], *, jobs: int | None = None, **options: Any) -> Batch:  # noqa: ANN401
    """Find the skeletons in many meshes, several at once. What fails costs itself alone.

    Args:
        paths: files, folders (searched for meshes) and patterns, or one of these.
        jobs: how many at once; as many as there are processors.
        **options: as `extract` has them.

    Raises:
        ValueError: `jobs` is less than 1, an option makes no sense, or there is nothing of one of the names.

    >>> results = skelgen.batch(["body.off"], jobs=1)
    >>> len(results), [result.status for result in results]
    (1, ['ok'])
    """
    count = (os.cpu_count() or 1) if jobs is None else operator.index(jobs)
    if count < 1:
        message = f"jobs: {jobs} is less than 1"
        raise ValueError(message)
    with contextlib.suppress(NoSkeletonError):  # what is wrong with options is said once, not of each mesh
        extract(_TETRAHEDRON, **options | {"component": 0})
    if is_path(paths):
        paths = [paths]  # type: ignore[list-item]
    files = [file for path in paths for file in _files(Path(path))]  # type: ignore[union-attr]
    return Batch(files, count, options)


def _files(path: Path) -> list[Path]:
    if path.is_dir():
        extensions = tuple(e for name in _core.mesh_extensions() for e in (name, name + ".gz"))
        found = [p for p in path.rglob("*") if p.name.lower().endswith(extensions) and p.is_file()]
    elif path.exists():
        found = [path]
    else:
        found = [Path(name) for name in glob.glob(str(path), recursive=True)]  # noqa: PTH207
    if not found:
        message = f"paths: there is no mesh at {path}"
        raise ValueError(message)
    return sorted(found)
