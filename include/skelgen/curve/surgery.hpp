#pragma once

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::curve {

/// Weights of the collapse cost (Au08 section 4).
struct SurgeryOptions {
    double shape_weight = 1.0;    ///< w_a: keeps the shape of the contracted mesh
    double sampling_weight = 3.0; ///< w_b (Au08: 0.1, which leaves a torso too few nodes to hold a head apart)
};

/// \throws Error usage when an option is out of its range.
void validate(const SurgeryOptions& options);

/// Connectivity surgery (Au08 section 4): half-edge collapses of a contracted mesh, cheapest first, until no face is
/// left. What remains is a graph with the contracted mesh's topology; each node's region holds the vertices that
/// collapsed into it, each vertex in exactly one. Radii are left empty. O(n log n). \throws Error usage when an option
/// is out of its range.
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> connectivity_surgery(const Points<Scalar>& contracted, const Triangles& faces,
                                                         const SurgeryOptions& options = {});

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/surgery.hpp>
#endif
