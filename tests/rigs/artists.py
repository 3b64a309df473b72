"""Compares the rigs that skelgen makes of characters with those that artists gave them.

artists.py SKELGEN FOLDER: for each GLB, glTF and VRM in the folder that has a skin, the share of its vertices whose
largest weight falls to the bone that the artist's does. Bones are told by their names, as Mixamo, Unreal, VRM and
Rigify have them; artists divide trunk, hands and feet in many ways, so these count as one bone each. Vertices that the
artist gave to nothing of a body's (a weapon, a prop) do not count. Clavicles are of the trunk; skelgen's skeleton has
none, and what they move has to follow the chest or the upper arm: the second share counts either as the artist's.
"""

import base64
import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

FORMATS = {5121: "B", 5123: "H", 5126: "f"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}

# In this order: the first that matches a name, sides and digits apart, is the bone.
BONES = [
    ("hand", r"hand|wrist|fist|finger|thumb|index|middle|ring|pinky|palm"),
    ("forearm", r"forearm|lowerarm|elbow"),
    ("upper_arm", r"upperarm|uparm|arm$|shldr$"),  # the last is Poser's
    ("foot", r"foot|toe|ankle|ball"),
    ("calf", r"lowerleg|calf|shin|knee|^leg$"),
    ("thigh", r"upperleg|upleg|thigh"),
    ("head", r"head|eye|face|jaw|skull|hair"),
    ("neck", r"neck"),
    ("trunk", r"hip|pelvis|spine|chest|torso|abdomen|waist|body|crotch|clavicle|collar|shoulder|root"),
]
OURS = {"crotch": "trunk", "waist": "trunk", "chest": "trunk", "neck": "neck", "head": "head", "shoulder": "upper_arm",
        "elbow": "forearm", "wrist": "hand", "hand": "hand", "hip": "thigh", "knee": "calf", "ankle": "foot",
        "foot": "foot"} | {finger: "hand" for finger in ("thumb", "index", "middle", "ring", "little")}


def plain_name(name):
    """Without what stands before all names of a rig, and l_Hand for lHand, as Poser has it."""
    return re.sub(r"^([lr])(?=[A-Z])", r"\1_", re.sub(r"^.*[:|]", "", name or ""))


def side_of(plain):
    for side, word in (("left", r"left|(^|[._ ])l($|[._ ])"), ("right", r"right|(^|[._ ])r($|[._ ])")):
        if re.search("(?i)" + word, plain):
            return side
    return ""


def artists_bone(name):
    """Side and part of a joint by its name; None where it is no part of a body."""
    plain = plain_name(name)
    word = re.sub(r"left|right", "", re.sub(r"(?i)(^|[._ ])[lr](?=$|[._ ])", "", plain).lower())
    word = re.sub(r"(bone|joint|leaf|end)$", "", re.sub(r"[^a-z]", "", word))
    for part, pattern in BONES:
        if re.search(pattern, word):
            return ("" if part in ("trunk", "neck", "head") else side_of(plain), part)
    return None


def is_alike(ours, name):
    """Is that the artist's bone, or a neighbour of a clavicle, which ours do not have?"""
    theirs = artists_bone(name)
    if ours == theirs or not re.search(r"(?i)clavicle|collar|shoulder", name):
        return ours == theirs
    return theirs == ("", "trunk") and ours == (side_of(plain_name(name)), "upper_arm")


def our_bone(name):
    parts = name.split("_")  # [side, joint, number of the phalanx], or the joint alone
    return (parts[0], OURS[parts[1]]) if len(parts) > 1 else ("", OURS[name])


