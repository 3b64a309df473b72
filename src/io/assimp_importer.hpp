#pragma once

#include <string_view>

#include <skelgen/applications/motion_clip.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/polygon_mesh.hpp>
#include <skelgen/io/read_mesh.hpp>

#include "scene_clip.hpp"

namespace skelgen::io::detail {

/// Whether the bytes begin as FBX does, in text or binary.
[[nodiscard]] bool is_fbx(std::string_view bytes);

/// Whether they begin as COLLADA (DAE) does.
[[nodiscard]] bool is_collada(std::string_view bytes);

/// FBX or DAE, by the library assimp: all polygons of the scene, posed by its skins, all else moved by its nodes.
/// Corners of a mesh at exactly the same position are one vertex. Morph targets are not applied: assimp does not say by
/// how much.
///
/// Some files crash the library: where `options.isolated`, it runs in a process of its own, of limited time and memory.
/// \throws Error bad_input when it cannot read the file, or this build lacks it, which the message then says; usage for
///         an animation that is not there.
[[nodiscard]] PolygonMesh import_scene(std::string_view bytes, MeshFormat format, const ReadMeshOptions& options);

/// The skeleton of such a file and how it moves. \throws Error as `import_scene` and `clip_of`.
[[nodiscard]] applications::MotionClip import_clip(std::string_view bytes, MeshFormat format,
                                                   const ClipOfScene& wanted);

} // namespace skelgen::io::detail
