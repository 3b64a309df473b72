"""Gives the selected mesh of a human body an armature with weights, by running the program skelgen."""

import json
import os
import struct
import subprocess
import tempfile

import bpy
import numpy as np
from mathutils import Matrix, Quaternion, Vector

bl_info = {
    "name": "skelgen: rig a human body",
    "author": "skelgen's authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > skelgen",
    "description": "Finds the skeleton of a human body in a mesh and binds the mesh to it",
    "category": "Rigging",
}


class Refusal(Exception):
    """Why there is no armature, as the user is told."""


# ---- the program ----


def format_off(points, polygons):
    """An OFF file of points (n x 3) and polygons (lists of their indices)."""
    lines = ["OFF", f"{len(points)} {len(polygons)} 0"]
    lines += [f"{x!r} {y!r} {z!r}" for x, y, z in points.tolist()]
    lines += [" ".join(map(str, [len(polygon), *polygon])) for polygon in polygons]
    return "\n".join(lines) + "\n"


def run_skelgen(program, points, polygons, options):
    """The GLB that `skelgen rig` with those options makes of a mesh, and its warnings. Raises Refusal with the program's own reason."""
    with tempfile.TemporaryDirectory() as folder:
        mesh, rig = os.path.join(folder, "mesh.off"), os.path.join(folder, "rig.glb")
        with open(mesh, "w", encoding="ascii") as file:
            file.write(format_off(points, polygons))
        try:
            run = subprocess.run([program, "rig", mesh, "-o", rig, *options], capture_output=True, text=True, check=False)
        except OSError as error:
            raise Refusal(
                f"{program} cannot be run ({error.strerror}); set its path in the add-on's preferences"
            ) from error
        said = [line.replace(f"{mesh}: ", "") for line in run.stderr.splitlines()]
        if run.returncode != 0:
            errors = [line for line in said if line.startswith("skelgen: error: ")]
            raise Refusal(errors[-1] if errors else f"{program} ended with status {run.returncode}")
        with open(rig, "rb") as file:
            return file.read(), [line for line in said if line.startswith("skelgen: warning: ")]


# ---- its result ----


