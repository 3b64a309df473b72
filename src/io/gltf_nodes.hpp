#pragma once

#include <cstddef>
#include <vector>

#include "gltf_file.hpp"
#include "scene_pose.hpp"

namespace skelgen::io::detail {

/// The weights of morph targets that a node or a mesh has; none where it does not say.
[[nodiscard]] std::vector<double> read_morph_weights(const GltfValue& node_or_mesh);

/// The nodes of a glTF file. Their weights are those that they have themselves, in place of their meshes'.
struct GltfNodes {
    std::vector<SceneNode> nodes;
    std::vector<std::vector<std::size_t>> children;
};

/// \throws Error bad_input when a node is not sound or has two parents.
[[nodiscard]] GltfNodes read_nodes(const GltfFile& file);

/// The nodes of the scene that a viewer shows first, in the file's order: of the file's default scene, else of the
/// first; without scenes all. Nodes must not be their own ancestors.
[[nodiscard]] std::vector<std::size_t> shown_nodes(const GltfFile& file, const GltfNodes& nodes);

} // namespace skelgen::io::detail
