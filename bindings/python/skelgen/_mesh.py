"""Meshes: from whatever holds vertices and faces, from files and into them."""

from __future__ import annotations

import copy
import os
import time
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _core
from ._picture import GREY, picture, widest_axes

FloatArray: TypeAlias = npt.NDArray[np.float64]
IntArray: TypeAlias = npt.NDArray[np.int32]
PathLike: TypeAlias = "str | os.PathLike[str]"

#: A path, vertices (n, 3) with faces (m, 3) beside them or as a pair, or an object that has both: `Mesh`, trimesh,
#: Open3D, PyVista, meshio.
MeshLike: TypeAlias = Any

_LEAST = 4  # vertices and faces of whatever encloses something
_CORNERS = 3


class Mesh:
    """Vertices and triangles.

    Attributes:
        vertices: (n, 3) float64, in the mesh's own unit; the array that was given, where it is C-contiguous float64.
        faces: (m, 3) int32, counter-clockwise seen from outside.
        name: what results call it: the file's name, or "mesh".
        path: the file, where it was read from one.

    >>> skelgen.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    Mesh('mesh': 4 vertices, 4 faces)
    """

    def __init__(self, vertices: npt.ArrayLike, faces: npt.ArrayLike, name: str = "mesh") -> None:
        self.vertices: FloatArray = _vertices(vertices)
        self.faces: IntArray = _faces(faces, len(self.vertices))
        self.name = name
        self.path: Path | None = None
        self._read_ms = 0.0
        # Whose looks are kept in files: file, animation, time; what of that scene this is; how it has turned.
        self._scene: tuple[Path, str, float] | None = None
        self._sources = (np.empty(0, np.int32), np.empty(0, np.int32))
        self._turns: FloatArray | None = None

    def save(self, path: PathLike) -> None:
        """Write .off, .obj, .ply, .stl, .glb or .fbx, wholly or not at all; the last two with its file's materials.

        Raises:
            ValueError: the name ends in none of these, or the arrays are no mesh.
            OSError: it cannot be stored.

        >>> skelgen.read("body.off").save("copy.ply")
        """
        _core.write(Path(path), self.vertices, self.faces, self._scene, self._sources, self._turns)

    def _repr_html_(self) -> str:
        """A picture for notebooks."""
        return picture(self, self._axes(), [(self.vertices, GREY)])

    def _axes(self) -> FloatArray:
        """Those of its picture."""
        return widest_axes(self.vertices)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.name!r}: {len(self.vertices)} vertices, {len(self.faces)} faces)"


def read(path: PathLike, *, animation: str = "", time: float = 0) -> Mesh:
    """Read a mesh: OFF, OBJ, PLY, STL, GLB, glTF, VRM, FBX or DAE, also compressed by gzip.

    Vertices keep the file's order; a scene gives the triangles that a viewer shows.

    Args:
        path: the file.
        animation: of a scene, pose it by the animation of this name or number (from "1"); empty: as it is stored.
        time: seconds from the animation's beginning.

    Raises:
        FileNotFoundError: there is no such file.
        ValueError: it is no mesh; the message names the place.

    >>> skelgen.read("body.off")
    Mesh('body.off': 6890 vertices, 13776 faces)
    """
    file = _existing(path)
    start = _milliseconds()
    vertices, faces = _core.read((file, animation, time))
    mesh = Mesh(vertices, faces, file.name)
    mesh.path = file
    mesh._scene = (file.absolute(), animation, time)  # noqa: SLF001
    mesh._read_ms = _milliseconds() - start  # noqa: SLF001
    return mesh


def convert(source: MeshLike, path: PathLike, *, animation: str = "", time: float = 0) -> None:
    """Write a mesh, or a scene's meshes as they are shown, in the format that the name of `path` ends in.

    Raises:
        ValueError: as `read` and `Mesh.save`.

    >>> skelgen.convert("body.off", "body.ply")
    >>> skelgen.read("body.ply")
    Mesh('body.ply': 6890 vertices, 13776 faces)
    """
    mesh = read(source, animation=animation, time=time) if is_path(source) else as_mesh(source)
    mesh.save(path)


def as_mesh(mesh: MeshLike, faces: npt.ArrayLike | None = None, *, name: str | None = None) -> Mesh:
    """Whatever holds a triangle mesh as `Mesh`; arrays that are as the library wants them are not copied."""
    if faces is not None:
        out = Mesh(mesh, faces)
    elif is_path(mesh):
        out = read(mesh)
    elif isinstance(mesh, Mesh):
        out = mesh
        if name is not None and name != mesh.name:
            out = copy.copy(mesh)
    elif isinstance(mesh, tuple) and len(mesh) == 2:  # noqa: PLR2004
        out = Mesh(*mesh)
    else:
        out = _from_object(mesh)
    if name is not None:
        out.name = _name(name)
    return out


