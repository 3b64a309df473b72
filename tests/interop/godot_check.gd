# godot3-server --path PROJECT -s godot_check.gd: writes SCENE.json for each scene of the project: bones, meshes, animations, and
# where the bones are in the times that the project's times.json lists.
extends SceneTree


func _init():
	var times = parse_json(read("res://times.json"))
	var folder = Directory.new()
	folder.open("res://")
	folder.list_dir_begin(true, true)
	var name = folder.get_next()
	while name:
		if name.get_extension() in ["glb", "fbx"]:
			var file = File.new()
			file.open("res://%s.json" % name, File.WRITE)
			file.store_string(to_json(described("res://" + name, times)))
			file.close()
		name = folder.get_next()
	quit()


func read(path):
	var file = File.new()
	file.open(path, File.READ)
	return file.get_as_text()


func described(path, times):
	var packed = load(path)
	if not packed is PackedScene:
		return null
	var scene = packed.instance()
	get_root().add_child(scene)
	var out = {"skeletons": [], "meshes": [], "animations": [], "poses": []}
	var skeletons = found(scene, "Skeleton")
	for skeleton in skeletons:
		out.skeletons.append(bones_of(skeleton))
	var bodies = found(scene, "MeshInstance")
	for body in bodies:
		out.meshes.append(mesh_of(body, skeletons))
	for player in found(scene, "AnimationPlayer"):
		for name in player.get_animation_list():
			var animation = player.get_animation(name)
			out.animations.append({"name": name, "length": animation.length, "tracks": tracks_of(animation)})
	for time in times:
		for player in found(scene, "AnimationPlayer"):
			player.play(player.get_animation_list()[0])
			player.seek(time, true)
		out.poses.append(pose_of(skeletons, bodies))
	scene.free()
	return out


# In the order of the tree.
func found(node, kind):
	var out = [node] if node.is_class(kind) else []
	for child in node.get_children():
		out += found(child, kind)
	return out


func bones_of(skeleton):
	var out = []
	for bone in skeleton.get_bone_count():
		var rest = skeleton.get_bone_rest(bone)
		var parent = skeleton.get_bone_parent(bone)
		if parent >= 0:
			rest = out[parent].rest * rest
		out.append({"name": skeleton.get_bone_name(bone), "parent": parent, "rest": rest})
	for bone in out:
		bone.rest = numbers(skeleton.global_transform * bone.rest)
	return out


func mesh_of(body, skeletons):
	var mesh = body.mesh
	var skin = body.skin
	var skeleton = body.get_node_or_null(body.skeleton)
	var out = {"name": body.name, "skeleton": skeletons.find(skeleton), "binds": [], "morphs": [], "surfaces": []}
	if skin and skeleton:
		for bind in skin.get_bind_count():
			var name = skin.get_bind_name(bind)
			var bone = skeleton.find_bone(name) if name else skin.get_bind_bone(bind)
			out.binds.append({"bone": bone, "pose": numbers(skin.get_bind_pose(bind))})
	for morph in mesh.get_blend_shape_count():
		var name = mesh.get_blend_shape_name(morph)
		out.morphs.append({"name": name, "weight": body.get("blend_shapes/" + name)})
	for surface in mesh.get_surface_count():
		var own = body.get_surface_material(surface)
		var arrays = mesh.surface_get_arrays(surface)
		var morphs = []
		for morph in mesh.surface_get_blend_shape_arrays(surface):
			morphs.append(coded(morph[Mesh.ARRAY_VERTEX]))
		out.surfaces.append({
			"format": mesh.surface_get_format(surface),
			"positions": coded(arrays[Mesh.ARRAY_VERTEX]),
			"bones": coded(arrays[Mesh.ARRAY_BONES]),
			"weights": coded(arrays[Mesh.ARRAY_WEIGHTS]),
			"indices": coded(arrays[Mesh.ARRAY_INDEX]),
			"morphs": morphs,
			"picture": picture_of(own if own else mesh.surface_get_material(surface)),
		})
	return out


# What colours a material: its size and its pixels.
func picture_of(material):
	if not material is SpatialMaterial or not material.albedo_texture:
		return null
	var picture = material.albedo_texture.get_data()
	if picture.is_compressed():
		picture.decompress()
	picture.clear_mipmaps()
	picture.convert(Image.FORMAT_RGBA8)
	return {"width": picture.get_width(), "height": picture.get_height(), "pixels": coded(picture.get_data())}


func tracks_of(animation):
	var out = []
	for track in animation.get_track_count():
		out.append({"path": str(animation.track_get_path(track)), "keys": animation.track_get_key_count(track)})
	return out


func pose_of(skeletons, bodies):
	var out = {"skeletons": [], "meshes": []}
	for skeleton in skeletons:
		var poses = []
		for bone in skeleton.get_bone_count():
			poses.append(numbers(skeleton.get_bone_global_pose(bone)))
		out.skeletons.append(poses)
	for body in bodies:
		out.meshes.append(numbers(body.global_transform))
	return out


# Of a 3 x 4 matrix, row by row. (JSON would have six decimals of each.)
func numbers(m):
	var x = m.basis.x
	var y = m.basis.y
	var z = m.basis.z
	var o = m.origin
	return coded(PoolRealArray([x.x, y.x, z.x, o.x, x.y, y.y, z.y, o.y, x.z, y.z, z.z, o.z]))


# Its floats or integers of 32 bits in base64, behind eight bytes of type and length.
func coded(array):
	return Marshalls.variant_to_base64(array) if array else null
