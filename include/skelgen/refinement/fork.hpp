#pragma once

#include <optional>

#include <skelgen/core/mesh.hpp>
#include <skelgen/refinement/end_points.hpp>

namespace skelgen {

/// Where two limbs part: of all places on the surface that are equally far from both limbs' ends, the nearest. Between
/// the feet it lies between the legs, wherever those are. None when no path joins the ends. O(m).
[[nodiscard]] std::optional<Vector3<double>> fork_between(const TriangleMesh<double>& mesh, const EndPoint& a,
                                                          const EndPoint& b);

} // namespace skelgen
