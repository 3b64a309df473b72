#pragma once

#include <skelgen/search/evidence.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>

namespace skelgen::search {
namespace detail {

/// Logarithm of a ratio, within what any body has: where a length is nothing, its logarithm says no more than that.
inline double log_ratio(double a, double b) {
    constexpr double most = 3;
    if (!(a > 0) || !(b > 0)) return a > b ? most : a < b ? -most : 0;
    return std::clamp(std::log(a / b), -most, most);
}

/// The joints of a skeleton by role and side.
template <typename Scalar>
class RolePlaces {
public:
    RolePlaces(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& wanted)
        : skeleton_(skeleton), wanted_(wanted) {}

    /// Where a joint is that is present.
    [[nodiscard]] std::optional<Vector3<Scalar>> find(JointRole role, Side side = Side::none) const {
        const int j = find_joint(wanted_, role, side);
        if (j < 0 || !skeleton_.joints[static_cast<std::size_t>(j)].is_present) return std::nullopt;
        return skeleton_.joints[static_cast<std::size_t>(j)].position;
    }

    /// The length of the line through those of these joints that are there; 0 for fewer than two.
    [[nodiscard]] double length(std::initializer_list<JointRole> roles, Side side) const {
        double length = 0;
        std::optional<Vector3<Scalar>> last;
        for (const JointRole role : roles) {
            const auto place = find(role, side);
            if (!place) continue;
            if (last) length += static_cast<double>((*place - *last).norm());
            last = place;
        }
        return length;
    }

    /// The mean of both sides, or the one that is there.
    [[nodiscard]] double mean_length(std::initializer_list<JointRole> roles) const {
        const double left = length(roles, Side::left), right = length(roles, Side::right);
        return left > 0 && right > 0 ? (left + right) / 2 : std::max(left, right);
    }

    [[nodiscard]] double width(JointRole role) const {
        const auto left = find(role, Side::left), right = find(role, Side::right);
        return left && right ? static_cast<double>((*left - *right).norm()) : 0;
    }

