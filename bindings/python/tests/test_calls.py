"""How calls behave: threads, processes, signals, memory."""

from __future__ import annotations

import gc
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
import skelgen
from conftest import program_file


def test_other_threads_go_on(mesh: skelgen.Mesh) -> None:
    counted, stop = [0], threading.Event()

    def count() -> None:
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.0005)

    counter = threading.Thread(target=count)
    counter.start()
    try:
        before = counted[0]
        skelgen.extract(mesh.vertices, mesh.faces)
        assert counted[0] > before + 3
    finally:
        stop.set()
        counter.join()


def test_threads_find_the_same(mesh: skelgen.Mesh, body: skelgen.Extraction) -> None:
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda _: skelgen.extract(mesh.vertices, mesh.faces, name="body.off"), range(8)))
    assert all(one == body for one in found)


def test_threads_share_a_body(mesh: skelgen.Mesh) -> None:
    body = skelgen.extract(mesh)
    with ThreadPoolExecutor(4) as pool:
        parts = list(pool.map(lambda _: body.segment().to_dict(), range(4)))
        places = list(pool.map(lambda _: body.correspond(body).to_dict(), range(2)))
    assert all(one == parts[0] for one in parts)
    assert places[0] == places[1]


def joints_of(path: Path) -> list[list[float]]:
    joints: list[list[float]] = skelgen.extract(path).positions.tolist()
    return joints


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes(sample: Path, body: skelgen.Extraction, method: str) -> None:
    with multiprocessing.get_context(method).Pool(2) as pool:
        found = pool.map(joints_of, [sample] * 3)
    assert found == [body.positions.tolist()] * 3


INTERRUPTED = """
import signal, sys, time
import numpy as np
import skelgen

signal.signal(signal.SIGINT, signal.default_int_handler)  # started in the background, there is none
mesh = skelgen.read(sys.argv[1])
vertices, faces = mesh.vertices, mesh.faces
for _ in range(4):  # each face becomes four
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    unique, inverse = np.unique(edges, axis=0, return_inverse=True)
    a, b, c = (inverse.reshape(3, -1) + len(vertices))
    vertices = np.concatenate([vertices, vertices[unique].mean(axis=1)])
    x, y, z = faces.T
    faces = np.concatenate([np.stack(t, axis=1) for t in ((x, a, c), (a, y, b), (c, b, z), (a, b, c))])
print("ready", flush=True)
try:
    body = skelgen.extract(vertices, faces)
    while True:
        body = skelgen.extract(vertices, faces)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


def test_an_interrupt_is_heard_at_once(sample: Path) -> None:
    command = [sys.executable, "-c", INTERRUPTED, str(sample)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:  # noqa: S603
        assert process.stdout
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        start = time.monotonic()
        assert process.stdout.readline() == "interrupted\n"
        heard = time.monotonic() - start
        assert process.wait(60) == 0
        ended = time.monotonic() - start
    assert heard < 0.5
    assert ended < 1


def test_after_an_interrupt_all_is_well(mesh: skelgen.Mesh, body: skelgen.Extraction) -> None:
    signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.01, lambda: os.kill(os.getpid(), signal.SIGINT))
    with pytest.raises(KeyboardInterrupt):  # noqa: PT012
        timer.start()
        for _ in range(1000):
            skelgen.extract(mesh.vertices, mesh.faces)
    assert skelgen.extract(mesh.vertices, mesh.faces, name="body.off") == body


def test_an_interrupt_ends_a_batch_at_once(workplace: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    done, find = threading.Event(), skelgen.extract
    monkeypatch.setattr("skelgen._batch.extract", lambda mesh, **o: done.wait(60) and find(mesh, **o))
    done.set()
    results = skelgen.batch(workplace / "body.off", jobs=1)
    done.clear()
    signal.signal(signal.SIGINT, signal.default_int_handler)
    start = time.monotonic()
    threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        next(results)
    done.set()
    assert time.monotonic() - start < 0.6


def resident_bytes() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="memory is told by Linux alone")
def test_memory_does_not_grow(mesh: skelgen.Mesh) -> None:
    rounds = int(os.environ.get("SKELGEN_ROUNDS", "60"))
    after = []
    for _ in range(3):
        for _ in range(rounds // 3):
            skelgen.extract(mesh.vertices, mesh.faces)
        gc.collect()
        after.append(resident_bytes())
    assert after[2] - after[1] < 4 << 20


NOT_COPIED = """
import resource
import numpy as np
import skelgen

