#pragma once

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::curve {

/// Embedding refinement (Au08 section 5): contraction drifts off centre; each node moves back by how far, on average
/// over the boundary loops of its region, the surface has been displaced. `mesh` is the mesh that was contracted,
/// `contracted` its contracted vertices, n x 3; the regions of `curve` index them, each vertex in exactly one. Leaves
/// have one loop, junctions three or more. Fills the radii. O(faces log k).
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> centre_nodes(const CurveSkeleton<Scalar>& curve, const TriangleMesh<Scalar>& mesh,
                                                 const Points<Scalar>& contracted);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/centring.hpp>
#endif
