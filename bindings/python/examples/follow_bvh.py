"""A body that moves as a recorded skeleton does.

python follow_bvh.py scan.ply dance.bvh dancing.glb
"""

import sys

import skelgen


def main(scan: str, clip: str, out: str) -> None:
    """Write the moving character."""
    rig = skelgen.extract(scan).rig().animate(clip)
    rig.save(out, names="mixamo")
    print(f"{out}: {rig}")


if __name__ == "__main__":
    main(*sys.argv[1:])
