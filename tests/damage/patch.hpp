#pragma once

#include <cstddef>
#include <vector>

#include "soup.hpp"

namespace skelgen::damage {

/// A connected patch around a face, grown ring by ring until it has `part` of the surface's area. O(faces).
[[nodiscard]] std::vector<std::size_t> patch_around(const Soup& soup, const std::vector<Face>& beyond, std::size_t face,
                                                    double part);

} // namespace skelgen::damage
