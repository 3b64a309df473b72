#pragma once

#include <cstdint>
#include <vector>

#include "gltf_buffer.hpp"

namespace skelgen::io::detail {

/// Tangents of a part's vertices (Khr21 section 3.7.2.1), n x 4: the unit direction in which the first texture
/// coordinate grows, at right angles to the normal, and 1 where their cross product leads up in the picture, which is
/// where the second coordinate falls, or -1 where it leads down, as on mirrored parts. Means over the faces around each
/// vertex by their areas; where these say nothing, any direction along the surface. `positions` and `normals`: n x 3,
/// of the part's vertices; `faces`: indices of those; `coordinates`: n x 2. Linear.
[[nodiscard]] FloatRows tangents(const FloatRows& positions, const FloatRows& normals,
                                 const std::vector<std::uint32_t>& faces, const FloatRows& coordinates);

} // namespace skelgen::io::detail
