"""Names of artists' bones, and a rig compared with itself, fingers among its bones: test_artists.py SKELGEN PROJECT."""

import pathlib
import subprocess
import sys
import tempfile

from artists import artists_bone, is_alike

BONES = {
    "lHand": ("left", "hand"), "rShldr": ("right", "upper_arm"), "l_thigh": ("left", "thigh"), "thigh_r": ("right", "thigh"),
    "mixamorig:LeftHandIndex1": ("left", "hand"), "UpperLeg.L": ("left", "thigh"), "Bip01 R Calf": ("right", "calf"),
    "upperarm_l_twist": ("left", "upper_arm"), "Head": ("", "head"), "root": ("", "trunk"), "sword": None,
}
for name, bone in BONES.items():
    if artists_bone(name) != bone:
        sys.exit("%s is taken for %s" % (name, artists_bone(name)))
for name, is_so in (("lCollar", True), ("clavicle_l", True), ("rCollar", False), ("chest", False)):
    if is_alike(("left", "upper_arm"), name) != is_so:
        sys.exit("an upper arm is %salike to %s" % ("not " if is_so else "", name))

skelgen, project = sys.argv[1], pathlib.Path(sys.argv[2])
with tempfile.TemporaryDirectory() as folder:
    rig = [skelgen, "rig", str(project / "data/sample/body.off"), "-q", "--names", "mixamo", "--fingers", "on"]
    subprocess.run([*rig, "-o", folder + "/body.glb"], check=True)
    if b"LeftHandIndex1" not in pathlib.Path(folder, "body.glb").read_bytes():
        sys.exit("the rig has no fingers")
    artists = [sys.executable, str(project / "tests/rigs/artists.py"), skelgen, folder]
    said = subprocess.run(artists, check=True, capture_output=True, text=True).stdout.split()
if said != ["body", "100.0", "%,", "100.0", "%"]:
    sys.exit("a rig is not like itself: " + " ".join(said))
