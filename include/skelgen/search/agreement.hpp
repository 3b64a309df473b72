#pragma once

#include <skelgen/core/header_only.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::search {

/// A body's largest extent along its principal axes, which are its coordinates' axes, in the input's unit: what
/// agreement() goes by. O(vertices).
template <typename Scalar>
[[nodiscard]] double extent_of(const Body<Scalar>& body) {
    const Points<Scalar>& vertices = body.mesh.vertices;
    return static_cast<double>(body.similarity.scale *
                               (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).maxCoeff());
}

/// How far two skeletons of one template agree: 1 where all joints lie on each other, 0.37 where they are apart by a
/// twentieth of `extent` in the mean, 0 where they have little in common. One row per joint, not finite where it is
/// absent: only joints that both have are compared, and one that is farther than 0.3 of the extent counts as that far.
/// 0 where both have less than half of the joints. O(joints).
[[nodiscard]] double agreement(const Points<double>& a, const Points<double>& b, double extent);

} // namespace skelgen::search

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/search/impl/agreement.hpp>
#endif