def most() -> int:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024

vertices, faces = np.full((2_000_000, 3), 0.5), np.full((2_000_000, 3), [0, 1, 2], np.int32)
for find in (skelgen.extract, skelgen.curve):
    before = most()
    try:  # refused once the arrays are there and looked through
        find(vertices, faces, **{"component": -1} if find is skelgen.extract else {"spacing": -1})
    except ValueError:
        print(most() - before)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="others count memory otherwise")
def test_arrays_are_not_copied() -> None:
    command = [sys.executable, "-c", NOT_COPIED]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout  # noqa: S603
    grown = [int(mebibytes) for mebibytes in printed.split()]
    assert len(grown) == 2
    assert max(grown) < 10  # the arrays are 69 MiB


def test_program_stays_a_program(workplace: Path) -> None:
    """It is in Python's process, but signals, exit statuses and pipes are a program's own."""
    assert subprocess.run([program_file(), "extract", "none.off"], capture_output=True, check=False).returncode == 3  # noqa: S603
    with subprocess.Popen([program_file(), "extract", "-"], stdin=subprocess.PIPE, stderr=subprocess.PIPE) as waiting:  # noqa: S603
        time.sleep(0.5)
        waiting.send_signal(signal.SIGINT)
        assert waiting.wait(5) == -signal.SIGINT
    body = (workplace / "body.off").read_bytes()
    printed = subprocess.run([program_file(), "extract", "-q", "-"], input=body, capture_output=True, check=True).stdout  # noqa: S603
    assert printed.startswith(b"{")
    (workplace / "ünï \udcff.off").write_bytes(body)  # a name that is no text
    assert subprocess.run([program_file(), "batch", "-q", ".", "-o", "out"], check=False).returncode == 0  # noqa: S603
    assert len(list((workplace / "out").glob("*.json"))) == 2


def test_import_is_quick() -> None:
    code = "import time, numpy; s = time.process_time(); import skelgen; print(time.process_time() - s)"
    times = [
        float(subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout)  # noqa: S603
        for _ in range(5)
    ]
    assert min(times) < 0.15


COMPANIONS = ["trimesh", "open3d", "pyvista", "meshio", "pandas", "networkx", "matplotlib", "scipy"]
ALONE = f"""
import sys
for companion in {COMPANIONS}:
    sys.modules[companion] = None  # as if it were not installed
import skelgen

body = skelgen.extract(sys.argv[1])
body.segment(), body.measure(), body.align(), body.rig(), body.pose(body), body.curve, body._repr_html_()
rows = [result.row(measures=True) for result in skelgen.batch(sys.argv[1], jobs=1)]
print(rows[0]["status"], rows[0]["unit"])
try:
    body.curve.to_networkx()
except ImportError as error:
    print(error.name)
"""


def test_nothing_but_numpy_is_needed(sample: Path) -> None:
    command = [sys.executable, "-c", ALONE, str(sample)]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout  # noqa: S603
    assert printed.split() == ["ok", "m", "networkx"]


def test_faces_changed_behind_our_back_are_noticed(mesh: skelgen.Mesh) -> None:
    faces = mesh.faces.copy()
    body = skelgen.extract(mesh.vertices, faces)
    faces[5, 1] = 10**8
    with pytest.raises(ValueError, match=r"faces: face 5 names vertex 100000000"):
        body.segment()
    faces[5, 1] = mesh.faces[5, 1]
    assert body.segment().to_dict()["parts"]


def test_vertices_changed_behind_our_back_are_noticed(mesh: skelgen.Mesh) -> None:
    vertices = mesh.vertices.copy()
    body = skelgen.extract(vertices, mesh.faces)
    vertices[7] = np.inf
    with pytest.raises(ValueError, match="vertices: the coordinates of vertex 7"):
        body.rig()
