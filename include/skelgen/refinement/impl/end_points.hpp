#pragma once

#include <skelgen/refinement/end_points.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/parallel.hpp>

namespace skelgen::refinement {
namespace detail {

/// How far from the curve's leaf an end may lie, relative to the geodesic diameter: about a hand's length.
template <typename Scalar>
inline constexpr Scalar end_reach = Scalar(0.08);

template <typename Scalar>
Eigen::VectorX<Scalar> distances_from(const core::SurfaceGraph<Scalar>& surface, int vertex) {
    const std::vector<Scalar> distance = core::distances_from(surface, {vertex});
    return Eigen::Map<const Eigen::VectorX<Scalar>>(distance.data(), static_cast<Eigen::Index>(distance.size()));
}

/// Sum of the distances to the ends at the other end of the body: for feet to the head, or without one to the hands;
/// for the others to the feet.
template <typename Scalar>
Eigen::VectorX<Scalar> remoteness(const EndPoint<Scalar>& end, const std::vector<EndPoint<Scalar>>& ends,
                                  const SkeletonTemplate& skeleton_template) {
    const auto part = [&](const EndPoint<Scalar>& e) { return part_of(skeleton_template.joint(e.joint).role); };
    const bool has_head =
        std::any_of(ends.begin(), ends.end(), [&](const auto& e) { return part(e) == BodyPart::trunk; });
    const BodyPart other_part = part(end) != BodyPart::leg ? BodyPart::leg : has_head ? BodyPart::trunk : BodyPart::arm;
    Eigen::VectorX<Scalar> sum = Eigen::VectorX<Scalar>::Zero(end.distance.size());
    for (const EndPoint<Scalar>& other : ends)
        if (part(other) == other_part) sum += other.distance;
    return sum;
}

/// The rim that comes nearest to where the distances are from; empty where there is none.
template <typename Scalar>
std::vector<int> nearest_rim(const std::vector<std::vector<int>>& rims, const Eigen::VectorX<Scalar>& distance) {
    const auto nearness = [&](const std::vector<int>& rim) {
        Scalar least = std::numeric_limits<Scalar>::infinity();
        for (const int v : rim) least = std::min(least, distance[v]);
        return least;
    };
    const auto nearest = std::min_element(rims.begin(), rims.end(),
                                          [&](const auto& a, const auto& b) { return nearness(a) < nearness(b); });
    return nearest == rims.end() ? std::vector<int>() : *nearest;
}

} // namespace detail

template <typename Scalar>
std::vector<EndPoint<Scalar>> find_end_points(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                                              const embedding::Embedding& embedding,
                                              const SkeletonTemplate& skeleton_template) {
    std::vector<EndPoint<Scalar>> leaves;
    for (const embedding::Chain& chain : embedding.chains) {
        if (skeleton_template.joint(chain.joints.back()).role == JointRole::chest) continue;
        const int vertex = body.tree.nearest_vertex(body.mesh, core::point(curve.nodes, chain.nodes.back()));
        leaves.push_back({chain.joints.back(), vertex, {}});
    }
    core::parallel_for(leaves.size(), 1, [&](std::size_t i) {
        leaves[i].distance = detail::distances_from(body.graph, leaves[i].vertex);
    });
    const Scalar radius = detail::end_reach<Scalar> * geodesic_diameter(leaves);
    std::vector<EndPoint<Scalar>> ends(leaves.size());
    core::parallel_for(leaves.size(), 1, [&](std::size_t i) {
        const EndPoint<Scalar>& leaf = leaves[i];
        const Eigen::VectorX<Scalar> far = detail::remoteness(leaf, leaves, skeleton_template);
        int best = leaf.vertex;
        for (Eigen::Index v = 0; v < far.size(); ++v)
            if (leaf.distance[v] <= radius && std::isfinite(far[v]) && far[v] > far[best]) best = static_cast<int>(v);
        ends[i] = {leaf.joint, best, best == leaf.vertex ? leaf.distance : detail::distances_from(body.graph, best)};
        ends[i].rim = detail::nearest_rim(body.rims, ends[i].distance);
    });
    return ends;
}

template <typename Scalar>
Scalar geodesic_diameter(const std::vector<EndPoint<Scalar>>& ends) {
    Scalar diameter = 0;
    for (const EndPoint<Scalar>& a : ends)
        for (const EndPoint<Scalar>& b : ends)
            if (std::isfinite(a.distance[b.vertex])) diameter = std::max(diameter, a.distance[b.vertex]);
    return diameter;
}

} // namespace skelgen::refinement
