#pragma once

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// Weights of the collapse cost (Au08 section 4).
struct SurgeryOptions {
    double shape_weight = 1.0;    ///< w_a: keeps the shape of the contracted mesh
    double sampling_weight = 3.0; ///< w_b (Au08: 0.1, which leaves a torso too few nodes to hold a head apart)
};

/// Connectivity surgery (Au08 section 4): half-edge collapses of a contracted mesh, cheapest first, until no face is
/// left. What remains is a graph with the contracted mesh's topology; each node's region holds the vertices that
/// collapsed into it, each vertex in exactly one. Radii are left empty. O(n log n).
[[nodiscard]] CurveSkeleton<double> connectivity_surgery(const Points<double>& contracted, const Triangles& faces,
                                                         const SurgeryOptions& options = {});

} // namespace skelgen
