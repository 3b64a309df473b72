"""A rig compared with itself: test_artists.py SKELGEN PROJECT. Its bones, fingers among them, are the artist's."""

import pathlib
import subprocess
import sys
import tempfile

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
