#pragma once

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

/// How a limb's end is found.
struct LeafExtensionOptions {
    /// How far back on the curve to stand when looking for the end, relative to the largest distance along the curve:
    /// half a hand. Calibrated.
    double anchor = 0.05;
};

/// \throws Error usage when an option is out of its range.
void validate(const LeafExtensionOptions& options);

/// Contraction shortens limbs; this gives every leaf a last node at the end of its limb: the vertex of the leaf's
/// region that lies farthest from a point a little way back on the curve. Regions index the vertices of `body` in
/// ascending order; of a region in several pieces only the largest counts, since where two limbs touch a few vertices
/// may have gone to the wrong one. The new node has radius 0. O(k^2 log k + n log n). \throws Error usage when an
/// option is out of its range.
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> extend_leaves(const CurveSkeleton<Scalar>& curve, const Body<Scalar>& body,
                                                  const LeafExtensionOptions& options = {});

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/leaf_extension.hpp>
#endif
