#pragma once

#include <string_view>

#include <skelgen/io/polygon_mesh.hpp>
#include <skelgen/io/read_mesh.hpp>

#include "gltf_data.hpp"

namespace skelgen::io::detail {

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
