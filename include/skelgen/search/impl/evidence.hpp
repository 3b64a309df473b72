#pragma once

#include <skelgen/search/evidence.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/anatomy/confidence.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/embedding/loop_cuts.hpp>
#include <skelgen/embedding/missing_limbs.hpp>
#include <skelgen/embedding/proportions.hpp>

namespace skelgen::search {
namespace detail {

using core::Accumulator;

/// Logarithm of a ratio, within what any body has: where a length is nothing, its logarithm says no more than that.
inline double log_ratio(double a, double b) {
    constexpr double most = 3;
    if (!(a > 0) || !(b > 0)) return a > b ? most : a < b ? -most : 0;
    return std::clamp(std::log(a / b), -most, most);
}

/// Where what belongs to no limb hangs.
enum class Hang { head, hands, back, legs };

/// Per node of the curve where it hangs that leads off a chain there.
template <typename Scalar>
std::vector<Hang> hang_of_nodes(const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding,
                                const SkeletonTemplate& wanted) {
    constexpr double outer = 0.6; // of a chain: what is farther out is the head's or the hand's
    std::vector<Hang> out(static_cast<std::size_t>(curve.nodes.rows()), Hang::back);
    for (const embedding::Chain& chain : embedding.chains) {
        const JointRole end = wanted.joint(chain.joints.back()).role, start = wanted.joint(chain.joints.front()).role;
        for (std::size_t i = 0; i < chain.nodes.size(); ++i) {
            const bool is_outer = static_cast<double>(i) > outer * static_cast<double>(chain.nodes.size() - 1);
            Hang& hang = out[static_cast<std::size_t>(chain.nodes[i])];
            if (part_of(end) == BodyPart::leg ||
                (end != JointRole::head && part_of(end) == BodyPart::trunk && (start == JointRole::pelvis) != is_outer))
                hang = Hang::legs;
            else if (is_outer)
                hang = end == JointRole::head ? Hang::head : part_of(end) == BodyPart::arm ? Hang::hands : Hang::back;
        }
    }
    return out;
}

/// Lengths of what belongs to no limb, by where it hangs, relative to the limbs' length.
template <typename Scalar>
std::array<double, 4> clutter(const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding,
                              const SkeletonTemplate& wanted) {
    std::array<double, 4> out{};
    const std::vector<bool> is_accounted = embedding::matched_or_hidden(curve, embedding);
    double matched = 0;
    core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    std::vector<std::pair<int, Scalar>> on_chains;
    for (const embedding::Chain& chain : embedding.chains) {
        matched += static_cast<double>(core::path_length(curve, chain.nodes));
        for (const int node : chain.nodes) on_chains.emplace_back(node, Scalar(0));
    }
    if (!(matched > 0)) return out;
    graph.neighbours.push_back(std::move(on_chains)); // a node at no distance from all of them
    const auto paths = core::shortest_paths(graph, graph.size() - 1);
    const std::vector<Hang> hang = hang_of_nodes(curve, embedding, wanted);
    for (const auto& [a, b] : curve.edges) {
        if (is_accounted[static_cast<std::size_t>(a)] && is_accounted[static_cast<std::size_t>(b)]) continue;
        if (!std::isfinite(paths.distance[static_cast<std::size_t>(a)])) continue;
        const std::vector<int> path = paths.path_to(a);
        const Hang where = path.size() > 1 ? hang[static_cast<std::size_t>(path[1])] : Hang::back;
        out[static_cast<std::size_t>(where)] += static_cast<double>(core::path_length(curve, {a, b})) / matched;
    }
    return out;
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

    /// From the neck to the end of the head.
    [[nodiscard]] double head() const {
        const auto from = find(JointRole::neck);
        for (const auto& [name, place] : skeleton_.end_points)
            if (name == "head_top" && from) return static_cast<double>((place - *from).norm());
        return 0;
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
void add_support(Evidence& out, const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                 const SkeletonTemplate& wanted) {
    constexpr int places = 6;            // on each bone
    constexpr double usual_girth = 0.22; // of a limb's bone, in the mean over the research bodies
    std::vector<double> girth(skeleton.joints.size(), 0);
    double inside = 0, all = 0, slack = 0, limbs = 0, pairs = 0, pair_count = 0;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const Joint<Scalar>& joint = skeleton.joints[j];
        if (joint.parent < 0 || !joint.is_present) continue;
        const Vector3<Scalar>& from = skeleton.joints[static_cast<std::size_t>(joint.parent)].position;
        for (int i = 0; i < places; ++i) {
            const Vector3<Scalar> place =
                from + (static_cast<Scalar>(i) + Scalar(0.5)) / Scalar(places) * (joint.position - from);
            const bool is_in = surface::is_inside(body, place);
            inside += is_in ? 1 : 0;
            all += 1;
            girth[j] += is_in ? static_cast<double>(body.tree.distance(body.mesh, place)) / places : 0;
        }
        const double length = static_cast<double>((joint.position - from).norm());
        const JointRole role = wanted.joints[j].role;
        if (role != JointRole::elbow && role != JointRole::wrist && role != JointRole::knee && role != JointRole::ankle)
            continue;
        slack += log_ratio(girth[j], usual_girth * length);
        limbs += 1;
        if (wanted.joints[j].side != Side::right) continue;
        const int other = counterpart(wanted, static_cast<int>(j));
        if (other < 0 || !skeleton.joints[static_cast<std::size_t>(other)].is_present) continue;
        pairs += std::abs(log_ratio(girth[j], girth[static_cast<std::size_t>(other)]));
        pair_count += 1;
    }
    out[Witness::support] = all > 0 ? inside / all : 0;
    out[Witness::unexplained] = unexplained_share(body, skeleton, girth);
    out[Witness::slack] = limbs > 0 ? slack / limbs : 0;
    out[Witness::pairs_girths] = pair_count > 0 ? pairs / pair_count : 0;
}

/// Share of some of the surface's vertices that have another part of the surface where the sagittal plane mirrors them.
template <typename Scalar>
double mirrored_share(const Body<Scalar>& body, const BodyFrame<Scalar>& frame) {
    constexpr Eigen::Index samples = 256;
    constexpr double tolerance = 0.015; // of the extent: METHOD's measure of characters at rest
    const Points<Scalar>& vertices = body.mesh.vertices;
    const Scalar extent = (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).maxCoeff();
    const Eigen::Index step = std::max<Eigen::Index>(1, vertices.rows() / samples);
    double near = 0, all = 0;
    for (Eigen::Index v = 0; v < vertices.rows(); v += step) {
        const Vector3<Scalar> place = core::point(vertices, v);
        const Vector3<Scalar> image = place - 2 * frame.left.dot(place - frame.origin) * frame.left;
        const Scalar reach = static_cast<Scalar>(tolerance) * extent;
        near += body.tree.distance(body.mesh, image) <= reach ? 1 : 0;
        all += 1;
    }
    return all > 0 ? near / all : 0;
}

template <typename Scalar>
void add_proportions(Evidence& out, const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                     const SkeletonTemplate& wanted) {
    using enum JointRole;
    const KinematicSkeleton<double> rest = at_rest(builtin_template("human21"));
    const RolePlaces<Scalar> own(skeleton, wanted);
    const RolePlaces<double> usual(rest, builtin_template("human21"));
    const double trunk = own.trunk(), usual_trunk = usual.trunk();
    const auto ratio = [&](double length, double usual_length) {
        return length > 0 && trunk > 0 ? log_ratio(length / trunk, usual_length / usual_trunk) : 0;
    };
    out[Witness::head_size] = ratio(own.head(), usual.head());
    const auto arm = {shoulder, elbow, wrist}, leg = {hip, knee, ankle};
    out[Witness::arm_length] = ratio(own.mean_length(arm), usual.mean_length(arm));
    out[Witness::leg_length] = ratio(own.mean_length(leg), usual.mean_length(leg));
    out[Witness::shoulder_width] = ratio(own.width(shoulder), usual.width(shoulder));
    out[Witness::hip_width] = ratio(own.width(hip), usual.width(hip));
    constexpr double usual_girth = 0.2; // of the trunk's length, from its middle to the skin
    const auto waist_at = own.find(waist);
    if (waist_at && trunk > 0)
        out[Witness::trunk_girth] =
            log_ratio(static_cast<double>(body.tree.distance(body.mesh, *waist_at)) / trunk, usual_girth);
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
        out[Witness::neck_height] = static_cast<double>(up.dot(*top - Scalar(0.5) * (*left + *right))) / places.trunk();
}

/// How the limbs are held.
template <typename Scalar>
void add_pose(Evidence& out, const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& wanted) {
    using enum JointRole;
    const RolePlaces<Scalar> places(skeleton, wanted);
    const auto root = places.find(pelvis), top = places.find(chest);
    if (!root || !top) return;
    const Vector3<Scalar> up = (*top - *root).stableNormalized();
    double go_on = 1, four_legged = 0, sides = 0;
    for (const Side side : {Side::left, Side::right}) {
        const auto direction = [&](JointRole from, JointRole to) -> std::optional<Vector3<Scalar>> {
            const auto a = places.find(from, side), b = places.find(to, side);
            if (!a || !b) return std::nullopt;
            return (*b - *a).stableNormalized();
        };
        auto leg = direction(hip, ankle);
        if (!leg) leg = direction(hip, foot);
        auto arm = direction(shoulder, wrist);
        if (!arm) arm = direction(shoulder, hand);
        if (leg) go_on = std::min(go_on, static_cast<double>(-up.dot(*leg)));
        if (!leg || !arm) continue;
        four_legged += std::max(0.0, static_cast<double>(leg->dot(*arm))) *
                       (1 - std::abs(static_cast<double>(up.dot(*leg)))) *
                       (1 - std::abs(static_cast<double>(up.dot(*arm))));
        sides += 1;
    }
    out[Witness::legs_go_on] = go_on;
    out[Witness::four_legged] = sides > 0 ? four_legged / sides : 0;
}

} // namespace detail

SKELGEN_INLINE std::string_view to_string(Witness witness) {
    constexpr std::array<std::string_view, witness_count> names{
        "distortion",    "unmatched",     "unmatched_reach", "clutter_head",
        "clutter_hands", "clutter_back",  "clutter_legs",    "contacts",
        "fitted",        "fit_cost",      "adapted",         "lacks_head",
        "lacks_limbs",   "cut_limbs",     "reach",           "envelope",
        "rounded",       "left_out",      "noisy",           "opened",
        "cut",           "held",          "doubt",           "misplaced",
        "outside",       "apart",         "unexplained",     "support",
        "slack",         "pairs_lengths", "pairs_girths",    "mirror",
        "head_size",     "arm_length",    "leg_length",      "shoulder_width",
        "hip_width",     "trunk_girth",   "below_hips",      "neck_height",
        "sides",         "legs_go_on",    "four_legged",     "posed"};
    return names[static_cast<std::size_t>(witness)];
}

template <typename Scalar>
Evidence evidence_of(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                     const embedding::Embedding* embedding, const anatomy::CompletedSkeleton<Scalar>& completed,
                     const SkeletonTemplate& wanted, Scalar diameter) {
    constexpr double well_fitted = 0.006; // per pair: registered bodies have no more
    constexpr double least_distortion = 1e-4;
    constexpr double usual_reach = 1.5; // an adult's, for unit area
    const KinematicSkeleton<Scalar>& skeleton = completed.skeleton;
    Evidence out;
    if (embedding) {
        out[Witness::distortion] =
            std::log(std::max(embedding::distortion_per_pair(*embedding), least_distortion) / well_fitted);
        out[Witness::unmatched] = static_cast<double>(embedding::unmatched_share(curve, *embedding));
        out[Witness::unmatched_reach] = static_cast<double>(embedding::unmatched_reach(curve, *embedding));
        const auto hanging = detail::clutter(curve, *embedding, wanted);
        out[Witness::clutter_head] = hanging[0];
        out[Witness::clutter_hands] = hanging[1];
        out[Witness::clutter_back] = hanging[2];
        out[Witness::clutter_legs] = hanging[3];
        out[Witness::contacts] = embedding::contact_count(curve);
    }
    out[Witness::adapted] = wanted.is_adapted ? 1 : 0;
    for (std::size_t j = 0; j < wanted.joints.size(); ++j) {
        const TemplateJoint& joint = wanted.joints[j];
        if (!ends_limb(joint.role) || skeleton.joints[j].is_present) continue;
        out[!joint.is_absent                ? Witness::cut_limbs
            : joint.role == JointRole::head ? Witness::lacks_head
                                            : Witness::lacks_limbs] += 1;
    }
    out[Witness::reach] = detail::log_ratio(static_cast<double>(diameter), usual_reach);

    double doubt = 0, misplaced = 0, present = 0, pairs = 0, pair_count = 0;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        if (!skeleton.joints[j].is_present) continue;
        present += 1;
        doubt += std::log1p(completed.doubt[j]);
        misplaced += completed.doubt[j] > anatomy::misplaced_from ? 1 : 0;
        const int other = counterpart(wanted, static_cast<int>(j));
        if (wanted.joints[j].side != Side::right || !skeleton.joints[static_cast<std::size_t>(other)].is_present)
            continue;
        pairs += std::abs(detail::log_ratio(static_cast<double>(completed.measured[j]),
                                            static_cast<double>(completed.measured[static_cast<std::size_t>(other)])));
        pair_count += 1;
    }
    out[Witness::doubt] = present > 0 ? doubt / present : 0;
    out[Witness::misplaced] = present > 0 ? misplaced / present : 0;
    out[Witness::outside] = present > 0 ? static_cast<double>(completed.moved.size()) / present : 0;
    out[Witness::pairs_lengths] = pair_count > 0 ? pairs / pair_count : 0;
    out[Witness::apart] = detail::depth_in_others(skeleton, wanted);
    detail::add_support(out, body, skeleton, wanted);
    out[Witness::mirror] = detail::mirrored_share(body, skeleton.frame);
    detail::add_proportions(out, body, skeleton, wanted);
    out[Witness::sides] = skeleton.quality.sides_confidence;
    detail::add_girdles(out, body, skeleton, wanted);
    detail::add_pose(out, skeleton, wanted);
    return out;
}

} // namespace skelgen::search