class Rig:
    """What is in a GLB of `skelgen rig`. Of the vertices: positions (n x 3), joints and weights (n x 4).

    Of each joint its name, parent (-1: none) and the 4 x 4 from its axes to the rig's, parents before children."""

    def __init__(self, glb):
        (length,) = struct.unpack_from("<I", glb, 12)
        self.scene = json.loads(glb[20 : 20 + length])
        self.data = glb[28 + length :]
        attributes = self.scene["meshes"][0]["primitives"][0]["attributes"]
        self.positions = self.rows(attributes["POSITION"])
        self.joints = self.rows(attributes["JOINTS_0"])
        self.weights = self.rows(attributes["WEIGHTS_0"])

        nodes = self.scene["skins"][0]["joints"]
        self.names = [self.scene["nodes"][node]["name"] for node in nodes]
        self.parents = [-1] * len(nodes)
        for j, node in enumerate(nodes):
            for child in self.scene["nodes"][node].get("children", []):
                self.parents[nodes.index(child)] = j
        self.axes = []
        for node, parent in zip(nodes, self.parents):
            x, y, z, w = self.scene["nodes"][node]["rotation"]
            own = Matrix.Translation(self.scene["nodes"][node]["translation"]) @ Quaternion((w, x, y, z)).to_matrix().to_4x4()
            self.axes.append(own if parent < 0 else self.axes[parent] @ own)

    def rows(self, index):
        """The numbers of an accessor, one row for each vertex."""
        accessor = self.scene["accessors"][index]
        view = self.scene["bufferViews"][accessor["bufferView"]]
        columns = {"VEC3": 3, "VEC4": 4}[accessor["type"]]
        kind = {5121: "<u1", 5123: "<u2", 5126: "<f4"}[accessor["componentType"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        numbers = np.frombuffer(self.data, kind, accessor["count"] * columns, start)
        return numbers.reshape(-1, columns)

    def bone_lengths(self):
        """How far each joint's bone reaches along its y: to the next joint, or to the end of what it moves most."""
        lengths = []
        for j, axes in enumerate(self.axes):
            back = axes.inverted()
            ways = [back @ child.translation for child, parent in zip(self.axes, self.parents) if parent == j]
            if ways:
                along = [max(ways, key=lambda way: way.y / (way.length or 1.0)).y]  # the one that y points at
            else:
                moved = self.positions[self.joints[:, 0] == j]
                along = [(back @ Vector(point)).y for point in moved.tolist()]
            lengths.append(max(along, default=0.0))
        usual = max(lengths)
        return [length if length > 0.01 * usual else 0.1 * usual for length in lengths]


def similarity(source, target):
    """The 4 x 4 of the rotation, uniform scale and translation that bring points (n x 3) to others (Umeyama 1991). Raises
    Refusal where none does."""
    source, target = np.asarray(source, float), np.asarray(target, float)
    from_middle, to_middle = source.mean(0), target.mean(0)
    a, b = source - from_middle, target - to_middle
    u, strengths, vt = np.linalg.svd(b.T @ a)
    signs = np.array([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    turn = u @ np.diag(signs) @ vt
    scale = (strengths * signs).sum() / (a * a).sum()
    if np.abs(scale * a @ turn.T - b).max() > 1e-3 * np.abs(b).max():
        raise Refusal("the character does not lie where the mesh is")
    out = np.eye(4)
    out[:3, :3] = scale * turn
    out[:3, 3] = to_middle - scale * turn @ from_middle
    return Matrix(out.tolist())


# ---- Blender's side ----


def world_mesh(target):
    """Points (n x 3) and polygons of an object's mesh in the world's coordinates, without its modifiers."""
    mesh = target.data
    points = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", points)
    matrix = np.array(target.matrix_world)
    points = points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]
    # Mirrored, a mesh is turned inside out.
    step = -1 if target.matrix_world.determinant() < 0 else 1
    return points, [list(polygon.vertices)[::step] for polygon in mesh.polygons]


def add_armature(context, target, rig, placing):
    """The rig's joints as an armature beside the object, in the world's coordinates."""
    armature = bpy.data.objects.new(f"{target.name} rig", bpy.data.armatures.new(f"{target.name} rig"))
    target.users_collection[0].objects.link(armature)
    context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    bones, scale = [], placing.to_scale().x
    turn = placing.to_quaternion().to_matrix().to_4x4()
    for name, parent, axes, length in zip(rig.names, rig.parents, rig.axes, rig.bone_lengths()):
        bone = armature.data.edit_bones.new(name)
        bone.head, bone.tail = (0, 0, 0), (0, scale * length, 0)
        bone.matrix = Matrix.Translation(placing @ axes.translation) @ turn @ axes.to_quaternion().to_matrix().to_4x4()
        if parent >= 0:
            bone.parent = bones[parent]
            bone.use_connect = (bone.head - bones[parent].tail).length < 1e-4 * scale
        bones.append(bone)
    bpy.ops.object.mode_set(mode="OBJECT")
    armature.show_in_front = True
    return armature


def add_weights(target, rig, armature):
    """Vertex groups of the bones' names, in the place of those that are there, and what makes the armature move them."""
    for name in rig.names:
        if name in target.vertex_groups:
            target.vertex_groups.remove(target.vertex_groups[name])
    groups = [target.vertex_groups.new(name=name) for name in rig.names]
    for vertex, (joints, weights) in enumerate(zip(rig.joints.tolist(), rig.weights.tolist())):
        for joint, weight in zip(joints, weights):
            if weight > 0:
                groups[joint].add([vertex], weight, "REPLACE")
    modifier = target.modifiers.new("skelgen", "ARMATURE")
    modifier.object = armature
    modifier.use_deform_preserve_volume = True
    place = target.matrix_world.copy()
    target.parent = armature
    target.matrix_world = place


class SKELGEN_OT_rig(bpy.types.Operator):
    """Find the skeleton of the human body in the active mesh and bind the mesh to it"""

    bl_idname = "object.skelgen_rig"
    bl_label = "Rig human body"
    bl_options = {"REGISTER", "UNDO"}

    names: bpy.props.EnumProperty(
        name="Names",
        description="Whose names the bones get",
        items=[(name, name, "") for name in ("skelgen", "smpl", "mixamo", "vrm")],
    )
    fingers: bpy.props.BoolProperty(name="Fingers", description="Bones of the fingers, where the surface shows some", default=True)
    toes: bpy.props.BoolProperty(name="Toes", description="Bones of single toes, where the surface shows them")

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH" and context.mode == "OBJECT"

    def execute(self, context):
        target = context.object
        program = bpy.path.abspath(context.preferences.addons[__name__].preferences.program)
        try:
            if any(modifier.type == "ARMATURE" for modifier in target.modifiers):
                raise Refusal(f"{target.name} has an armature; remove its modifier first")
            points, polygons = world_mesh(target)
            options = ["--names", self.names, "--fingers", "auto" if self.fingers else "off", *(["--toes"] if self.toes else [])]
            glb, warnings = run_skelgen(program, points, polygons, options)
            rig = Rig(glb)
            if len(rig.positions) != len(points):
                raise Refusal(f"the character has {len(rig.positions)} vertices, the mesh has {len(points)}")
            placing = similarity(rig.positions, points)
        except Refusal as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}
        for warning in warnings:
            self.report({"WARNING"}, warning)
        armature = add_armature(context, target, rig, placing)
        add_weights(target, rig, armature)
        target.select_set(False)
        armature.select_set(True)
        self.report({"INFO"}, f"{len(rig.names)} bones")
        return {"FINISHED"}


class SKELGEN_PT_rig(bpy.types.Panel):
    bl_label = "skelgen"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "skelgen"

    def draw(self, _context):
        self.layout.operator(SKELGEN_OT_rig.bl_idname, icon="ARMATURE_DATA")


class SkelgenPreferences(bpy.types.AddonPreferences):
    bl_idname = __name__

    program: bpy.props.StringProperty(
        name="Program", description="skelgen, by its name or its path", default="skelgen", subtype="FILE_PATH"
    )

    def draw(self, _context):
        self.layout.prop(self, "program")


classes = (SkelgenPreferences, SKELGEN_OT_rig, SKELGEN_PT_rig)


def register():
    for one in classes:
        bpy.utils.register_class(one)


def unregister():
    for one in reversed(classes):
        bpy.utils.unregister_class(one)
