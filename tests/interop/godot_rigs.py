"""godot_rigs.py PROJECT FILE...: fails where Godot 3 does not import NAME.glb and NAME.fbx as they are, with one animation.

Both must have the bones, weights, morph targets and animation of NAME.glb, which has its pictures, too. Their triangles, with
the morph targets' default weights, must be those of NAME-FRAME.off, one file for each pose that is looked at. Some file
must have a picture and morph targets that show: else nothing is known of them. PROJECT is a folder that it makes. GLB needs
skelgen's own names: Godot 3 writes all bones of GLB in small letters, digits and underscores."""

import base64
import glob
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np

RATE = 30  # of the frames
# Of materials in files of their own the editor waits for pictures, which it cannot draw here.
SETTINGS = {
    "materials/storage": 0,
    "animation/fps": RATE,  # it samples animations
    "animation/optimizer/enabled": False,  # or it drops keys
}
WEIGHTS = 1.1 / 65535  # Godot cuts weights off after 16 bits
POSES = 1e-4  # so those of a corner may lack 4 / 65535 of its distance from the origin, which is about the extent here
KINDS = {5121: "<u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}


def read_off(path):
    """Where its triangles have their corners."""
    with open(path, encoding="ascii") as file:
        words = file.read().split()
    vertices, faces = int(words[1]), int(words[2])
    points = np.array(words[4 : 4 + 3 * vertices], float).reshape(-1, 3)
    corners = np.array(words[4 + 3 * vertices :], int).reshape(faces, 4)[:, 1:]
    return points[corners.ravel()]


def plain_pixels(png):
    """Those of a PNG with red, green and blue of 8 bits and no filter, as dressed_body.py writes it; of others none."""
    if png[:8] != b"\x89PNG\r\n\x1a\n":
        return None
    width, height, *kind = struct.unpack_from(">IIBBBBB", png, 16)
    parts, at = b"", 8
    while at < len(png):
        (length,) = struct.unpack_from(">I", png, at)
        parts += png[at + 8 : at + 8 + length] if png[at + 4 : at + 8] == b"IDAT" else b""
        at += 12 + length
    if kind != [8, 2, 0, 0, 0]:
        return None
    rows = np.frombuffer(zlib.decompress(parts), np.uint8).reshape(height, 1 + 3 * width)
    return None if rows[:, 0].any() else rows[:, 1:].reshape(height, width, 3)


class Body:
    """A mesh by corners of triangles, in their order: places, weights by bone, whether there is a picture on them, and the
    morph targets' differences. Also those pictures' pixels that are known."""

    def __init__(self, name, bones, morphs):
        """`morphs`: their default weights."""
        self.name, self.bones, self.defaults = name, bones, morphs
        self.parts, self.pictures = [], []

    def add(self, corners, positions, joints, weights, morphs, pictures):
        """`pictures`: the part's own by their pixels, None where these are not known."""
        table = np.zeros((len(positions), len(self.bones)))
        np.add.at(table, (np.arange(len(positions))[:, None], joints), weights)
        pictured = np.full(len(positions), bool(pictures))
        self.parts.append([array[corners] for array in (positions, table, pictured, *morphs)])
        self.pictures += [one for one in pictures if one is not None]

    def close(self):
        places, weights, self.pictured, *morphs = (np.concatenate(arrays) for arrays in zip(*self.parts))
        self.places, self.morphs = places, dict(zip(self.defaults, morphs))
        self.weights = {}
        for bone, column in zip(self.bones, weights.T):
            self.weights[bone] = self.weights.get(bone, 0) + column
        return self


class File:
    """What is in a GLB, read without Godot."""

    def __init__(self, path):
        glb = Path(path).read_bytes()
        (length,) = struct.unpack_from("<I", glb, 12)
        self.scene, self.data = json.loads(glb[20 : 20 + length]), glb[28 + length :]
        nodes, (skin,), (animation,) = (self.scene[key] for key in ("nodes", "skins", "animations"))
        parent_of = {child: i for i, node in enumerate(nodes) for child in node.get("children", [])}
        names = [nodes[joint]["name"] for joint in skin["joints"]]
        parents = [parent_of.get(joint) for joint in skin["joints"]]
        self.parents = dict(zip(names, (nodes[one]["name"] if one in skin["joints"] else None for one in parents)))
        binds = self.rows(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
        self.places = dict(zip(names, np.linalg.inv(binds)[:, :3, 3]))
        self.bodies = [self.body(node["name"], self.scene["meshes"][node["mesh"]], names) for node in nodes if "mesh" in node]
        self.clip = animation["name"]
        self.length = max(self.rows(one["input"]).max() for one in animation["samplers"])
        self.moved = {nodes[one["target"]["node"]]["name"] for one in animation["channels"]}

    def rows(self, index):
        accessor = self.scene["accessors"][index]
        kind = KINDS[accessor["componentType"]]
        columns = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}[accessor["type"]]

        def numbers(part, kind, count):
            start = self.scene["bufferViews"][part["bufferView"]].get("byteOffset", 0) + part.get("byteOffset", 0)
            return np.frombuffer(self.data, kind, count, start)

        out = np.zeros((accessor["count"], columns))
        if "bufferView" in accessor:
            out = numbers(accessor, kind, out.size).reshape(out.shape)
        if "sparse" in accessor:
            sparse = accessor["sparse"]
            places = numbers(sparse["indices"], KINDS[sparse["indices"]["componentType"]], sparse["count"])
            out = out.copy()
            out[places] = numbers(sparse["values"], kind, columns * sparse["count"]).reshape(-1, columns)
        return out

    def body(self, name, mesh, bones):
        morphs = mesh.get("extras", {}).get("targetNames", [])
        out = Body(name, bones, dict(zip(morphs, mesh.get("weights", [0] * len(morphs)))))
        for part in mesh["primitives"]:
            positions, joints, weights = (self.rows(part["attributes"][key]) for key in ("POSITION", "JOINTS_0", "WEIGHTS_0"))
            corners = self.rows(part["indices"]).ravel() if "indices" in part else np.arange(len(positions))
            targets = [self.rows(target["POSITION"]) for target in part.get("targets", [])]
            out.add(corners, positions, joints, weights, targets, self.pictures(part))
        return out.close()

    def pictures(self, part):
        """The pixels of that which colours a primitive."""
        material = self.scene["materials"][part["material"]] if "material" in part else {}
        texture = material.get("pbrMetallicRoughness", {}).get("baseColorTexture")
        if texture is None:
            return []
        image = self.scene["images"][self.scene["textures"][texture["index"]]["source"]]
        view = self.scene["bufferViews"][image["bufferView"]]
        start = view.get("byteOffset", 0)
        return [plain_pixels(self.data[start : start + view["byteLength"]])]


def decoded(text, kind, columns=1):
    return np.frombuffer(base64.b64decode(text), kind, offset=8).reshape(-1, columns)


def matrix(text):
    return np.vstack([decoded(text, "<f4", 4), [0, 0, 0, 1]])


class Imported:
    """What Godot has of a file."""

    def __init__(self, path):
        scene = json.loads(Path(path).read_text(encoding="utf-8"))
        if scene is None:
            raise ValueError("is not imported")
        if len(scene["skeletons"]) != 1 or not all(mesh["binds"] for mesh in scene["meshes"]):
            raise ValueError(f"has {len(scene['skeletons'])} skeletons, or a mesh that none moves")
        (bones,) = scene["skeletons"]
        self.names = [bone["name"] for bone in bones]
        self.parents = {bone["name"]: self.names[bone["parent"]] if bone["parent"] >= 0 else None for bone in bones}
        self.places = {bone["name"]: matrix(bone["rest"])[:3, 3] for bone in bones}
        # Godot's front is clockwise; each importer has its way to turn a triangle round.
        self.order = [0, 2, 1] if path.endswith(".glb.json") else [2, 1, 0]
        self.animations, self.poses, self.meshes = scene["animations"], scene["poses"], scene["meshes"]
        self.bodies = [self.body(mesh) for mesh in self.meshes]

    def sort(self, wanted):
        """Brings the meshes into an order: Godot has those of FBX in an order and with names of its own."""
        left = list(range(len(self.bodies)))
        order = [left.pop(left.index(min(left, key=lambda i: unlike(one, self.bodies[i])))) for one in wanted]
        self.bodies, self.meshes = ([one[i] for i in order] for one in (self.bodies, self.meshes))
        for pose in self.poses:
            pose["meshes"] = [pose["meshes"][i] for i in order]

    def body(self, mesh):
        bones = [self.names[bind["bone"]] for bind in mesh["binds"]]
        out = Body(mesh["name"], bones, {morph["name"]: morph["weight"] for morph in mesh["morphs"]})
        for part in mesh["surfaces"]:
            positions = decoded(part["positions"], "<f4", 3)
            corners = decoded(part["indices"], "<i4", 3)[:, self.order].ravel()
            morphs = [decoded(morph, "<f4", 3) - positions for morph in part["morphs"]]
            joints, weights = decoded(part["bones"], "<i4", 4), decoded(part["weights"], "<f4", 4)
            pictures = [self.pixels(part["picture"])] if part["picture"] else []
            out.add(corners, positions, joints, weights, morphs, pictures)
        return out.close()

    @staticmethod
    def pixels(picture):
        return decoded(picture["pixels"], np.uint8)[:, 0].reshape(int(picture["height"]), int(picture["width"]), 4)[..., :3]

    def places_in(self, pose):
        """Where the corners are, as Godot's shaders move them."""
        out = []
        bones = [matrix(bone) for bone in pose["skeletons"][0]]
        for mesh, body, placed in zip(self.meshes, self.bodies, pose["meshes"]):
            points = body.places + sum(weight * body.morphs[name] for name, weight in body.defaults.items())
            points = np.concatenate([points, np.ones((len(points), 1))], 1)
            moved = np.zeros_like(points)
            for bind in mesh["binds"]:
                weights = body.weights[self.names[bind["bone"]]][:, None]
                moved += weights * (points @ (bones[bind["bone"]] @ matrix(bind["pose"])).T)
            out.append((moved @ matrix(placed).T)[:, :3])
        return np.concatenate(out)


def unlike(one, other):
    return np.abs(one.places - other.places).max() if one.places.shape == other.places.shape else np.inf


def differences(wanted, found, size):
    """Of two bodies."""
    if wanted.places.shape != found.places.shape:
        yield f"{len(found.places) // 3} triangles, not {len(wanted.places) // 3}"
        return
    if (worst := unlike(wanted, found)) > 1e-6 * size:
        yield f"corners differ by {worst:.2g}"
    for bone in sorted({*wanted.weights, *found.weights}):
        worst = np.abs(wanted.weights.get(bone, 0) - found.weights.get(bone, 0)).max()
        if worst > WEIGHTS:
            yield f"weights of {bone} differ by {worst:.2g}"
    if (wanted.pictured != found.pictured).any():
        yield f"{found.pictured.sum() // 3} triangles have a picture, not {wanted.pictured.sum() // 3}"
    for one in wanted.pictures:
        if not any(np.array_equal(one, other) for other in found.pictures):
            yield f"no picture has the pixels of one of {one.shape[1]} x {one.shape[0]}"
    if list(wanted.morphs) != list(found.morphs):
        yield f"morph targets are {list(found.morphs)}, not {list(wanted.morphs)}"
    for name, weight in wanted.defaults.items():
        if abs(found.defaults.get(name, np.inf) - weight) > 1e-5:
            yield f"the weight of {name} is {found.defaults.get(name)}, not {weight}"
    for name in wanted.morphs.keys() & found.morphs.keys():
        if (worst := np.abs(wanted.morphs[name] - found.morphs[name]).max()) > 1e-6 * size:
            yield f"morph target {name} differs by {worst:.2g}"


def posed(path):
    """Files of posed triangles, by frame."""
    name = Path(path).with_suffix("")
    files = glob.glob(f"{glob.escape(str(name))}-*.off")
    return {int(found[1]): file for file in files if (found := re.fullmatch(r"-(\d+)\.off", file[len(str(name)) :]))}


def is_dressed(body):
    """Whether it has a picture whose pixels are known, and a morph target that shows."""
    return bool(body.pictures) and any(weight and body.morphs[name].any() for name, weight in body.defaults.items())


def faults_of(path, imported, frames):
    wanted, files = File(Path(path).with_suffix(".glb")), posed(path)
    if not files:
        return ["has no pose to look at"]
    try:
        found = Imported(imported)
    except ValueError as fault:
        return [str(fault)]
    faults = []
    size = np.ptp(np.concatenate([body.places for body in wanted.bodies]), axis=0).max()
    if found.parents != wanted.parents:
        return [f"bones are {found.parents}, not {wanted.parents}"]
    for bone, place in wanted.places.items():
        if np.linalg.norm(found.places[bone] - place) > 1e-5 * size:
            faults.append(f"{bone} lies at {found.places[bone]}, not at {place}")
    if len(found.bodies) != len(wanted.bodies):
        return [*faults, f"meshes are {[one.name for one in found.bodies]}, not {[one.name for one in wanted.bodies]}"]
    found.sort(wanted.bodies)
    for one, other in zip(wanted.bodies, found.bodies):
        if path.endswith(".fbx"):  # Godot has no pictures and no default weights of any, Blender's as well
            other.pictured, other.pictures = one.pictured, one.pictures
            if one.defaults.keys() == other.defaults.keys():
                other.defaults = one.defaults
        faults += [f"{one.name}: {text}" for text in differences(one, other, size)]
    names = [animation["name"] for animation in found.animations]
    if names != [wanted.clip]:
        return [*faults, f"animations are {names}, not {wanted.clip}"]
    (animation,) = found.animations
    if abs(animation["length"] - wanted.length) > 1e-5:
        faults.append(f"the animation lasts {animation['length']} s, not {wanted.length} s")
    moved = {track["path"].split(":")[1] for track in animation["tracks"]}
    if moved != wanted.moved:
        faults.append(f"the animation moves {sorted(moved)}, not {sorted(wanted.moved)}")
    worst = 0.0
    for frame, file in files.items():
        places, shown = read_off(file), found.places_in(found.poses[frames.index(frame)])
        if shown.shape == places.shape:
            worst = max(worst, np.abs(shown - places).max() / size)
        else:
            faults.append(f"{file} has {len(places) // 3} triangles, not {len(shown) // 3}")
    if not worst < POSES:
        faults.append(f"triangles differ by {worst:.2g} of the extent")
    print(f"{path}: {len(files)} poses, triangles within {worst:.2g} of the extent")
    return faults


def godot(project, *arguments):
    """Runs it, with its settings and caches in the project."""
    own = {f"XDG_{kind}_HOME": str(project / ".godot") for kind in ("CONFIG", "DATA", "CACHE")}
    command = ["godot3-server", "--path", str(project), *arguments]
    done = subprocess.run(command, env={**os.environ, **own}, capture_output=True, text=True, errors="replace", timeout=600)
    if done.returncode:
        sys.exit(f"{done.stdout}{done.stderr}{' '.join(command)} ends with {done.returncode}")


project, paths = Path(sys.argv[1]).resolve(), sys.argv[2:]
(project / ".godot").mkdir(parents=True)
copies = [project / f"{i}{Path(path).suffix}" for i, path in enumerate(paths)]
for path, copy in zip(paths, copies):
    shutil.copy(path, copy)
frames = sorted({frame for path in paths for frame in posed(path)})
(project / "times.json").write_text(json.dumps([frame / RATE for frame in frames]))
(project / "project.godot").write_text(f"config_version=4\n\n[importer_defaults]\n\nscene={json.dumps(SETTINGS)}\n")
shutil.copy(Path(__file__).with_name("godot_check.gd"), project)
version = re.match(r"[\d.]*\d", subprocess.run(["godot3-server", "--version"], capture_output=True, text=True).stdout)[0]
for _ in range(5):  # on a busy machine the editor may quit before it has imported anything
    godot(project, "--editor", "--quit")
    if all(Path(f"{copy}.import").exists() for copy in copies):
        break
godot(project, "-s", "godot_check.gd")
failed = dressed = 0
for path, copy in zip(paths, copies):
    faults = faults_of(path, f"{copy}.json", frames)
    failed += bool(faults)
    dressed += any(is_dressed(body) for body in File(Path(path).with_suffix(".glb")).bodies)
    for fault in faults:
        print(f"{path}: {fault}")
if not dressed:
    print("no file has a picture and a morph target that shows")
print(f"Godot {version}: {len(paths)} files, {dressed} with a picture and morph targets, {failed} failed")
sys.exit(0 if dressed and failed == 0 else 1)