    /// From the root to the neck, or to the chest of a template without one.
    [[nodiscard]] double trunk() const {
        using enum JointRole;
        auto top = find(neck);
        if (!top) top = find(chest);
        const auto root = find(pelvis);
        return top && root ? static_cast<double>((*top - *root).norm()) : 0;
    }

private:
    const KinematicSkeleton<Scalar>& skeleton_;
    const SkeletonTemplate& wanted_;
};

/// The template's rest pose as a skeleton.
inline KinematicSkeleton<double> at_rest(const SkeletonTemplate& wanted) {
    KinematicSkeleton<double> out;
    for (const TemplateJoint& joint : wanted.joints) {
        out.joints.push_back({joint.name, joint.parent, joint.position, joint.radius});
        if (joint.role == JointRole::head && joint.tip) out.end_points.emplace_back("head_top", *joint.tip);
    }
    return out;
}

/// How deep, in its own radius, the worst joint of a limb lies in another limb or in the trunk: a limb that was lost on
/// the way to the curve does, those that lie on each other stay apart. From 0, not at all, to 1, on its bone.
template <typename Scalar>
double depth_in_others(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& wanted) {
    enum class Part { none, trunk, arm, leg };
    const auto part_of_joint = [](JointRole role) {
        using enum JointRole;
        if (role == waist || role == chest || role == neck) return Part::trunk;
        if (role == elbow || role == wrist || role == hand) return Part::arm;
        if (role == knee || role == ankle || role == foot) return Part::leg;
        return Part::none; // a girdle's, the root's and the head's lie in several
    };
    double deepest = 0;
    for (std::size_t j = 0; j < wanted.joints.size(); ++j) {
        const Part limb = part_of_joint(wanted.joints[j].role);
        const Joint<Scalar>& joint = skeleton.joints[j];
        if ((limb != Part::arm && limb != Part::leg) || !joint.is_present || !(joint.radius > 0)) continue;
        for (std::size_t k = 0; k < wanted.joints.size(); ++k) {
            const TemplateJoint& other = wanted.joints[k];
            const Part part = part_of_joint(other.role);
            if (part == Part::none || other.parent < 0 || !skeleton.joints[k].is_present) continue;
            if (part == limb && other.side == wanted.joints[j].side) continue;
            const Vector3<Scalar>& from = skeleton.joints[static_cast<std::size_t>(other.parent)].position;
            const auto nearest = core::nearest_on_segment<Scalar, 3>(joint.position, from, skeleton.joints[k].position);
            deepest = std::max(deepest, 1 - static_cast<double>(nearest.distance / joint.radius));
        }
    }
    return deepest;
}

/// How near the worst wrist or ankle is to its own upper bone: 1 on it, 0 half its length away. Where the surface lacks
/// a forearm or a shin, what is laid into it turns back.
template <typename Scalar>
double folded_limbs(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& wanted) {
    using enum JointRole;
    constexpr double far = 0.5; // of the upper bone's length
    const RolePlaces<Scalar> places(skeleton, wanted);
    double nearest = far;
    for (const Side side : {Side::left, Side::right})
        for (const auto& [root, middle, outer] : {std::array{shoulder, elbow, wrist}, std::array{hip, knee, ankle}}) {
            const auto from = places.find(root, side), to = places.find(middle, side), end = places.find(outer, side);
            if (!from || !to || !end) continue;
            const double length = static_cast<double>((*to - *from).norm());
            const auto distance = core::nearest_on_segment<Scalar, 3>(*end, *from, *to).distance;
            if (length > 0) nearest = std::min(nearest, static_cast<double>(distance) / length);
        }
    return 1 - nearest / far;
}

/// Share of the surface that lies farther from each bone, and from the way to each end of a limb, than twice as far as
/// the surface is around that bone.
template <typename Scalar>
double unexplained_share(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                         const std::vector<double>& girth) {
    constexpr Eigen::Index samples = 256;
    constexpr double far = 2.2; // times a bone's girth: trunks are so much wider than deep
    const Eigen::Index step = std::max<Eigen::Index>(1, body.mesh.vertices.rows() / samples);
    double unexplained = 0, all = 0;
    for (Eigen::Index v = 0; v < body.mesh.vertices.rows(); v += step) {
        const Vector3<Scalar> place = core::point(body.mesh.vertices, v);
        bool is_explained = false;
        for (std::size_t j = 0; j < skeleton.joints.size() && !is_explained; ++j) {
            const Joint<Scalar>& joint = skeleton.joints[j];
            if (!joint.is_present || joint.parent < 0) continue;
            const Vector3<Scalar>& from = skeleton.joints[static_cast<std::size_t>(joint.parent)].position;
            const auto nearest = core::nearest_on_segment<Scalar, 3>(place, from, joint.position);
            is_explained = static_cast<double>(nearest.distance) <= far * girth[j];
        }
        for (std::size_t e = 0; e < skeleton.end_points.size() && !is_explained; ++e) {
            // From the nearest joint to the limb's end: head, hand or foot.
            const Vector3<Scalar>& end = skeleton.end_points[e].second;
            const auto joint = std::min_element(
                skeleton.joints.begin(), skeleton.joints.end(), [&](const Joint<Scalar>& a, const Joint<Scalar>& b) {
                    return (a.position - end).squaredNorm() < (b.position - end).squaredNorm();
                });
            const auto nearest = core::nearest_on_segment<Scalar, 3>(place, joint->position, end);
            is_explained = static_cast<double>(nearest.distance) <= far * static_cast<double>(joint->radius);
        }
        unexplained += is_explained ? 0 : 1;
        all += 1;
    }
    return all > 0 ? unexplained / all : 0;
}

/// What the surface around the bones shows.
template <typename Scalar>
void add_girths(Evidence& out, const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                const SkeletonTemplate& wanted) {
    constexpr int places = 6; // on each bone
    std::vector<double> girth(skeleton.joints.size(), 0);
    double pairs = 0, pair_count = 0;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const Joint<Scalar>& joint = skeleton.joints[j];
        if (joint.parent < 0 || !joint.is_present) continue;
        const Vector3<Scalar>& from = skeleton.joints[static_cast<std::size_t>(joint.parent)].position;
        for (int i = 0; i < places; ++i) {
            const Vector3<Scalar> place =
                from + (static_cast<Scalar>(i) + Scalar(0.5)) / Scalar(places) * (joint.position - from);
            if (surface::is_inside(body, place))
                girth[j] += static_cast<double>(body.tree.distance(body.mesh, place)) / places;
        }
        const JointRole role = wanted.joints[j].role;
        if (role != JointRole::elbow && role != JointRole::wrist && role != JointRole::knee && role != JointRole::ankle)
            continue;
        if (wanted.joints[j].side != Side::right) continue;
        const int other = counterpart(wanted, static_cast<int>(j));
        if (other < 0 || !skeleton.joints[static_cast<std::size_t>(other)].is_present) continue;
        pairs += std::abs(log_ratio(girth[j], girth[static_cast<std::size_t>(other)]));
        pair_count += 1;
    }
    out[Witness::unexplained] = unexplained_share(body, skeleton, girth);
    out[Witness::pairs_girths] = pair_count > 0 ? pairs / pair_count : 0;
}

template <typename Scalar>
void add_proportions(Evidence& out, const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& wanted) {
    using enum JointRole;
    const KinematicSkeleton<double> rest = at_rest(builtin_template("human21"));
    const RolePlaces<Scalar> own(skeleton, wanted);
    const RolePlaces<double> usual(rest, builtin_template("human21"));
    const double trunk = own.trunk(), usual_trunk = usual.trunk();
    const auto ratio = [&](double length, double usual_length) {
        return length > 0 && trunk > 0 ? log_ratio(length / trunk, usual_length / usual_trunk) : 0;
    };
    const auto arm = {shoulder, elbow, wrist}, leg = {hip, knee, ankle};
    out[Witness::arm_length] = ratio(own.mean_length(arm), usual.mean_length(arm));
    out[Witness::leg_length] = ratio(own.mean_length(leg), usual.mean_length(leg));
    out[Witness::hip_width] = ratio(own.width(hip), usual.width(hip));
}

/// Where hips and shoulders are beside the fork of the legs and the neck.
template <typename Scalar>
void add_girdles(Evidence& out, const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                 const SkeletonTemplate& wanted) {
    using enum JointRole;
    constexpr double usual_fork = 0.12; // below the hip joints, of the leg's length
    const RolePlaces<Scalar> places(skeleton, wanted);
    const auto root = places.find(pelvis);
    auto top = places.find(neck);
    if (!top) top = places.find(chest);
    const auto left_hip = places.find(hip, Side::left), right_hip = places.find(hip, Side::right);
    const auto left = places.find(shoulder, Side::left), right = places.find(shoulder, Side::right);
    if (!root || !top) return;
    const Vector3<Scalar> up = (*top - *root).stableNormalized();
    if (left_hip && right_hip) {
        const double leg = places.mean_length({hip, knee, ankle});
        const auto hit = body.tree.first_along(body.mesh, Scalar(0.5) * (*left_hip + *right_hip), Vector3<Scalar>(-up));
        out[Witness::below_hips] =
            hit.face < 0 ? log_ratio(1, usual_fork) : log_ratio(static_cast<double>(hit.distance), usual_fork * leg);
    }
    if (left && right && places.trunk() > 0)
        out[Witness::neck_height] =
            std::clamp(static_cast<double>(up.dot(*top - Scalar(0.5) * (*left + *right))) / places.trunk(), -3.0, 3.0);
}

/// How the limbs are held.
template <typename Scalar>
void add_pose(Evidence& out, const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& wanted) {
    using enum JointRole;
    const RolePlaces<Scalar> places(skeleton, wanted);
    const auto root = places.find(pelvis), top = places.find(chest);
    if (!root || !top) return;
    const Vector3<Scalar> up = (*top - *root).stableNormalized();
    double go_on = 1;
    for (const Side side : {Side::left, Side::right}) {
        const auto from = places.find(hip, side);
        auto to = places.find(ankle, side);
        if (!to) to = places.find(foot, side);
        if (from && to) go_on = std::min(go_on, static_cast<double>(-up.dot((*to - *from).stableNormalized())));
    }
    out[Witness::legs_go_on] = go_on;
}

} // namespace detail