class Gltf:
    def __init__(self, path):
        data = path.read_bytes()
        self.folder, self.blob = path.parent, b""
        if data[:4] == b"glTF":
            length = struct.unpack_from("<I", data, 12)[0]
            self.tree, self.blob = json.loads(data[20:20 + length]), data[28 + length:]
        else:
            self.tree = json.loads(data)

    def buffer(self, index):
        uri = self.tree["buffers"][index].get("uri")
        if uri is None:
            return self.blob
        return base64.b64decode(uri.split(",", 1)[1]) if uri.startswith("data:") else (self.folder / uri).read_bytes()

    def rows(self, index):
        accessor = self.tree["accessors"][index]
        view = self.tree["bufferViews"][accessor["bufferView"]]
        form = "<%d%s" % (WIDTHS[accessor["type"]], FORMATS[accessor["componentType"]])
        begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        stride = view.get("byteStride") or struct.calcsize(form)
        data = self.buffer(view["buffer"])
        return [struct.unpack_from(form, data, begin + i * stride) for i in range(accessor["count"])]

    def names_of_strongest(self):
        """Per vertex the name of the joint with its largest weight, or of the joint that its mesh hangs on; in the
        order in which skelgen reads them, that of the scene's nodes."""
        nodes, skins = self.tree["nodes"], self.tree.get("skins", [])
        joints = {joint for skin in skins for joint in skin["joints"]}
        carrier = {}  # per node of the scene the joint that it is or hangs on
        front = [(root, None) for root in self.tree["scenes"][self.tree.get("scene", 0)]["nodes"]]
        while front:
            index, above = front.pop()
            carrier[index] = index if index in joints else above
            front += [(child, carrier[index]) for child in nodes[index].get("children", [])]
        out, done = [], set()
        for index in sorted(carrier):
            node = nodes[index]
            for primitive in self.tree["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
                attributes = primitive["attributes"]
                if (index, attributes["POSITION"]) in done:  # primitives may share their vertices
                    continue
                done.add((index, attributes["POSITION"]))
                if "JOINTS_0" in attributes and "skin" in node:
                    own = skins[node["skin"]]["joints"]
                    for used, weights in zip(self.rows(attributes["JOINTS_0"]), self.rows(attributes["WEIGHTS_0"])):
                        out.append(nodes[own[used[weights.index(max(weights))]]].get("name"))
                else:
                    name = None if carrier[index] is None else nodes[carrier[index]].get("name")
                    out += [name] * self.tree["accessors"][attributes["POSITION"]]["count"]
        return out


def compare(skelgen, path, folder):
    source = Gltf(path)
    if not source.tree.get("skins"):
        return None
    if "KHR_draco_mesh_compression" in source.tree.get("extensionsRequired", []):
        return "its vertices are compressed by Draco, which is not read here"
    try:
        names = source.names_of_strongest()
        theirs = [artists_bone(name) for name in names]
    except FileNotFoundError as error:
        return "%s is missing" % error.filename
    known = sum(bone is not None for bone in theirs)
    if 2 * known < len(theirs):
        return "its joints have no names that are known"
    output = folder / (path.stem + ".glb")
    ran = subprocess.run([skelgen, "rig", str(path), "-q", "-o", str(output)], capture_output=True, text=True)
    if ran.returncode != 0:
        return ran.stderr.strip().splitlines()[-1].split(": ", 2)[-1]
    ours = [our_bone(name) for name in Gltf(output).names_of_strongest()]
    if len(ours) != len(theirs):
        return "its vertices are %d, the rig's %d" % (len(theirs), len(ours))
    same = sum(mine == bone for mine, bone in zip(ours, theirs) if bone is not None)
    alike = sum(is_alike(mine, name) for mine, name, bone in zip(ours, names, theirs) if bone is not None)
    return 100.0 * same / known, 100.0 * alike / known


def main():
    skelgen, source = sys.argv[1], pathlib.Path(sys.argv[2])
    seen = 0
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted(source.iterdir()):
            if path.suffix.lower() not in (".glb", ".gltf", ".vrm"):
                continue
            result = compare(skelgen, path, pathlib.Path(folder))
            if result is None:
                continue
            seen += 1
            print("%-28s %s" % (path.stem, "%.1f %%, %.1f %%" % result if isinstance(result, tuple) else result))
    if seen == 0:
        sys.exit("no GLB, glTF or VRM with a skin in " + str(source))


if __name__ == "__main__":
    main()