def is_path(value: object) -> bool:
    """Whether a value names a file."""
    return isinstance(value, (str, os.PathLike))


def _name(name: str) -> str:
    if not isinstance(name, str) or not name:
        message = f"name: {name!r} is no name"
        raise ValueError(message)
    return name


def _milliseconds() -> float:
    return time.perf_counter() * 1000


def _existing(path: PathLike) -> Path:
    file = Path(path)
    if not file.exists():
        message = f"{file}: there is no such file"
        raise FileNotFoundError(message)
    return file


def _array(values: npt.ArrayLike, argument: str, wanted: str, kinds: str) -> npt.NDArray[Any]:
    try:
        array = np.asarray(values)
    except (ValueError, TypeError) as error:
        message = f"{argument}: is no array of shape {wanted}: {error}"
        raise ValueError(message) from error
    if array.ndim != 2 or array.shape[1] != _CORNERS:  # noqa: PLR2004
        message = f"{argument}: an array of shape {array.shape}, not {wanted}"
        raise ValueError(message)
    if array.dtype.kind not in kinds:
        what = "whole numbers" if "f" not in kinds else "real numbers"
        message = f"{argument}: an array of shape {array.shape} of {array.dtype}, not of {what}"
        raise ValueError(message)
    if len(array) < _LEAST:
        message = f"{argument}: an array of shape {array.shape}, not {wanted} of {_LEAST} rows or more"
        raise ValueError(message)
    return array


def _vertices(values: npt.ArrayLike) -> FloatArray:
    array = _array(values, "vertices", "(n, 3)", "fiu")
    with np.errstate(over="ignore"):  # what is too large becomes infinite, and is refused for that
        return np.ascontiguousarray(array, dtype=np.float64)


def _faces(values: npt.ArrayLike, vertices: int) -> IntArray:
    array = _array(values, "faces", "(m, 3)", "iu")
    if array.dtype != np.int32:
        low, high = int(array.min()), int(array.max())
        if low < 0 or high >= vertices:
            message = (
                f"faces: names vertex {low if low < 0 else high}, in an array of shape {array.shape}; "
                f"there are {vertices} vertices"
            )
            raise ValueError(message)
    return np.ascontiguousarray(array, dtype=np.int32)


def _from_object(mesh: MeshLike) -> Mesh:
    """The mesh of another library's object: what it holds decides, so that none of them has to be installed."""
    if hasattr(mesh, "geometry") and hasattr(mesh, "to_mesh"):  # trimesh's scene
        mesh = mesh.to_mesh()
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):  # trimesh and most others
        return Mesh(mesh.vertices, mesh.faces)
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):  # Open3D
        return Mesh(np.asarray(mesh.vertices), np.asarray(mesh.triangles))
    if hasattr(mesh, "vertex") and hasattr(mesh, "triangle"):  # Open3D's tensors
        return Mesh(mesh.vertex.positions.numpy(), mesh.triangle.indices.numpy())
    if hasattr(mesh, "points") and hasattr(mesh, "cells_dict"):  # meshio
        return _from_polygons(mesh.points, [cells for cells in mesh.cells_dict.values() if cells.ndim == 2])  # noqa: PLR2004
    if hasattr(mesh, "points") and hasattr(mesh, "faces"):  # PyVista: each face's number of corners before them
        return _from_polygons(mesh.points, _runs(np.asarray(mesh.faces)))
    message = (
        f"mesh: {type(mesh).__name__} has no vertices and faces; "
        "give a path, the arrays (vertices, faces), or an object that has both"
    )
    raise ValueError(message)


def _runs(faces: npt.NDArray[Any]) -> list[npt.NDArray[Any]]:
    out, at = [], 0
    if faces.size % (_CORNERS + 1) == 0 and (faces[:: _CORNERS + 1] == _CORNERS).all():
        return [faces.reshape(-1, _CORNERS + 1)[:, 1:]]
    while at < faces.size:
        end = at + 1 + int(faces[at])
        out.append(faces[None, at + 1 : end])
        at = end
    return out


def _from_polygons(points: npt.ArrayLike, cells: list[npt.NDArray[Any]]) -> Mesh:
    """The mesh of faces of any number of corners, one array (faces, corners) of each run of such."""
    vertices = _vertices(points)
    polygons = [run for run in cells if run.shape[1] >= _CORNERS]
    if not polygons:
        message = f"faces: there are none among {sum(len(run) for run in cells)} cells"
        raise ValueError(message)
    if all(run.shape[1] == _CORNERS for run in polygons):
        return Mesh(vertices, np.concatenate(polygons))
    corners = np.concatenate([run.ravel() for run in polygons])
    sizes = np.concatenate([np.full(len(run), run.shape[1]) for run in polygons])
    return Mesh(vertices, _core.triangulated(vertices, corners.tolist(), sizes.tolist()))