SKELGEN_INLINE std::string_view to_string(Witness witness) {
    constexpr std::array<std::string_view, witness_count> names{
        "unmatched_reach", "fitted",      "posed",      "fit_cost",  "envelope",   "lacks_head",  "lacks_limbs",
        "cut_limbs",       "reach",       "doubt",      "outside",   "apart",      "folded",      "unexplained",
        "pairs_girths",    "arm_length",  "leg_length", "hip_width", "below_hips", "neck_height", "sides",
        "legs_go_on",      "others_lack", "agreed",     "heard"};
    return names[static_cast<std::size_t>(witness)];
}

template <typename Scalar>
Evidence evidence_of(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                     const embedding::Embedding* embedding, const anatomy::CompletedSkeleton<Scalar>& completed,
                     const SkeletonTemplate& wanted, Scalar diameter) {
    constexpr double usual_reach = 1.5; // an adult's, for unit area
    const KinematicSkeleton<Scalar>& skeleton = completed.skeleton;
    Evidence out;
    if (embedding) out[Witness::unmatched_reach] = static_cast<double>(embedding::unmatched_reach(curve, *embedding));
    for (std::size_t j = 0; j < wanted.joints.size(); ++j) {
        const TemplateJoint& joint = wanted.joints[j];
        if (!ends_limb(joint.role) || skeleton.joints[j].is_present) continue;
        out[!joint.is_absent                ? Witness::cut_limbs
            : joint.role == JointRole::head ? Witness::lacks_head
                                            : Witness::lacks_limbs] += 1;
    }
    out[Witness::reach] = detail::log_ratio(static_cast<double>(diameter), usual_reach);

    double doubt = 0, present = 0;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        if (!skeleton.joints[j].is_present) continue;
        present += 1;
        doubt += std::log1p(completed.doubt[j]);
    }
    out[Witness::doubt] = present > 0 ? doubt / present : 0;
    out[Witness::outside] = present > 0 ? static_cast<double>(completed.moved.size()) / present : 0;
    out[Witness::apart] = detail::depth_in_others(skeleton, wanted);
    out[Witness::folded] = detail::folded_limbs(skeleton, wanted);
    detail::add_girths(out, body, skeleton, wanted);
    detail::add_proportions(out, skeleton, wanted);
    out[Witness::sides] = skeleton.quality.sides_confidence;
    detail::add_girdles(out, body, skeleton, wanted);
    detail::add_pose(out, skeleton, wanted);
    return out;
}

} // namespace skelgen::search
