#pragma once

#include <skelgen/core/curve_skeleton.hpp>

namespace skelgen::cli {

/// The curve skeleton of the mesh's largest piece, in the mesh's coordinates.
/// \throws Error as the steps of `extract_curve`.
[[nodiscard]] CurveSkeleton<double> find_curve(const TriangleMesh<double>& mesh);

} // namespace skelgen::cli
