#pragma once

#include <cstddef>
#include <set>

#include "gltf_value.hpp"

namespace skelgen::io::detail {

/// The materials, textures and images of a scene without some of its images, named by their numbers, and without what
/// shows no other: textures that have no picture then, and where materials name such a texture, which then have the
/// plain colour that is beside it. What stays has the numbers that then are right. Linear.
/// \throws Error bad_input when a texture refers to an image, or a material to a texture, that is not there.
[[nodiscard]] GltfValue::Json without_pictures(GltfValue::Json looks, const std::set<std::size_t>& lost);

} // namespace skelgen::io::detail
