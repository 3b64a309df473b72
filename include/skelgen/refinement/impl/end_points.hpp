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

/// How far from the curve's leaf an end may lie, relative to the longest way along the curve: about a foot's length
/// over the surface, as a leaf may be in the heel, or in the thumb: nearer bounds cut the way to the true end off, and
/// what then lies farthest changes with the leaf.
template <typename Scalar>
inline constexpr Scalar end_reach = Scalar(0.12);

template <typename Scalar>
Eigen::VectorX<Scalar> distances_from(const core::SurfaceGraph<Scalar>& surface, int vertex) {
    const std::vector<Scalar> distance = core::distances_from(surface, {vertex});
    return Eigen::Map<const Eigen::VectorX<Scalar>>(distance.data(), static_cast<Eigen::Index>(distance.size()));
}

/// Of the vertices no farther than `reach` from a leaf the one where `far` is largest.
template <typename Scalar>
int farthest_near(int leaf, Scalar reach, const Eigen::VectorX<Scalar>& far, const std::vector<Scalar>& from_leaf) {
    int best = leaf;
    for (Eigen::Index v = 0; v < far.size(); ++v)
        if (from_leaf[static_cast<std::size_t>(v)] <= reach && std::isfinite(far[v]) && far[v] > far[best])
            best = static_cast<int>(v);
    return best;
}

/// The least of a rim's distances.
template <typename Scalar>
Scalar distance_to(const std::vector<int>& rim, const Eigen::VectorX<Scalar>& distance) {
    Scalar least = std::numeric_limits<Scalar>::infinity();
    for (const int v : rim) least = std::min(least, distance[v]);
    return least;
}

/// The rim that comes nearest to where the distances are from; empty where there is none.
template <typename Scalar>
std::vector<int> nearest_rim(const std::vector<std::vector<int>>& rims, const Eigen::VectorX<Scalar>& distance) {
    const auto nearest = std::min_element(rims.begin(), rims.end(), [&](const auto& a, const auto& b) {
        return distance_to(a, distance) < distance_to(b, distance);
    });
    return nearest == rims.end() ? std::vector<int>() : *nearest;
}

} // namespace detail

template <typename Scalar>
std::vector<EndPoint<Scalar>> find_end_points(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                                              const embedding::Embedding& embedding,
                                              const SkeletonTemplate& skeleton_template) {
    std::vector<EndPoint<Scalar>> ends; // at first the curve's leaves
    for (const embedding::Chain& chain : embedding.chains) {
        if (skeleton_template.joint(chain.joints.back()).role == JointRole::chest) continue;
        const int vertex = body.tree.nearest_vertex(body.mesh, core::point(curve.nodes, chain.nodes.back()));
        ends.push_back({chain.joints.back(), vertex, {}});
    }
    const auto ends_of = [&](BodyPart part) {
        std::vector<std::size_t> out;
        for (std::size_t i = 0; i < ends.size(); ++i)
            if (part_of(skeleton_template.joint(ends[i].joint).role) == part) out.push_back(i);
        return out;
    };
    const auto heads = ends_of(BodyPart::trunk), arms = ends_of(BodyPart::arm), legs = ends_of(BodyPart::leg);
    const auto measure = [&](EndPoint<Scalar>& end) { end.distance = detail::distances_from(body.graph, end.vertex); };
    const Scalar reach = detail::end_reach<Scalar> * embedding::matched_diameter(curve, embedding);
    std::vector<std::vector<Scalar>> near(ends.size()); // distances from the leaves, no farther than that
    const auto place = [&](const std::vector<std::size_t>& which, const std::vector<std::size_t>& seen_from) {
        Eigen::VectorX<Scalar> far = Eigen::VectorX<Scalar>::Zero(body.mesh.vertices.rows());
        for (const std::size_t i : seen_from) far += ends[i].distance;
        core::parallel_for(which.size(), 1, [&](std::size_t i) {
            EndPoint<Scalar>& end = ends[which[i]];
            end.vertex = detail::farthest_near(end.vertex, reach, far, near[which[i]]);
            measure(end);
        });
    };
    std::vector<std::size_t> upper = heads;
    upper.insert(upper.end(), arms.begin(), arms.end());
    const std::vector<std::size_t>& first = heads.empty() ? arms : heads;
    core::parallel_for(first.size() + ends.size(), 1, [&](std::size_t i) {
        if (i < first.size())
            measure(ends[first[i]]);
        else
            near[i - first.size()] = core::shortest_paths(body.graph, ends[i - first.size()].vertex, reach).distance;
    });
    place(legs, first);
    place(upper, legs);
    for (EndPoint<Scalar>& end : ends) end.rim = detail::nearest_rim(body.rims, end.distance);
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
