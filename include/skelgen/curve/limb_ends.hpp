#pragma once

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::curve {

/// What contraction leaves at the end of a limb may be a node on the surface, of radius 0, or even outside. Beside a
/// leaf such a node moves inward along the curve, half the way at a time, until it is inside, and takes its new radius
/// from its region, or from the nearest vertex where it has none left; a leaf without a radius takes over its
/// neighbour's. The radii must be there; regions index the vertices of `mesh`, outward and closed but for small holes.
/// O(leaves * faces).
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> place_limb_ends(const CurveSkeleton<Scalar>& curve,
                                                    const TriangleMesh<Scalar>& mesh);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/limb_ends.hpp>
#endif
