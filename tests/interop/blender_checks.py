"""What the checks that run in Blender share."""

import sys

import bpy
import numpy as np

# Debian 12's importers ask numpy for a name that numpy has dropped since.
if "bool" not in vars(np):
    np.bool = bool


def run(faults_of, kind, is_complete=lambda: True):
    """Ends Blender: well where no file named behind -- has a fault, and the files have what is to be looked at."""
    paths = sys.argv[sys.argv.index("--") + 1 :]
    failed = 0
    for path in paths:
        faults = faults_of(path)
        failed += bool(faults)
        for fault in faults:
            print(f"{path}: {fault}")
    if not is_complete():
        print("no file has all that is to be looked at")
    print(f"Blender {bpy.app.version_string}: {len(paths)} {kind}, {failed} failed")
    sys.exit(0 if paths and failed == 0 and is_complete() else 1)
