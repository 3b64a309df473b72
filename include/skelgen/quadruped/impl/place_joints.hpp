#pragma once

#include <skelgen/quadruped/place_joints.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/quadruped/joint_table.hpp>

namespace skelgen::quadruped {
namespace detail {

/// The way that a joint lies on.
template <typename Scalar>
const std::vector<int>& way_of(const Limbs<Scalar>& limbs, Way way, Side side) {
    switch (way) {
    case Way::fore_leg:
        return limbs.legs[static_cast<std::size_t>(side == Side::right ? right_fore : left_fore)];
    case Way::hind_leg:
        return limbs.legs[static_cast<std::size_t>(side == Side::right ? right_hind : left_hind)];
    case Way::trunk:
        return limbs.trunk;
    case Way::neck:
        return limbs.neck;
    case Way::tail:
        break;
    }
    return limbs.tail;
}

/// A way as a polyline; shares are of its length.
template <typename Scalar>
struct WayLine {
    Points<Scalar> places;
    Eigen::Matrix<Scalar, Eigen::Dynamic, 1> radii, arc;

    WayLine(const CurveSkeleton<Scalar>& curve, const std::vector<int>& way)
        : places(curve.nodes(way, Eigen::all)), radii(static_cast<Eigen::Index>(way.size())),
          arc(core::arc_lengths(places)) {
        for (std::size_t i = 0; i < way.size(); ++i)
            radii[static_cast<Eigen::Index>(i)] = curve.radii[static_cast<std::size_t>(way[i])];
    }
    [[nodiscard]] Scalar length_to(double share) const { return static_cast<Scalar>(share) * arc[arc.size() - 1]; }
    [[nodiscard]] Vector3<Scalar> place(double share) const { return core::point_at(places, arc, length_to(share)); }
    [[nodiscard]] Scalar radius(double share) const { return core::value_at(radii, arc, length_to(share)); }
};

/// How many joints of the same role and side come before a joint.
inline int ordinal_of(const SkeletonTemplate& skeleton_template, int joint) {
    const TemplateJoint& own = skeleton_template.joint(joint);
    int out = 0;
    for (int j = 0; j < joint; ++j)
        if (const TemplateJoint& other = skeleton_template.joint(j); other.role == own.role && other.side == own.side)
            ++out;
    return out;
}

/// Place in the middle between both legs of a pair, at a share of each.
template <typename Scalar>
Vector3<Scalar> between_legs(const CurveSkeleton<Scalar>& curve, const Limbs<Scalar>& limbs, Way pair, double share) {
    return (WayLine<Scalar>(curve, way_of(limbs, pair, Side::left)).place(share) +
            WayLine<Scalar>(curve, way_of(limbs, pair, Side::right)).place(share)) /
           2;
}

/// What a joint's offset from its share of a way is a weighted sum of, as columns: to places on the own way, between
/// the legs, on trunk and neck; the animal's size and the radii along the way, forward, up, outward, along the way and
/// across it; to the surface. They turn and grow with the animal, so that what holds for one pose holds for others.
template <typename Scalar>
Eigen::Matrix<Scalar, 3, direction_count> directions_of(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                                                        const Limbs<Scalar>& limbs, const WayLine<Scalar>& line,
                                                        double share, int side) {
    Eigen::Matrix<Scalar, 3, direction_count> out;
    Eigen::Index next = 0;
    const Vector3<Scalar> from = line.place(share);
    for (const double at : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) out.col(next++) = line.place(at) - from;
    for (const Way pair : {Way::fore_leg, Way::hind_leg})
        for (const double at : {0.0, 0.5, 1.0}) out.col(next++) = between_legs(curve, limbs, pair, at) - from;
    const WayLine<Scalar> trunk(curve, limbs.trunk), neck(curve, limbs.neck);
    for (const double at : {0.0, 0.5, 1.0}) out.col(next++) = trunk.place(at) - from;
    out.col(next++) = neck.place(0.5) - from;
    constexpr double near = 0.2;
    const Vector3<Scalar> along =
        (line.place(std::min(1.0, share + near)) - line.place(std::max(0.0, share - near))).stableNormalized();
    const Vector3<Scalar> outward = static_cast<Scalar>(side) * limbs.frame.left;
    Eigen::Matrix<Scalar, 3, 5> units;
    units << limbs.frame.forward, limbs.frame.up, outward, along, along.cross(limbs.frame.left).stableNormalized();
    std::array<Scalar, 7> lengths{limbs.size};
    constexpr std::array radius_shares{0.1, 0.3, 0.5, 0.7, 0.9};
    for (std::size_t i = 0; i < radius_shares.size(); ++i) lengths[i + 1] = line.radius(radius_shares[i]);
    lengths.back() = trunk.radii.mean();
    for (const Scalar length : lengths) {
        out.template middleCols<5>(next) = length * units;
        next += 5;
    }
    const auto farthest = static_cast<Scalar>(0.5) * limbs.size; // where a curve lies outside there may be no surface
    for (const Vector3<Scalar>& axis : {limbs.frame.forward, limbs.frame.up, outward})
        for (const int sign : {1, -1}) {
            const Vector3<Scalar> direction = static_cast<Scalar>(sign) * axis;
            if (direction.isZero()) // outward of a joint in the middle
                out.col(next++).setZero();
            else
                out.col(next++) =
                    std::min(body.tree.first_along(body.mesh, from, direction).distance, farthest) * direction;
        }
    return out;
}

} // namespace detail

template <typename Scalar>
KinematicSkeleton<Scalar> place_joints(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                                       const Limbs<Scalar>& limbs, const SkeletonTemplate& skeleton_template) {
    KinematicSkeleton<Scalar> out;
    out.template_name = skeleton_template.name;
    for (int j = 0; j < static_cast<int>(skeleton_template.joints.size()); ++j) {
        const TemplateJoint& wanted = skeleton_template.joint(j);
        Joint<Scalar>& joint = out.joints.emplace_back();
        joint.name = wanted.name;
        joint.parent = wanted.parent;
        const JointPlace& place = place_of(wanted.role, detail::ordinal_of(skeleton_template, j));
        const std::vector<int>& way = detail::way_of(limbs, place.way, wanted.side);
        if (way.empty()) {
            joint.is_present = false;
            joint.position = limbs.frame.origin;
            continue;
        }
        const detail::WayLine<Scalar> line(curve, way);
        joint.position = line.place(place.share) +
                         detail::directions_of(body, curve, limbs, line, place.share, sign_of(wanted.side)) *
                             Eigen::Map<const Eigen::Matrix<double, direction_count, 1>>(weights_of(place).data())
                                 .template cast<Scalar>();
        joint.radius = line.radius(place.share);
    }
    out.quality.matched_nodes = limbs.tail.empty() ? 5 : 6; // feet, head and tail
    out.frame = limbs.frame;
    out.frame.origin = out.joints.front().position;
    for (const TemplateJoint& joint : skeleton_template.joints) {
        if (!ends_limb(joint.role)) continue;
        const Way way = place_of(joint.role, 0).way;
        const std::vector<int>& nodes = detail::way_of(limbs, way, joint.side);
        out.end_points.emplace_back(end_point_name(skeleton_template, joint),
                                    core::point(curve.nodes, way == Way::neck ? nodes.back() : nodes.front()));
    }
    if (!limbs.tail.empty()) out.end_points.emplace_back("tail_tip", core::point(curve.nodes, limbs.tail.back()));
    return out;
}

} // namespace skelgen::quadruped
