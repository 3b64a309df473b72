"""Curve skeletons."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from ._mesh import FloatArray, IntArray, MeshLike, PathLike, as_mesh
from ._picture import picture, widest_axes

if TYPE_CHECKING:
    import networkx as nx
    import numpy.typing as npt


class Curve:
    """A thin graph along the middle of a surface.

    Attributes:
        nodes: (k, 3) positions in the mesh's unit.
        edges: (e, 2) pairs of nodes, the smaller index first.
        radii: (k,) mean distance of each node to its part of the surface; the mesh's unit.
        regions: k arrays of the mesh's vertices, those that belong to each node.
    """

    def __init__(self, nodes: FloatArray, edges: IntArray, radii: FloatArray, regions: list[IntArray]) -> None:
        self.nodes = nodes
        self.edges = edges
        self.radii = radii
        self.regions = regions

    def to_dict(self) -> dict[str, Any]:
        """The curve's file, as `skelgen curve` writes it.

        >>> skelgen.curve("body.off").to_dict()["format"]
        'skelgen-curve'
        """
        return dict(json.loads(_core.curve_to_json(self._arrays())))

    def save(self, path: PathLike) -> None:
        """Write .json, .obj (lines), .ply or .swc.

        Raises:
            ValueError: the name ends in none of these.
            OSError: it cannot be stored.

        >>> skelgen.curve("body.off").save("curve.swc")
        """
        _core.write_curve(Path(path), self._arrays())

    def to_networkx(self) -> nx.Graph[int]:
        """The graph, for networkx: nodes have `position`, `radius` and `region`, edges their `length`.

        Raises:
            ImportError: networkx is not installed.

        >>> graph = skelgen.curve("body.off").to_networkx()
        >>> sum(degree == 1 for _, degree in graph.degree())
        5
        """
        import networkx as nx  # noqa: PLC0415

        graph: nx.Graph[int] = nx.Graph()
        for node, position in enumerate(self.nodes):
            graph.add_node(node, position=position, radius=float(self.radii[node]), region=self.regions[node])
        for a, b in self.edges.tolist():
            length = float(((self.nodes[a] - self.nodes[b]) ** 2).sum() ** 0.5)
            graph.add_edge(a, b, length=length)
        return graph

    def _arrays(self) -> tuple[FloatArray, IntArray, FloatArray, list[IntArray]]:
        return self.nodes, self.edges, self.radii, self.regions

    def _repr_html_(self) -> str:
        """A picture for notebooks."""
        return picture(self, widest_axes(self.nodes), joints=self.nodes, bones=self.edges.tolist())

    def __repr__(self) -> str:
        return f"Curve({len(self.nodes)} nodes, {len(self.edges)} edges)"


def curve(
    mesh: MeshLike,
    faces: npt.ArrayLike | None = None,
    *,
    detail: str = "limbs",
    spacing: float | None = None,
    threads: int = 1,
) -> Curve:
    """Find the curve skeleton alone, of a body or anything else: one for each connected piece, as one graph.

    Args:
        mesh: vertices (n, 3), an object that has vertices and faces, or a path.
        faces: (m, 3) vertex indices, where `mesh` has none.
        detail: "limbs" (five ends on a body), "digits" (also fingers, tails) or "all" (everything that sticks out).
        spacing: distance between nodes, relative to the diagonal of the bounding box.
        threads: that work on it; the result does not depend on their number.

    Raises:
        ValueError: an argument makes no sense, or the mesh is no surface.

    >>> skelgen.curve("body.off").edges.shape[1]
    2
    """
    given = as_mesh(mesh, faces)
    return Curve(*_core.find_curve(given.vertices, given.faces, detail, spacing, threads))
