#pragma once

#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/io/scene_looks.hpp>

#include "gltf_buffer.hpp"

namespace skelgen::io::detail {

/// A mesh that is to be written, and what is known of it beside.
struct WrittenMesh {
    const TriangleMesh<double>& mesh;
    const applications::Skin<double>* skin;         ///< null: none
    const applications::VertexTurns<double>& turns; ///< from the looks' pose to the mesh's; empty: not known
    const SceneLooks& looks;
};

/// The primitives of a mesh with its looks, one for each of their parts that has faces, or for those of one material
/// where parts have the same vertices; these share them. With joints and weights where there is a skin; with the looks'
/// normals where turns are known, smooth ones (`shading_normals`) else. \throws Error usage when there are no faces, a
/// coordinate is too large for a float, or looks or turns are those of another mesh.
[[nodiscard]] Json describe_primitives(GltfBuffer& buffer, const WrittenMesh& written);

/// Writes the materials of the looks and what they need into a scene, the pictures into its buffer.
void add_materials(Json& scene, GltfBuffer& buffer, const SceneLooks& looks);

} // namespace skelgen::io::detail
