#pragma once

#include <skelgen/curve/branched_curve.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

/// Branches that leave a junction side by side become one up to where they part, which is their junction then: as long
/// as they are nearer to each other than half the radius of the ball inside the surface there, and over more than that
/// radius. Lines must be evenly spaced. O(k) distances to the surface.
template <typename Scalar>
[[nodiscard]] BranchedCurve<Scalar> merge_parallel_branches(BranchedCurve<Scalar> branched, const Body<Scalar>& body);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/parallel_branches.hpp>
#endif
