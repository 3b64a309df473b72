#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/line.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/refinement/placement.hpp>

namespace skelgen::refinement {

namespace detail {

/// The part of the way from chest to root along the curve in which neither chest nor thighs disturb the trunk's line.
/// Working values.
template <typename Scalar>
inline constexpr Scalar upper_trunk = Scalar(0.25);
template <typename Scalar>
inline constexpr Scalar lower_trunk = Scalar(0.75);

/// The line of the trunk between chest and root, by the curve's nodes there, away from the legs.
template <typename Scalar>
core::Line<Scalar> trunk_line(const Placement<Scalar>& placement, const CurveSkeleton<Scalar>& curve,
                              const embedding::Embedding& embedding) {
    const int root = 0, chest = placement.find(JointRole::chest);
    const Scalar length = placement.rest_distance(root, chest);
    std::vector<Vector3<Scalar>> centres;
    for (const embedding::Chain& chain : embedding.chains) {
        const auto has = [&](int joint) {
            return std::find(chain.joints.begin(), chain.joints.end(), joint) != chain.joints.end();
        };
        if (!has(root) || !has(chest)) continue;
        std::vector<int> nodes = chain.nodes;
        if (chain.joints.front() != chest) std::reverse(nodes.begin(), nodes.end());
        Scalar arc = 0;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (i > 0) arc += (core::point(curve.nodes, nodes[i]) - core::point(curve.nodes, nodes[i - 1])).norm();
            if (arc >= upper_trunk<Scalar> * length && arc <= lower_trunk<Scalar> * length)
                centres.push_back(core::point(curve.nodes, nodes[i]));
        }
        if (centres.size() < 2)
            centres = {core::point(curve.nodes, nodes.back()), core::point(curve.nodes, nodes.front())};
        core::Line<Scalar> line = core::principal_line(centres);
        if (line.direction.dot(core::point(curve.nodes, nodes.front()) - core::point(curve.nodes, nodes.back())) < 0)
            line.direction = -line.direction;
        return line;
    }
    return {placement.at(chest), Vector3<Scalar>::UnitZ()};
}

/// From a place straight to the line.
template <typename Scalar>
Vector3<Scalar> way_to(const core::Line<Scalar>& line, const Vector3<Scalar>& place) {
    const Vector3<Scalar> from = line.point - place;
    return from - from.dot(line.direction) * line.direction;
}

} // namespace detail

/// Places the joints that are all that is left of a limb (see is_bare): a shoulder or hip as the mirror image of the
/// other side's, a neck as far above the shoulders as at rest. The other shoulder and hip and, unless it is bare, the
/// neck must have been placed. O(k) for k nodes of the curve.
template <typename Scalar>
Placement<Scalar> place_bare_joints(Placement<Scalar> placement, const CurveSkeleton<Scalar>& curve,
                                    const embedding::Embedding& embedding) {
    const SkeletonTemplate& skeleton_template = placement.skeleton_template();
    for (int j = 0; j < static_cast<int>(skeleton_template.joints.size()); ++j) {
        if (!is_bare(skeleton_template, j)) continue;
        core::Line<Scalar> line = detail::trunk_line(placement, curve, embedding);
        const JointRole role = placement.role(j);
        if (role == JointRole::neck) {
            const double higher = placement.rest_height(role) - placement.rest_height(JointRole::shoulder);
            placement.put(j, *placement.middle(JointRole::shoulder) +
                                 placement.scale() * static_cast<Scalar>(higher) * line.direction);
            continue;
        }
        const int other = counterpart(skeleton_template, j), neck = placement.find(JointRole::neck);
        if (role == JointRole::shoulder && neck >= 0) line.point = placement.at(neck);
        const Vector3<Scalar> way = detail::way_to(line, placement.at(other));
        const Scalar half = Scalar(0.5) * placement.rest_distance(j, other);
        placement.put(j, placement.at(other) + (role == JointRole::hip ? Vector3<Scalar>(2 * half * way.normalized())
                                                                       : Vector3<Scalar>(2 * way)));
    }
    return placement;
}

} // namespace skelgen::refinement
