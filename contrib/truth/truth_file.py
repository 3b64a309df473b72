"""What the scripts of this folder share: meshes, the unit of errors, and truth files as `skelgen evaluate` reads them."""

from __future__ import annotations

import heapq
import json
import math
from pathlib import Path

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
MARKERS = [f"{side}_{joint}" for joint in ("hand", "foot", "elbow", "knee", "shoulder") for side in ("left", "right")]


def read_mesh(path: Path) -> tuple[Array, npt.NDArray[np.int64]]:
    """Vertices and triangles of an OFF, or of a PLY that trimesh reads."""
    if path.suffix.lower() != ".off":
        import trimesh  # noqa: PLC0415

        mesh = trimesh.load_mesh(path, process=False)
        return np.asarray(mesh.vertices, float), np.asarray(mesh.faces)
    words = path.read_text(encoding="utf-8").split()
    if not words or words[0] != "OFF":
        raise SystemExit(f"{path}: is no OFF file")
    vertices, faces = int(words[1]), int(words[2])
    places = np.array(words[4 : 4 + 3 * vertices], float).reshape(vertices, 3)
    corners = np.array(words[4 + 3 * vertices :][: 4 * faces], np.int64).reshape(faces, 4)
    if (corners[:, 0] != 3).any():
        raise SystemExit(f"{path}: has faces that are no triangles")
    return places, corners[:, 1:]


def distances_from(start: int, neighbours: list[list[tuple[int, float]]]) -> list[float]:
    """Along edges; infinite where there is no way."""
    found = [math.inf] * len(neighbours)
    found[start] = 0.0
    waiting = [(0.0, start)]
    while waiting:
        distance, vertex = heapq.heappop(waiting)
        if distance > found[vertex]:
            continue
        for other, length in neighbours[vertex]:
            if distance + length < found[other]:
                found[other] = distance + length
                heapq.heappush(waiting, (found[other], other))
    return found


def largest_distance(vertices: Array, faces: npt.NDArray[np.int64]) -> float:
    """The largest distance along edges, from ends that are farthest from each other."""
    edges = np.unique(np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1), axis=0)
    lengths = np.linalg.norm(vertices[edges[:, 0]] - vertices[edges[:, 1]], axis=1)
    neighbours: list[list[tuple[int, float]]] = [[] for _ in vertices]
    for (one, other), length in zip(edges.tolist(), lengths.tolist()):
        neighbours[one].append((other, length))
        neighbours[other].append((one, length))
    start, largest = 0, 0.0
    for _ in range(4):
        reached = [
            (distance, vertex)
            for vertex, distance in enumerate(distances_from(start, neighbours))
            if distance < math.inf
        ]
        largest, start = max(reached)
    return largest


def write_truth(
    path: Path,
    mesh: str,
    scale: float,
    source: str,
    joints: dict[str, Array],
    markers: dict[str, Array],
    digits: dict[str, dict[str, Array]] | None = None,
    fused: dict[str, list[str]] | None = None,
) -> None:
    """A truth file, after what `skelgen evaluate` reads."""
    document: dict[str, object] = {
        "mesh": mesh,
        "scale": scale,
        "source": source,
        "joints": {name: place.tolist() for name, place in joints.items()},
        "markers": {name: place.tolist() for name, place in markers.items()},
    }
    for kind, of_kind in (digits or {}).items():  # fingers, toes
        document[kind] = {name: place.tolist() for name, place in of_kind.items()}
    if fused:
        document["fused"] = fused
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
