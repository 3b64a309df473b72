#pragma once

#include <skelgen/embedding/proportions.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <utility>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/embedding/impl/missing_limbs.hpp>
#include <skelgen/embedding/reduced_graph.hpp>

namespace skelgen::embedding {
namespace detail {

/// A child of two; figures of three and of two heads, as toys and games have them; one with a large head alone; the
/// brute of drawn stories. Multiples of an adult's lengths beside the trunk, working values; legs of figures fill the
/// trunk's width.
inline constexpr std::array<Proportions, 5> other_proportions{
    {{1.35, 0.8, 0.75, 1}, {2.0, 0.6, 0.5, 1.6}, {2.2, 0.4, 0.4, 1.6}, {1.8, 0.75, 0.7, 1.6}, {1.5, 1.0, 0.5, 1.6}}};

/// Up to this distortion per pair there is nothing to explain: registered bodies have 0.005 at most.
inline constexpr double well_fitted_body = 0.006;

/// So little distorted other proportions are to be: drawn figures' are, with the right ones, to 0.003, wolves, horses
/// and toy animals 0.004 to 0.008.
inline constexpr double well_fitted_figure = 0.004;

/// And so little of the curve is to be left over, as a part of the chains: a dog's tail and ears are 0.4, figures have
/// less than 0.1.
inline constexpr double left_over = 0.15;

/// What a figure whose legs go on from its trunk wears and carries distorts the template so much more: a staff, a
/// cloak.
inline constexpr double fitted_figure = 0.01;

/// Multiples of an adult's lengths beside the trunk, a little beyond those above: where the trunk ends on a curve
/// varies.
inline constexpr Proportions least_proportions{0.6, 0.3, 0.25, 1}, most_proportions{2.5, 1.2, 1.1, 1};

/// Along the bones from a joint of the trunk to a limb's end.
inline double limb_length(const SkeletonTemplate& skeleton_template, int from, int end) {
    const TemplateJoint& last = skeleton_template.joint(end);
    double length = last.tip ? (*last.tip - last.position).norm() : 0;
    for (int j = end; j != from && j > 0; j = skeleton_template.joint(j).parent)
        length += rest_length(skeleton_template, j, skeleton_template.joint(j).parent);
    return length;
}

/// What a proportion has to be for a limb to be so long, where twice that of `once` makes it `twice`.
inline double proportion(double wanted, double once, double twice, double least, double most) {
    const double growing = twice - once;
    return growing > 0 ? std::clamp((wanted - (once - growing)) / growing, least, most) : 1;
}

/// The unit vector from one joint's node to another's.
template <typename Scalar>
Vector3<Scalar> direction(const CurveSkeleton<Scalar>& curve, const Embedding& embedding, int from, int to) {
    return (core::point(curve.nodes, embedding.node_of_joint[at(to)]) -
            core::point(curve.nodes, embedding.node_of_joint[at(from)]))
        .stableNormalized();
}

} // namespace detail

template <typename Scalar>
Proportions proportions_of(const CurveSkeleton<Scalar>& curve, const Embedding& embedding,
                           const SkeletonTemplate& skeleton_template) {
    using enum JointRole;
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    const int upper = find_joint(skeleton_template, chest), top = find_joint(skeleton_template, head);
    const auto node = [&](int joint) { return embedding.node_of_joint[detail::at(joint)]; };
    const auto from_upper = core::shortest_paths(graph, node(upper)).distance;
    const auto from_root = core::shortest_paths(graph, node(0)).distance;
    const double trunk = detail::limb_length(skeleton_template, 0, upper);
    const double unit = static_cast<double>(from_upper[detail::at(node(0))]) / trunk;
    if (!(unit > 0)) return {};
    const SkeletonTemplate larger = with_proportions(skeleton_template, {2, 2, 2, 1});
    const auto fitted = [&](int from, std::initializer_list<int> ends, double least, double most) {
        const auto& distance = from == 0 ? from_root : from_upper;
        double sum = 0;
        for (const int end : ends) sum += static_cast<double>(distance[detail::at(node(end))]);
        const int end = *ends.begin();
        return detail::proportion(sum / (static_cast<double>(ends.size()) * unit),
                                  detail::limb_length(skeleton_template, from, end),
                                  detail::limb_length(larger, from, end), least, most);
    };
    const auto &least = detail::least_proportions, &most = detail::most_proportions;
    const auto end = [&](JointRole role, Side side) { return find_joint(skeleton_template, role, side); };
    return {fitted(upper, {top}, least.head, most.head),
            fitted(upper, {end(hand, Side::left), end(hand, Side::right)}, least.arms, most.arms),
            fitted(0, {end(foot, Side::left), end(foot, Side::right)}, least.legs, most.legs), 1};
}

template <typename Scalar>
bool legs_go_on(const CurveSkeleton<Scalar>& curve, const Embedding& embedding,
                const SkeletonTemplate& skeleton_template) {
    // Cosines: drawn figures, standing, have 0.67 at least, wolves, horses and boars 0.5 at most on one leg.
    constexpr auto least = static_cast<Scalar>(0.6);
    using enum JointRole;
    const int upper = find_joint(skeleton_template, chest), left_end = find_joint(skeleton_template, foot, Side::left),
              right_end = find_joint(skeleton_template, foot, Side::right);
    for (const int joint : {upper, 0, left_end, right_end})
        if (embedding.node_of_joint[detail::at(joint)] < 0) return false;
    const auto direction = [&](int from, int to) { return detail::direction(curve, embedding, from, to); };
    const Vector3<Scalar> down = direction(upper, 0), left = direction(0, left_end), right = direction(0, right_end);
    return down.dot(left) >= least && down.dot(right) >= least && left.dot(right) >= least;
}

SKELGEN_INLINE SkeletonTemplate with_proportions(const SkeletonTemplate& skeleton_template,
                                                 const Proportions& proportions) {
    using enum JointRole;
    SkeletonTemplate out = skeleton_template;
    out.is_adapted = true;
    for (std::size_t j = 0; j < out.joints.size(); ++j) {
        TemplateJoint& joint = out.joints[j];
        const TemplateJoint& before = skeleton_template.joints[j];
        const BodyPart part = part_of(joint.role);
        const double size = part == BodyPart::arm   ? proportions.arms
                            : part == BodyPart::leg ? proportions.legs
                            : joint.role == head    ? proportions.head
                                                    : 1;
        const bool is_trunks = joint.role == shoulder || joint.role == hip || joint.role == head;
        if (joint.parent >= 0)
            joint.position =
                out.joint(joint.parent).position +
                (is_trunks ? 1 : size) * (before.position - skeleton_template.joint(joint.parent).position);
        if (joint.role == hip) joint.position.x() += (proportions.hips - 1) * before.position.x();
        joint.radius = size * before.radius;
        if (before.tip) joint.tip = joint.position + size * (*before.tip - before.position);
    }
    return out;
}

namespace detail {

template <typename Scalar>
bool is_more_than_left_over(const CurveSkeleton<Scalar>& curve, const Embedding& found) {
    return static_cast<double>(unmatched_share(curve, found)) > left_over;
}

/// Proportions, the embedding that these make likely, its proportions in turn, and so on while it is distorted less.
template <typename Scalar>
std::optional<FittingTemplate>
with_curves_proportions(const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& skeleton_template,
                        Proportions proportions, bool legs_have_to_go_on, const MatchingOptions& options) {
    constexpr int most_rounds = 4;
    std::optional<FittingTemplate> best;
    for (int round = 0; round < most_rounds; ++round) {
        SkeletonTemplate other = with_proportions(skeleton_template, proportions);
        auto found = embed(curve, other, options);
        if (!found || (legs_have_to_go_on && !legs_go_on(curve, *found, other))) break;
        if (best && !(found->distortion < best->embedding.distortion)) break;
        const double hips = proportions.hips;
        proportions = proportions_of(curve, *found, skeleton_template);
        proportions.hips = hips;
        best = FittingTemplate{std::move(other), *std::move(found), true};
    }
    return best;
}

/// The curve's nodes that stand for head, hands, feet and junctions, each pair in order: left and right are not known.
inline std::vector<int> nodes_by_role(const SkeletonTemplate& skeleton_template, const Embedding& embedding) {
    std::vector<int> out;
    for (std::size_t j = 0; j < skeleton_template.joints.size(); ++j) {
        const int other = counterpart(skeleton_template, static_cast<int>(j));
        const int node = embedding.node_of_joint[j];
        if (other < 0) {
            out.push_back(node);
        } else if (static_cast<int>(j) < other) {
            out.push_back(std::min(node, embedding.node_of_joint[at(other)]));
            out.push_back(std::max(node, embedding.node_of_joint[at(other)]));
        }
    }
    return out;
}

} // namespace detail

template <typename Scalar>
Outcome<FittingTemplate> fitting_proportions(const CurveSkeleton<Scalar>& curve,
                                             const SkeletonTemplate& skeleton_template,
                                             const MatchingOptions& options) {
    auto whole = embed(curve, skeleton_template, options);
    if (!whole) return whole.failure();
    FittingTemplate out{skeleton_template, *std::move(whole), false};
    const bool is_partial = std::any_of(skeleton_template.joints.begin(), skeleton_template.joints.end(),
                                        [](const TemplateJoint& joint) { return joint.is_absent; });
    const double distortion = distortion_per_pair(out.embedding);
    if (is_partial || distortion <= detail::well_fitted_body) return out;
    double least = std::min(distortion / 2, detail::well_fitted_figure);
    for (const Proportions& proportions : detail::other_proportions) {
        SkeletonTemplate other = with_proportions(skeleton_template, proportions);
        auto found = embed(curve, other, options);
        if (!found || !(distortion_per_pair(*found) < least)) continue;
        if (detail::is_more_than_left_over(curve, *found)) continue;
        least = distortion_per_pair(*found);
        out = {std::move(other), *std::move(found), true};
    }
    if (!out.is_odd && distortion > detail::fitted_figure) {
        least = detail::fitted_figure;
        for (const Proportions& start : detail::other_proportions) {
            auto fitted = detail::with_curves_proportions(curve, skeleton_template, start, true, options);
            if (!fitted || !(distortion_per_pair(fitted->embedding) < least)) continue;
            least = distortion_per_pair(fitted->embedding);
            out = *std::move(fitted);
        }
    }
    return out;
}

template <typename Scalar>
std::vector<FittingTemplate> other_fitting_templates(const CurveSkeleton<Scalar>& curve,
                                                     const SkeletonTemplate& skeleton_template, std::size_t most,
                                                     const MatchingOptions& options) {
    std::vector<FittingTemplate> found;
    const auto add = [&](FittingTemplate other) {
        const std::vector<int> nodes = detail::nodes_by_role(other.skeleton_template, other.embedding);
        for (FittingTemplate& known : found) {
            if (detail::nodes_by_role(known.skeleton_template, known.embedding) != nodes) continue;
            if (other.embedding.distortion < known.embedding.distortion) known = std::move(other);
            return;
        }
        found.push_back(std::move(other));
    };
    const bool is_partial = std::any_of(skeleton_template.joints.begin(), skeleton_template.joints.end(),
                                        [](const TemplateJoint& joint) { return joint.is_absent; });
    if (is_partial) return {};
    if (auto whole = embed(curve, skeleton_template, options)) {
        add({skeleton_template, *std::move(whole), false});
        for (const Proportions& start : detail::other_proportions)
            if (auto other = detail::with_curves_proportions(curve, skeleton_template, start, false, options))
                add(*std::move(other));
    }
    for (PartialTemplate& part : partial_templates(skeleton_template))
        if (auto other = embed(curve, part.skeleton_template, options))
            add({std::move(part.skeleton_template), *std::move(other), false});
    std::stable_sort(found.begin(), found.end(), [](const FittingTemplate& a, const FittingTemplate& b) {
        return distortion_per_pair(a.embedding) < distortion_per_pair(b.embedding);
    });
    if (found.size() > most) found.erase(found.begin() + static_cast<std::ptrdiff_t>(most), found.end());
    return found;
}

} // namespace skelgen::embedding
