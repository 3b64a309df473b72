"""What the checks that run in Blender share."""

import sys

import bpy
import numpy as np

# Debian 12's importers ask numpy for a name that numpy has dropped since.
if "bool" not in vars(np):
    np.bool = bool


def run(faults_of, kind):
    """Ends Blender: well where no file named behind -- has a fault."""
    paths = sys.argv[sys.argv.index("--") + 1 :]
    failed = 0
    for path in paths:
        faults = faults_of(path)
        failed += bool(faults)
        for fault in faults:
            print(f"{path}: {fault}")
    print(f"Blender {bpy.app.version_string}: {len(paths)} {kind}, {failed} failed")
    sys.exit(0 if paths and failed == 0 else 1)
