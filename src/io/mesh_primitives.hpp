#pragma once

#include <optional>
#include <string>
#include <vector>

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
    double scale = 1; ///< from the looks' unit to the mesh's
};

/// A mesh of a scene that is being written.
struct WrittenObject {
    Json mesh;
    std::string name;                  ///< of its node
    std::string extras;                ///< of its node, JSON; empty: none
    std::optional<std::size_t> object; ///< which of the looks' it is; none: they have none
};

/// A mesh with its looks, as many meshes as they have objects with faces; without objects as one, "body". Of these the
/// primitives, one for each of the looks' parts that has faces, or for those of one material where parts have the same
/// vertices; these share them. With joints and weights where there is a skin; where turns are known with the looks'
/// normals and morph targets, else with smooth normals (`shading_normals`). \throws Error usage when there are no
/// faces, a coordinate is too large for a float, or looks or turns are those of another mesh.
[[nodiscard]] std::vector<WrittenObject> describe_objects(GltfBuffer& buffer, const WrittenMesh& written);

/// A node with an object's name and "extras", and no mesh.
[[nodiscard]] Json node_of(const WrittenObject& object);

/// Writes what the looks say of their file into a scene's "asset".
void add_about(Json& scene, const SceneLooks& looks);

/// Writes the materials of the looks and what they need into a scene, the pictures into its buffer.
void add_materials(Json& scene, GltfBuffer& buffer, const SceneLooks& looks);

} // namespace skelgen::io::detail
