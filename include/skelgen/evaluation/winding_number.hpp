#pragma once

#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// How many times the surface goes round `point`: 1 inside of a closed mesh whose faces look outwards, 0 outside, and
/// something between near the holes of an open one. The sum of the triangles' solid angles over 4 pi (van Oosterom &
/// Strackee 1983). O(faces).
[[nodiscard]] double winding_number(const TriangleMesh<double>& mesh, const Vector3<double>& point);

} // namespace skelgen
