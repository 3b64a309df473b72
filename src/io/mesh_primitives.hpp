#pragma once

#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/io/scene_looks.hpp>

#include "gltf_buffer.hpp"

namespace skelgen::io::detail {

/// The primitives of a mesh with its looks, one for each of their parts that has faces; those of the same vertices
/// share them. With smooth normals, and joints and weights where there is a skin. \throws Error usage when there are no
/// faces, a coordinate is too large for a float, or the looks are those of another mesh.
[[nodiscard]] Json describe_primitives(GltfBuffer& buffer, const TriangleMesh<double>& mesh,
                                       const applications::Skin<double>* skin, const SceneLooks& looks);

/// Writes the materials of the looks and what they need into a scene, the pictures into its buffer.
void add_materials(Json& scene, GltfBuffer& buffer, const SceneLooks& looks);

} // namespace skelgen::io::detail
