"""The kinematic skeleton of a 3D human body, from its triangle mesh, by geometry alone.

Any pose, any orientation, any unit, no learning, no hints::

    body = skelgen.extract("scan.ply")       # or vertices and faces, or a mesh of trimesh, Open3D, PyVista, meshio
    body.positions                           # (21, 3), in the mesh's own coordinates
    body.rig(rest="t-pose").save("body.glb")

The package is under the MIT licence, and so is all that is in it. The generator of bodies (`skelgen synth`), which is
under the GPL, is left out, also from the program `skelgen` that comes with it.
"""

import atexit

from . import _core
from ._batch import Batch, BatchResult, batch
from ._curve import Curve, curve
from ._errors import NoSkeletonError
from ._extraction import (
    Aligned,
    Correspondence,
    Extraction,
    Measurements,
    Posed,
    Rig,
    Segmentation,
    align,
    correspond,
    extract,
    measure,
    pose,
    rig,
    segment,
)
from ._mesh import Mesh, convert, read
from ._skeleton import Frame, Quality, Skeleton, read_skeleton

__version__ = _core.version
__all__ = [
    "Aligned",
    "Batch",
    "BatchResult",
    "Correspondence",
    "Curve",
    "Extraction",
    "Frame",
    "Measurements",
    "Mesh",
    "NoSkeletonError",
    "Posed",
    "Quality",
    "Rig",
    "Segmentation",
    "Skeleton",
    "align",
    "batch",
    "convert",
    "correspond",
    "curve",
    "extract",
    "measure",
    "pose",
    "read",
    "read_skeleton",
    "rig",
    "segment",
]

atexit.register(_core.leave_abandoned)
