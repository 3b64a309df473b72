"""blender --background --factory-startup --python blender_rigs.py -- GLB...: fails where Blender does not import a rig
with its bones, 21 and those of digits, named, parented and as long as in the file, with the file's weights, or where
thumb and index, as far as there are some, do not bend alone."""

import json
import os
import struct
import sys

import bpy
import numpy as np
from mathutils import Matrix, Quaternion, Vector

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
from blender_checks import run  # noqa: E402


class File:
    """What is in a GLB, read without Blender: joints by name with their parent and place, and weights by vertex."""

    def __init__(self, path):
        with open(path, "rb") as file:
            glb = file.read()
        (length,) = struct.unpack_from("<I", glb, 12)
        scene, data = json.loads(glb[20 : 20 + length]), glb[28 + length :]

        def rows(index):
            accessor = scene["accessors"][index]
            kind = {5121: "<u1", 5123: "<u2", 5126: "<f4"}[accessor["componentType"]]
            columns = {"VEC3": 3, "VEC4": 4}[accessor["type"]]
            start = scene["bufferViews"][accessor["bufferView"]].get("byteOffset", 0)
            return np.frombuffer(data, kind, accessor["count"] * columns, start).reshape(-1, columns)

        # Primitives may have the same vertices: each counts once.
        parts = {part["POSITION"]: part for part in (one["attributes"] for one in scene["meshes"][0]["primitives"])}.values()
        self.positions, self.joints, self.weights = (
            np.concatenate([rows(part[name]) for part in parts]) for name in ("POSITION", "JOINTS_0", "WEIGHTS_0")
        )
        nodes = scene["skins"][0]["joints"]
        self.names = [scene["nodes"][node]["name"] for node in nodes]
        parent_of = {child: node for node in nodes for child in scene["nodes"][node].get("children", [])}
        places = {}
        self.parents, self.places = {}, {}
        for node in nodes:
            x, y, z, w = scene["nodes"][node]["rotation"]
            own = Matrix.Translation(scene["nodes"][node]["translation"]) @ Quaternion((w, x, y, z)).to_matrix().to_4x4()
            places[node] = places[parent_of[node]] @ own if node in parent_of else own
            name = scene["nodes"][node]["name"]
            self.parents[name] = scene["nodes"][parent_of[node]]["name"] if node in parent_of else None
            x, y, z = places[node].translation
            self.places[name] = Vector((x, -z, y))  # Blender's z is up


def faults_of(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    file = File(path)
    armatures = [one for one in bpy.data.objects if one.type == "ARMATURE"]
    bodies = [one for one in bpy.data.objects if one.type == "MESH" and one.vertex_groups]
    if len(armatures) != 1 or len(bodies) != 1:
        return [f"{len(armatures)} armatures, {len(bodies)} bodies"]
    armature, body = armatures[0], bodies[0]
    bones = armature.data.bones
    faults = []
    if len(bones) < 21 or {bone.name for bone in bones} != set(file.names):
        return [f"bones are {[bone.name for bone in bones]}"]
    size = float(np.ptp(file.positions, axis=0).max())
    for bone in bones:
        if (bone.parent.name if bone.parent else None) != file.parents[bone.name]:
            faults.append(f"{bone.name} hangs on {bone.parent}")
        at = armature.matrix_world @ bone.head_local
        if (at - file.places[bone.name]).length > 1e-5 * size:
            faults.append(f"{bone.name} lies at {at}, not at {file.places[bone.name]}")
        if bone.parent:
            length = (bone.head_local - bone.parent.head_local).length
            wanted = (file.places[bone.name] - file.places[bone.parent.name]).length
            if abs(length - wanted) > 1e-5 * size:
                faults.append(f"from {bone.parent.name} to {bone.name} it is {length}, not {wanted}")
    if len(body.data.vertices) != len(file.positions):
        return [*faults, f"{len(body.data.vertices)} vertices"]
    names = [group.name for group in body.vertex_groups]
    worst = 0.0
    for vertex in body.data.vertices:
        wanted = {}
        for joint, weight in zip(file.joints[vertex.index], file.weights[vertex.index]):
            if weight > 0:
                wanted[file.names[joint]] = float(weight)
        found = {names[group.group]: group.weight for group in vertex.groups if group.weight > 0}
        worst = max(worst, *(abs(found.get(name, 0) - wanted.get(name, 0)) for name in {*wanted, *found}))
    if worst > 1e-6:
        faults.append(f"weights differ by {worst}")
    return faults + faults_of_digits(file, armature, body, size)


def places_of(body):
    """Where the vertices are, as the armature has them."""
    mesh = body.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    places = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", places)
    return places.reshape(-1, 3)


def faults_of_digits(file, armature, body, size):
    """What is wrong when thumb and index are turned by a radian, one after the other."""
    faults = []
    rest = places_of(body)
    for name in (f"{side}_{digit}_2" for side in ("left", "right") for digit in ("thumb", "index")):
        if name not in file.names:
            continue
        bone = armature.pose.bones[name]
        behind = {one for one in file.names if one == name or bone in armature.pose.bones[one].parent_recursive}
        moves = np.array([one in behind for one in file.names])
        follows = (moves[file.joints] & (file.weights > 0)).any(axis=1)
        bone.rotation_mode = "XYZ"
        bone.rotation_euler.x = 1
        bpy.context.view_layer.update()
        moved = np.linalg.norm(places_of(body) - rest, axis=1)
        bone.rotation_euler.x = 0
        if not moved[follows].max(initial=0) > 1e-3 * size:
            faults.append(f"{name} does not bend")
        if moved[~follows].max(initial=0) > 1e-5 * size:
            faults.append(f"{name} moves what does not follow it")
    return faults


run(faults_of, "rigs")
