#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <skelgen/io/polygon_mesh.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/scene_looks.hpp>

#include "gltf_data.hpp"

namespace skelgen::io::detail {

/// Where the triangles of a primitive are in the mesh that a scene gives. Triangles that name a vertex twice do not
/// count: `triangulate` leaves them out.
struct GltfPart {
    std::size_t node = 0, mesh = 0, primitive = 0; ///< of the file
    Eigen::Index first_vertex = 0, vertices = 0;
    Eigen::Index first_face = 0, faces = 0;
    /// Of its vertices, as they are in the scene; unit length, or zero where one has no direction. No rows: none are
    /// given.
    Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> normals = {};
};

/// The parts of a scene, what nodes they are of, and these nodes' morph targets.
struct GltfScene {
    std::vector<GltfPart> parts;
    std::vector<SceneObject> objects;           ///< without names
    std::string lost_morphs;                    ///< why there are no morph targets; empty: there are all
    std::vector<Eigen::Matrix4d> node_matrices; ///< where each of the file's nodes is
};

/// The parts of the scene that `parse_gltf` reads, in the order of their faces. `morphs`: the same file, from which
/// morph targets are read; what is wrong with these costs them alone. \throws Error as `parse_gltf`.
[[nodiscard]] GltfScene gltf_scene(GltfData& data, GltfData& morphs, const ReadMeshOptions& options);

/// glTF 2.0 (Khr21): JSON, GLB or VRM. All triangles of the scene that a viewer shows first, as it shows them: morph
/// targets by their weights, skins posed by their joints' nodes, all else moved by its node. Nodes in the scene's
/// order, each before its children; primitives in the mesh's order, those of the same vertices with one copy of them.
///
/// Why not tinygltf: as packaged it cannot read Draco, refuses files with parts for meshopt, decodes all pictures, and
/// checks no accessor against its buffer.
///
/// Linear in the numbers read, which are bounded by a small multiple of the bytes of the scene's files.
/// \throws Error bad_input, naming the place in the JSON, for anything that does not hold together; usage for an
///         animation that is not there; what `load` throws.
[[nodiscard]] PolygonMesh parse_gltf(std::string_view bytes, const ReadMeshOptions& options, const LoadCompanion& load);

} // namespace skelgen::io::detail
