#pragma once

#include <skelgen/embedding/missing_limbs.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/embedding/reduced_graph.hpp>

namespace skelgen::embedding {
namespace detail {

/// Up to this distortion per pair there is nothing to explain: half of all registered bodies have less.
inline constexpr double well_fitted = 0.0025;

/// Of a limb's distances to the others on the curve and in the template, relative to the largest: at least so much
/// shorter is a stump. 12 cm in an adult, half of what a head, the shortest of limbs, takes away.
template <typename Scalar>
inline constexpr Scalar much_shorter = Scalar(0.05);

/// The least distortion per pair without one or both hands, or feet; `end`: that of one of them.
template <typename Scalar>
double distortion_without_ends(const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& skeleton_template, int end,
                               const MatchingOptions& options) {
    const SkeletonTemplate without_one = without_limb(skeleton_template, end);
    double least = std::numeric_limits<double>::infinity();
    for (const SkeletonTemplate& part : {without_one, without_limb(without_one, counterpart(skeleton_template, end))})
        if (const auto found = embed(curve, part, options)) least = std::min(least, distortion_per_pair(*found));
    return least;
}

/// How much shorter than in the template the way from a joint's node to the other nodes is, on average, with the
/// largest distance 1.
template <typename Scalar>
Scalar shortness(const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& skeleton_template, const Embedding& whole,
                 int joint) {
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    const Scalar largest = core::curve_diameter(graph);
    const std::vector<Scalar> distance = core::shortest_paths(graph, whole.node_of_joint[at(joint)]).distance;
    const ReducedGraph<Scalar> rest = reduce<Scalar>(skeleton_template);
    const auto row = std::find(rest.origin.begin(), rest.origin.end(), joint) - rest.origin.begin();
    Scalar sum = 0;
    for (std::size_t i = 0; i < rest.origin.size(); ++i)
        sum += rest.distances(row, static_cast<Eigen::Index>(i)) -
               distance[at(whole.node_of_joint[at(rest.origin[i])])] / largest;
    return sum / static_cast<Scalar>(rest.origin.size() - 1);
}

/// Does the end of the curve that stands for a joint swell beyond something thinner, as a head does beyond its neck?
/// Stumps only taper.
template <typename Scalar>
bool ends_in_swelling(const CurveSkeleton<Scalar>& curve, const Embedding& embedding, int joint) {
    constexpr Scalar clearly = Scalar(1.15); // thicker: as refinement::measure_head has it of throats
    constexpr Scalar least = Scalar(1) / 3;  // of the thickest: balls near the very end say nothing; a working value
    const auto chain = std::find_if(embedding.chains.begin(), embedding.chains.end(),
                                    [&](const Chain& each) { return each.joints.back() == joint; });
    if (chain == embedding.chains.end()) return false;
    std::vector<Scalar> radii;
    for (const int node : chain->nodes) radii.push_back(curve.radii[at(node)]);
    const Scalar thickest = *std::max_element(radii.begin(), radii.end());
    Scalar before = 0, thinnest = thickest; // up to here, outwards
    for (const Scalar radius : radii) {
        before = std::max(before, radius);
        if (clearly * radius < before) thinnest = std::min(thinnest, radius);
        if (radius > clearly * thinnest && radius > least * thickest) return true;
    }
    return false;
}

} // namespace detail

SKELGEN_INLINE std::vector<PartialTemplate> partial_templates(const SkeletonTemplate& skeleton_template) {
    using enum JointRole;
    struct Part {
        JointRole first, end;
        Side side;
    };
    std::vector<PartialTemplate> out;
    for (const Part& part : {Part{head, head, Side::none}, Part{elbow, hand, Side::left}, Part{knee, foot, Side::left},
                             Part{wrist, hand, Side::left}, Part{ankle, foot, Side::left}}) {
        const int first = find_joint(skeleton_template, part.first, part.side);
        if (first < 0) continue;
        out.push_back({without_limb(skeleton_template, first), find_joint(skeleton_template, part.end, part.side)});
    }
    return out;
}

SKELGEN_INLINE double distortion_per_pair(const Embedding& embedding) {
    const double nodes = embedding.matched_nodes;
    return 2 * embedding.distortion / (nodes * (nodes - 1));
}

template <typename Scalar>
std::optional<PartialTemplate> find_missing_limb(const CurveSkeleton<Scalar>& curve,
                                                 const SkeletonTemplate& skeleton_template, const Embedding& whole,
                                                 const MatchingOptions& options) {
    const bool is_partial = std::any_of(skeleton_template.joints.begin(), skeleton_template.joints.end(),
                                        [](const TemplateJoint& joint) { return joint.is_absent; });
    if (is_partial || distortion_per_pair(whole) <= detail::well_fitted) return std::nullopt;
    double least = distortion_per_pair(whole) / 2;
    std::optional<PartialTemplate> best;
    for (PartialTemplate& part : partial_templates(skeleton_template)) {
        // Either one of a pair may be the stump, but not both: legs under a coat are short alike.
        const int other = counterpart(skeleton_template, part.end);
        if (other < 0 && detail::ends_in_swelling(curve, whole, part.end)) continue;
        const Scalar own = detail::shortness(curve, skeleton_template, whole, part.end);
        const Scalar shorter =
            other < 0 ? own : std::abs(own - detail::shortness(curve, skeleton_template, whole, other));
        if (shorter < detail::much_shorter<Scalar>) continue;
        const auto found = embed(curve, part.skeleton_template, options);
        if (!found || !(distortion_per_pair(*found) < least)) continue;
        // Hands and feet are told by the surface; here they are tried so as not to be taken for more.
        if (other >= 0 && !(2 * distortion_per_pair(*found) <
                            detail::distortion_without_ends(curve, skeleton_template, part.end, options)))
            continue;
        least = distortion_per_pair(*found);
        best = std::move(part);
    }
    return best;
}

} // namespace skelgen::embedding
