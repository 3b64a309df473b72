"""The parts of a body as colours of its vertices, in trimesh.

python coloured_parts.py scan.ply parts.glb
"""

import sys

import skelgen
import trimesh


def main(scan: str, out: str) -> None:
    """Write the coloured mesh, in whatever format trimesh writes."""
    mesh = trimesh.load_mesh(scan, process=False)
    parts = skelgen.segment(mesh)
    mesh.visual = trimesh.visual.ColorVisuals(mesh, vertex_colors=parts.colours)
    mesh.export(out)
    for part in parts.parts:
        print(f"{part}: {parts.mask(part).sum()} vertices")


if __name__ == "__main__":
    main(*sys.argv[1:])
