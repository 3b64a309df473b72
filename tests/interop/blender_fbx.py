"""blender --background --factory-startup --python blender_fbx.py -- NAME...: fails where Blender does not import NAME.fbx as
it imports NAME.glb, both with one animation: objects, triangles, weights, texture coordinates, colours, materials with their
pictures, morph targets, bones; or where the triangles of either are not those of NAME-FRAME.off, one file for each pose that is
looked at. Materials of NAME.glb must show the pictures that the file has on them, and some file must have a picture and a morph
target that shows: else nothing is known of them."""

import glob
import json
import os
import re
import struct
import sys

import bpy
import numpy as np

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
from blender_checks import run  # noqa: E402


def read_off(path):
    """Where its triangles have their corners, in Blender's axes."""
    with open(path, encoding="ascii") as file:
        words = file.read().split()
    vertices, faces = int(words[1]), int(words[2])
    points = np.array(words[4 : 4 + 3 * vertices], float).reshape(-1, 3)
    corners = np.array(words[4 + 3 * vertices :], int).reshape(faces, 4)[:, 1:]
    points = points[corners.ravel()]
    return np.stack([points[:, 0], -points[:, 2], points[:, 1]], 1)  # Blender's z is up


def numbers(collection, name, columns):
    out = np.empty(columns * len(collection), np.float32)
    collection.foreach_get(name, out)
    return out.reshape(-1, columns)


def corner_vertices(mesh):
    out = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", out)
    return out


def world(points, matrix):
    m = np.array(matrix)
    return points @ m[:3, :3].T + m[:3, 3]


def places_now(body):
    shown = body.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    places = world(numbers(mesh.vertices, "co", 3), shown.matrix_world)[corner_vertices(mesh)]
    shown.to_mesh_clear()
    return places


def without_dropped(wanted, found):
    """The triangles that are found, too, in their order: Blender drops those that are there twice."""
    size = np.ptp(wanted, axis=0).max()
    wanted, kept = wanted.reshape(-1, 3, 3), []
    for triangle in wanted:
        place = len(kept)
        if 3 * place < len(found) and np.abs(triangle - found[3 * place : 3 * place + 3]).max() < 1e-3 * size:
            kept.append(triangle)
    return np.concatenate(kept) if kept else wanted[:0]


class File:
    """What is in a GLB, read without Blender."""

    def __init__(self, path):
        with open(path, "rb") as file:
            glb = file.read()
        (length,) = struct.unpack_from("<I", glb, 12)
        scene = json.loads(glb[20 : 20 + length])
        self.names = [node["name"] for node in scene["nodes"] if "mesh" in node]  # of the meshes, in their order
        self.shows_morphs = any(any(mesh.get("weights", [])) for mesh in scene["meshes"])
        self.pictures = {}  # the bytes of those that colour the materials
        for material in scene.get("materials", []):
            texture = material.get("pbrMetallicRoughness", {}).get("baseColorTexture")
            if texture is not None:
                image = scene["images"][scene["textures"][texture["index"]]["source"]]
                view = scene["bufferViews"][image["bufferView"]]
                start = 28 + length + view.get("byteOffset", 0)
                self.pictures[material.get("name")] = glb[start : start + view["byteLength"]]


def images_behind(socket):
    """Those that lead to a shader's input."""
    for link in socket.links:
        if link.from_node.type == "TEX_IMAGE":
            yield link.from_node.image
        for one in link.from_node.inputs:
            yield from images_behind(one)


def pictures():
    """The bytes of the pictures that colour the materials in Blender."""
    out = {}
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.node_tree else []:
            for image in images_behind(node.inputs["Base Color"]) if node.type == "BSDF_PRINCIPLED" else []:
                out[material.name] = image.packed_file.data if image and image.packed_file else b""
    return out


class Imported:
    """What Blender has of a file; all by corners of triangles, in their order. `names`: of its meshes, `frames`: what is looked
    at."""

    def __init__(self, path, names, frames):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.context.scene.render.fps = 30  # an FBX says so itself
        if path.endswith(".glb"):
            bpy.ops.import_scene.gltf(filepath=path)
        else:
            bpy.ops.import_scene.fbx(filepath=path)
        left = sorted((one for one in bpy.data.objects if one.type == "MESH" and one.vertex_groups), key=lambda one: one.name)
        self.bodies = []
        for name in names:  # those that share one are told apart by a number behind it
            found = next((one for one in left if re.fullmatch(re.escape(name[:59]) + r".{0,4}(\.\d+)?", one.name)), None)
            if found is None:
                sys.exit(f"{path}: no object {name} in {[one.name for one in left]}")
            left.remove(found)
            self.bodies.append(found)
        armature = next(one.object for one in self.bodies[0].modifiers if one.type == "ARMATURE")
        bones = armature.data.bones
        self.parents = {bone.name: bone.parent.name if bone.parent else None for bone in bones}
        self.heads = {bone.name: np.array(armature.matrix_world @ bone.head_local) for bone in bones}
        self.objects = [describe(body) for body in self.bodies]
        self.pictures = pictures()
        self.sizes = {image.packed_file.size for image in bpy.data.images if image.packed_file}
        self.places = {}
        for frame in frames:
            bpy.context.scene.frame_set(first_frame(armature) + frame)
            self.places[frame] = np.concatenate([places_now(body) for body in self.bodies])


