#pragma once

#include <vector>

#include <Eigen/Core>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::refinement {

/// Where a limb ends on the surface.
template <typename Scalar = double>
struct EndPoint {
    int joint = -1;                  ///< template joint that ends the limb
    int vertex = -1;                 ///< mesh vertex
    Eigen::VectorX<Scalar> distance; ///< per mesh vertex the geodesic distance to it; infinite where no path leads
    std::vector<int> rim = {};       ///< vertices around the closed hole (Body::rims) nearest to it; empty without any
};

/// The ends of all limbs, in the order of the embedding's chains: near the curve's leaves, the vertices farthest over
/// the surface from the feet (for hands and head) or from the head (for feet). Defined by the surface alone, they do
/// not depend on how the curve was found. O(limbs n log n).
template <typename Scalar>
[[nodiscard]] std::vector<EndPoint<Scalar>>
find_end_points(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding,
                const SkeletonTemplate& skeleton_template);

/// Largest finite geodesic distance between two ends: the geodesic diameter of a body. O(ends^2).
template <typename Scalar>
[[nodiscard]] Scalar geodesic_diameter(const std::vector<EndPoint<Scalar>>& ends);

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/end_points.hpp>
#endif
