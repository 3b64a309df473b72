"""What one body has at its vertices, here colours, carried to another one.

python carry_texture.py target.ply source.ply coloured.ply
"""

import sys

import numpy as np
import skelgen
import trimesh


def main(target: str, source: str, out: str) -> None:
    """Write the target with the source's colours; where the source has none, with colours of its parts."""
    to, painted = trimesh.load_mesh(target, process=False), trimesh.load_mesh(source, process=False)
    body = skelgen.extract(painted)
    look = painted.visual
    if isinstance(look, trimesh.visual.ColorVisuals) and look.kind == "vertex":
        colours = look.vertex_colors[:, :3]
    else:
        colours = body.segment().colours
    found = skelgen.extract(to).correspond(body)
    carried = found.transfer(np.asarray(colours))
    to.visual = trimesh.visual.ColorVisuals(to, vertex_colors=carried)
    to.export(out)
    print(f"{out}: {len(carried)} colours, confidence {found.confidence.mean():.2f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