def first_frame(armature):
    """That in which its animation begins: importers count from 0 or 1."""
    return round(armature.animation_data.action.frame_range[0])


def describe(body):
    mesh = body.data
    corners = corner_vertices(mesh)
    bones = sorted(group.name for group in body.vertex_groups)
    weights = np.zeros((len(mesh.vertices), len(bones)))
    columns = {group.index: bones.index(group.name) for group in body.vertex_groups}
    for vertex in mesh.vertices:
        for group in vertex.groups:
            weights[vertex.index, columns[group.group]] = group.weight
    out = {f"weights of {bone}": weights[corners, i] for i, bone in enumerate(bones) if weights[:, i].any()}
    for i, layer in enumerate(mesh.uv_layers):
        out[f"texture coordinates {i}"] = numbers(layer.data, "uv", 2)
    for layer in mesh.color_attributes:
        colours = numbers(layer.data, "color", 4)
        out["colours"] = colours[corners] if layer.domain == "POINT" else colours
    material = np.empty(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("material_index", material)
    slots = [slot.material.name if slot.material else None for slot in body.material_slots] or [None]
    out["materials"] = [slots[i] for i in material]
    for key in mesh.shape_keys.key_blocks[1:] if mesh.shape_keys else []:
        moved = numbers(key.data, "co", 3) - numbers(mesh.shape_keys.key_blocks[0].data, "co", 3)
        turned = world(moved, body.matrix_world) - np.array(body.matrix_world.translation)
        out[f"morph target {key.name}"] = turned[corners]
        out[f"weight of {key.name}"] = np.array([key.value])
    return out


def differences(one, other):
    """Of two objects' descriptions."""
    if set(one) != set(other):
        yield f"has {sorted(set(other) - set(one))} more, {sorted(set(one) - set(other))} less"
    for key in set(one) & set(other):
        if key == "materials":
            if one[key] != other[key]:
                yield f"materials differ: {set(zip(one[key], other[key]))}"
        elif one[key].shape != other[key].shape:
            yield f"{key}: {one[key].shape}, {other[key].shape}"
        # Blender holds colours in 16 bits or, of a byte's precision, in 8.
        elif one[key].size and (worst := np.abs(one[key] - other[key]).max()) > (5e-3 if key == "colours" else 1e-5):
            yield f"{key} differ by {worst}"


def faults_of(name):
    file = File(f"{name}.glb")
    files = {int(re.fullmatch(r".*-(\d+)\.off", one)[1]): read_off(one) for one in glob.glob(f"{glob.escape(name)}-*.off")}
    glb, fbx = (Imported(f"{name}.{extension}", file.names, files) for extension in ("glb", "fbx"))
    faults = []
    if glb.parents != fbx.parents:
        faults.append(f"bones are {fbx.parents}, not {glb.parents}")
    size = np.ptp(next(iter(files.values())), axis=0).max()
    for bone in set(glb.heads) & set(fbx.heads):
        if np.linalg.norm(glb.heads[bone] - fbx.heads[bone]) > 1e-5 * size:
            faults.append(f"{bone} lies at {fbx.heads[bone]}, not at {glb.heads[bone]}")
    for body, one, other in zip(file.names, glb.objects, fbx.objects):
        faults += [f"{body}: {text}" for text in differences(one, other)]
    for kind, found in (("GLB", glb.pictures), ("FBX", fbx.pictures)):
        for material, picture in file.pictures.items():
            if found.get(material) != picture:
                faults.append(f"{kind}: the picture of {material} has {len(found.get(material, b''))} bytes, not {len(picture)}")
    if not fbx.sizes <= glb.sizes or (glb.sizes and not fbx.sizes):
        faults.append(f"pictures of {fbx.sizes} bytes, not {glb.sizes}")
    worst = 0.0
    for frame, wanted in files.items():
        for kind, found in (("GLB", glb.places[frame]), ("FBX", fbx.places[frame])):
            kept = without_dropped(wanted, found) if len(found) < len(wanted) else wanted
            if found.shape == kept.shape:
                worst = max(worst, np.abs(found - kept).max() / size)
            else:
                faults.append(f"{kind}, frame {frame}: {len(found) // 3} triangles, not {len(kept) // 3}")
    if not worst < 1e-4:
        faults.append(f"triangles differ by {worst:.2g} of the extent")
    print(f"{name}: {len(files)} poses, triangles within {worst:.2g} of the extent")
    dressed.append(bool(file.pictures) and file.shows_morphs)
    return faults


dressed = []
run(faults_of, "FBX files", lambda: any(dressed))
