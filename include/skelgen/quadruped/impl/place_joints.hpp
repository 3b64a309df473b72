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

/// The animal's directions at its head, which may be turned and lowered: forward along the end of the neck.
template <typename Scalar>
BodyFrame<Scalar> head_frame(const CurveSkeleton<Scalar>& curve, const Limbs<Scalar>& limbs) {
    BodyFrame<Scalar> out = limbs.frame;
    constexpr double before = 0.7;
    const WayLine<Scalar> neck(curve, limbs.neck);
    const Vector3<Scalar> way = neck.place(1) - neck.place(before);
    if (!(way.norm() > 0)) return out;
    out.forward = way.normalized();
    const Vector3<Scalar> up = out.forward.cross(limbs.frame.left);
    if (!(up.norm() > 0)) return limbs.frame;
    out.up = up.normalized();
    out.left = out.up.cross(out.forward);
    return out;
}

/// How many joints of the same role and side come before a joint.
inline int ordinal_of(const SkeletonTemplate& skeleton_template, int joint) {
    const TemplateJoint& own = skeleton_template.joint(joint);
    int out = 0;
    for (int j = 0; j < joint; ++j)
        if (const TemplateJoint& other = skeleton_template.joint(j); other.role == own.role && other.side == own.side)
            ++out;
    return out;
}

/// What a joint's place on a way is told from, of a mean animal 0: how the way runs and how thick the body is along it,
/// in parts of the animal's size, and its build. `outward`: 1 on the left, -1 on the right, 0 for ways in the middle.
template <typename Scalar>
PlaceFeatures features_of(const WayLine<Scalar>& line, const Limbs<Scalar>& limbs, Way way, int outward) {
    const bool is_leg = way == Way::fore_leg || way == Way::hind_leg;
    const Vector3<Scalar> root = line.place(is_leg ? 1 : 0); // where it leaves the trunk
    PlaceFeatures out{};
    std::size_t next = 0;
    for (const double share : {0.0, 0.2, 0.4, 0.6, 0.8}) {
        const Vector3<Scalar> off = (line.place(share) - root) / limbs.size;
        out[next++] = static_cast<double>(off.dot(limbs.frame.forward));
        out[next++] = static_cast<double>(off.dot(limbs.frame.up));
        out[next++] = outward * static_cast<double>(off.dot(limbs.frame.left));
    }
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9})
        out[next++] = static_cast<double>(line.radius(share) / limbs.size);
    for (std::size_t w = 0; next < out.size(); ++w) out[next++] = limbs.evidence.values[w];
    const WayScale& scale = way_scales[static_cast<std::size_t>(way)];
    constexpr double most = 2.5; // deviations: beyond them nothing was seen that tells more
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = std::clamp((out[i] - scale.mean[i]) / scale.deviation[i], -most, most);
    return out;
}

/// Share of the way, and forward, up and outward of it, as that animal has them.
inline std::array<double, 4> place_in(const JointPlace& place, const PlaceFeatures& features) {
    std::array<double, 4> out = place.mean;
    for (std::size_t k = 0; k < out.size(); ++k)
        for (std::size_t i = 0; i < features.size(); ++i) out[k] += place.change[k][i] * features[i];
    out[0] = std::clamp(out[0], 0.0, 1.0);
    return out;
}

} // namespace detail

template <typename Scalar>
KinematicSkeleton<Scalar> place_joints(const CurveSkeleton<Scalar>& curve, const Limbs<Scalar>& limbs,
                                       const SkeletonTemplate& skeleton_template) {
    KinematicSkeleton<Scalar> out;
    out.template_name = skeleton_template.name;
    const BodyFrame<Scalar> head = detail::head_frame(curve, limbs);
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
        const BodyFrame<Scalar>& frame = wanted.role == JointRole::ear ? head : limbs.frame;
        const detail::WayLine<Scalar> line(curve, way);
        const int side = sign_of(wanted.side);
        const bool is_leg = place.way == Way::fore_leg || place.way == Way::hind_leg;
        const auto [share, forward, up, outward] =
            detail::place_in(place, detail::features_of(line, limbs, place.way, is_leg ? side : 0));
        joint.position = line.place(share) + limbs.size * (static_cast<Scalar>(forward) * frame.forward +
                                                           static_cast<Scalar>(up) * frame.up +
                                                           static_cast<Scalar>(side * outward) * frame.left);
        joint.radius = line.radius(share);
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
