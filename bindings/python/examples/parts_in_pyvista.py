"""The parts of a body as a field of its cells and colours of its points, in PyVista.

python parts_in_pyvista.py scan.ply parts.vtp
"""

import sys

import pyvista
import skelgen


def main(scan: str, out: str) -> None:
    """Write the surface with both, and how large each part is."""
    body = skelgen.extract(scan)
    parts = body.segment()
    surface = pyvista.PolyData.from_regular_faces(body.vertices, body.faces.astype(int))
    surface.point_data["colours"] = parts.colours  # surface.plot(scalars="colours", rgb=True) shows them
    surface.cell_data["part"] = parts.face_part
    surface.save(out)
    areas = surface.compute_cell_sizes(length=False, volume=False).cell_data["Area"]
    for number, part in enumerate(parts.parts):
        print(f"{part}: {areas[parts.face_part == number].sum():.4g}")


if __name__ == "__main__":
    main(*sys.argv[1:])
