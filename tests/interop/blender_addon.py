"""blender --background --factory-startup --python blender_addon.py -- ADDON PROGRAM BODY.off BODY.json: fails where the
add-on does not give a body the armature that `skelgen extract --fingers on` found in it (BODY.json), with weights that move it."""

import json
import os
import sys

import bpy
import numpy as np
from mathutils import Matrix, Vector

addon, program, mesh_path, skeleton_path = sys.argv[sys.argv.index("--") + 1 :]
faults = []


def expect(condition, what):
    if not condition:
        faults.append(what)


def add_mesh(name, points, polygons, matrix):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], polygons)
    made = bpy.data.objects.new(name, mesh)
    made.matrix_world = matrix
    bpy.context.collection.objects.link(made)
    bpy.context.view_layer.update()
    return made


def rig(target, **options):
    """What the operator says: {'FINISHED'}, or the error's text."""
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = target
    target.select_set(True)
    try:
        return bpy.ops.object.skelgen_rig(**options)
    except RuntimeError as error:  # how a script sees an operator's error
        return str(error)


def shape(target):
    """Where the vertices are, as modifiers have them, in the world's coordinates."""
    graph = bpy.context.evaluated_depsgraph_get()
    mesh = target.evaluated_get(graph).to_mesh()
    return np.array([target.matrix_world @ vertex.co for vertex in mesh.vertices])


bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_install(filepath=addon)
name = os.path.splitext(os.path.basename(addon))[0]
bpy.ops.preferences.addon_enable(module=name)
preferences = bpy.context.preferences.addons[name].preferences
preferences.program = program

with open(mesh_path, encoding="ascii") as file:
    numbers = file.read().split()
count, faces = int(numbers[1]), int(numbers[2])
points = np.array(numbers[4 : 4 + 3 * count], float).reshape(-1, 3)
polygons = np.array(numbers[4 + 3 * count :], int).reshape(faces, 4)[:, 1:]
with open(skeleton_path, encoding="utf-8") as file:
    joints = json.load(file)["joints"]

# As scenes have them: turned, in another unit, with a material slot and a group of its own.
placed = Matrix.LocRotScale(Vector((3, -2, 1)), Matrix.Rotation(1.1, 3, (1, 2, 3)).to_quaternion(), Vector((40, 40, 40)))
body = add_mesh("body", points.tolist(), polygons.tolist(), placed)
body.vertex_groups.new(name="own")
before = shape(body)
expect(rig(body) == {"FINISHED"}, "the body gets no armature")
armature = body.parent
expect(armature is not None and armature.type == "ARMATURE", "the body does not hang on an armature")
bones = armature.data.bones
expect(len(bones) == len(joints) == 51, f"{len(bones)} bones")
size = float(np.ptp(before, axis=0).max())
for joint in joints:
    bone = bones.get(joint["name"])
    if bone is None:
        expect(False, f"no bone {joint['name']}")
        continue
    expect((bone.parent.name if bone.parent else None) == joint["parent"], f"{bone.name} hangs on {bone.parent}")
    off = (armature.matrix_world @ bone.head_local - placed @ Vector(joint["position"])).length
    expect(off < 1e-4 * size, f"{bone.name} is {off / size} of the body off")
    child = next((one for one in bones if one.parent == bone and one.name.startswith(joint["name"].split("_")[0])), None)
    if child and "_" in joint["name"]:
        expect((bone.tail_local - child.head_local).length < 1e-3 * size, f"{bone.name} does not end in {child.name}")
expect(np.abs(shape(body) - before).max() < 1e-4 * size, "at rest the armature moves the body")
expect("own" in body.vertex_groups, "the body's own group is gone")
sums = [sum(group.weight for group in vertex.groups) for vertex in body.data.vertices]
expect(max(abs(total - 1) for total in sums) < 1e-5, "weights do not sum to 1")
expect(max(len(vertex.groups) for vertex in body.data.vertices) <= 4, "more than four bones move a vertex")

# A turn about x bends the elbow: the forearm goes along, nothing else does.
elbow = armature.pose.bones["left_elbow"]
elbow.rotation_mode = "XYZ"
elbow.rotation_euler.x = 1
bpy.context.view_layer.update()
moved = np.linalg.norm(shape(body) - before, axis=1)
strongest = [body.vertex_groups[max(vertex.groups, key=lambda group: group.weight).group].name for vertex in body.data.vertices]
hand = np.array([one == "left_wrist" or one[-1].isdigit() and one.startswith("left_") for one in strongest])
other = np.array([one.startswith("right_") or "knee" in one or "head" in one for one in strongest])
expect(moved[hand].min() > 0.02 * size, "the hand stays where it is")
expect(moved[other].max() < 1e-4 * size, "the elbow moves the other side")

elbow.rotation_euler.x = 0
finger = armature.pose.bones["left_index_2"]
finger.rotation_mode = "XYZ"
finger.rotation_euler.x = 1
bpy.context.view_layer.update()
moved = np.linalg.norm(shape(body) - before, axis=1)
of_finger = np.array([one in ("left_index_2", "left_index_3") for one in strongest])
near = np.array([any(body.vertex_groups[group.group].name in ("left_index_2", "left_index_3") for group in vertex.groups)
                 for vertex in body.data.vertices])
expect(moved[of_finger].max() > 0.005 * size, "the finger stays where it is")
expect(moved[~near].max() < 1e-4 * size, "the finger moves something else")

expect("has an armature" in str(rig(body)), "a second armature is not refused")
mixamo = add_mesh("mixamo", points.tolist(), polygons.tolist(), Matrix.Diagonal((-1, 1, 1, 1)))  # mirrored
expect(rig(mixamo, names="mixamo", fingers=False, toes=True) == {"FINISHED"}, "a mirrored body gets no armature")
expect(len(mixamo.parent.data.bones) == 21, "bones of fingers that are not wanted, or of toes that are not there")
arm = mixamo.parent.data.bones.get("LeftForeArm")
theirs = placed @ Vector(next(joint["position"] for joint in joints if joint["name"] == "right_elbow"))
mirrored = Matrix.Diagonal((-1, 1, 1, 1)) @ placed.inverted() @ theirs  # right is left in a mirror
expect(arm and (arm.head_local - mirrored).length < 0.02 * float(np.ptp(points, axis=0).max()), "left is not left in a mirror")

objects = len(bpy.data.objects)
cube = add_mesh("cube", [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)],
                [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)], Matrix())
expect("no human body" in str(rig(cube)), "a cube is not refused with the reason")
preferences.program = "/no/such/program"
expect("cannot be run" in str(rig(cube)), "a program that is missing is not named")
expect(len(bpy.data.objects) == objects + 1 and not cube.modifiers and not cube.vertex_groups, "a refusal leaves something")
bpy.ops.preferences.addon_disable(module=name)

for fault in faults:
    print(fault)
print(f"the add-on in Blender {bpy.app.version_string}: {len(faults)} faults")
sys.exit(1 if faults else 0)
