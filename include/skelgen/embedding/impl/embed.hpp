#pragma once

#include <skelgen/embedding/embed.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/embedding/reduced_graph.hpp>

namespace skelgen::embedding {
namespace detail {

/// Chains of the template: from each joint of the reduced graph, given by `ends`, up to the next one above it. Where
/// the root is none of them, a leg being absent, one chain leads past it, downwards.
inline std::vector<std::vector<int>> template_chains(const SkeletonTemplate& skeleton_template,
                                                     const std::vector<int>& ends) {
    std::vector<bool> is_end(skeleton_template.joints.size(), false);
    for (const int j : ends) is_end[at(j)] = true;
    std::vector<std::vector<int>> chains;
    std::vector<int> to_root; // from the trunk's upper joint
    for (const int end : ends) {
        std::vector<int> chain{end};
        for (int j = skeleton_template.joint(end).parent; j >= 0; j = skeleton_template.joint(j).parent) {
            chain.push_back(j);
            if (is_end[at(j)]) break;
        }
        if (chain.size() < 2) continue;
        if (part_of(skeleton_template.joint(end).role) == BodyPart::trunk && !is_end[at(chain.back())]) {
            to_root = std::move(chain);
            continue;
        }
        std::reverse(chain.begin(), chain.end());
        chains.push_back(std::move(chain));
    }
    for (std::vector<int>& chain : chains)
        if (!is_end[at(chain.front())]) chain.insert(chain.begin(), to_root.begin(), to_root.end() - 1);
    return chains;
}

/// Where each unmatched junction of the curve goes at which two ways part: the matched neighbour in the reduced graph
/// with the most branches. Where one way passes what branches off is no limb, as horns are none: that stays on its way.
template <typename Scalar>
std::vector<int> merge_targets(const core::CurveGraph<Scalar>& graph, const std::vector<bool>& matched,
                               const std::vector<std::vector<int>>& ways) {
    std::vector<int> passing(matched.size(), 0), target(matched.size());
    for (const std::vector<int>& way : ways)
        for (const int v : way) ++passing[at(v)];
    for (int v = 0; v < graph.size(); ++v) {
        target[at(v)] = v;
        if (graph.degree(v) < 3 || matched[at(v)] || passing[at(v)] < 2) continue;
        int best = -1;
        for (const auto& [first, length] : graph.neighbours[at(v)]) {
            const int w = core::branch(graph, v, first).back();
            const bool better = best < 0 || graph.degree(w) > graph.degree(best);
            if (matched[at(w)] && graph.degree(w) >= 3 && better) best = w;
        }
        if (best >= 0) target[at(v)] = best;
    }
    return target;
}

/// The nodes of a path with merged junctions drawn together: everything before the last node merged into its start, and
/// after the first merged into its end, is the start or end itself.
inline std::vector<int> without_merged(const std::vector<int>& path, const std::vector<int>& target) {
    std::size_t first = 0, last = path.size() - 1;
    for (std::size_t i = 1; i + 1 < path.size(); ++i)
        if (target[at(path[i])] == path.front()) first = i;
    for (std::size_t i = path.size() - 1; i-- > first + 1;)
        if (target[at(path[i])] == path.back()) last = i;
    std::vector<int> out{path.front()};
    for (std::size_t i = first + 1; i < last; ++i) out.push_back(path[i]);
    out.push_back(path.back());
    return out;
}

inline Failure in_several_pieces() {
    return {Refusal::curve_in_pieces,
            "no human body: its curve skeleton is in several pieces; join the pieces of the mesh"};
}

} // namespace detail

template <typename Scalar>
Outcome<Embedding> embed(const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& skeleton_template,
                         const MatchingOptions& options) {
    validate(options);
    const ReducedGraph<Scalar> reduced_curve = reduce(curve), reduced_template = reduce<Scalar>(skeleton_template);
    const auto wanted = static_cast<int>(reduced_template.origin.size());
    const auto found = static_cast<int>(reduced_curve.origin.size());
    if (found < wanted)
        return Failure{Refusal::too_few_ends, "no human body: its curve skeleton has " + std::to_string(found) +
                                                  " ends and junctions, the template needs " + std::to_string(wanted) +
                                                  "; check that head, hands and feet are there and stand free"};
    if (found > most_reduced_nodes)
        return Failure{Refusal::too_many_ends, "no human body: its curve skeleton has " + std::to_string(found) +
                                                   " ends and junctions, a body's has fewer than " +
                                                   std::to_string(most_reduced_nodes) +
                                                   "; the surface may be torn or inside out in places: repair it"};
    if (!reduced_curve.distances.allFinite()) return detail::in_several_pieces();
    const std::vector<int> rounded =
        spectral_assignment(affinity_matrix(reduced_curve, reduced_template, options), wanted);
    const auto [partner, is_least] = least_distorted(
        reduced_curve, reduced_template, descend(reduced_curve, reduced_template, rounded, options), options);

    Embedding out;
    out.is_least = is_least;
    out.distortion = distortion(reduced_curve, reduced_template, partner, options);
    out.node_of_joint.assign(skeleton_template.joints.size(), -1);
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    std::vector<bool> matched(graph.neighbours.size(), false);
    for (int j = 0; j < wanted; ++j) {
        const int node = reduced_curve.origin[detail::at(partner[detail::at(j)])];
        out.node_of_joint[detail::at(reduced_template.origin[detail::at(j)])] = node;
        matched[detail::at(node)] = true;
        ++out.matched_nodes;
    }

    std::vector<std::vector<int>> chains = detail::template_chains(skeleton_template, reduced_template.origin), ways;
    for (const std::vector<int>& joints : chains) {
        const int start = out.node_of_joint[detail::at(joints.front())];
        const int end = out.node_of_joint[detail::at(joints.back())];
        const core::ShortestPaths<Scalar> paths = core::shortest_paths(graph, start);
        if (!std::isfinite(paths.distance[detail::at(end)])) return detail::in_several_pieces();
        ways.push_back(paths.path_to(end));
    }
    const std::vector<int> target = detail::merge_targets(graph, matched, ways);
    for (std::size_t i = 0; i < chains.size(); ++i) {
        // Where a chain leads past the root, the junction there is not the upper one's: an absent leg's stump.
        const bool past_root = std::find(chains[i].begin() + 1, chains[i].end(), 0) != chains[i].end();
        if (!past_root) ways[i] = detail::without_merged(ways[i], target);
        out.chains.push_back({std::move(chains[i]), std::move(ways[i])});
    }
    return out;
}

namespace detail {

/// Per node of the curve, is it matched, or on a branch that ends within a limb or the trunk as these are matched: in
/// the ball around one of their nodes? Such a branch is drawn by a bulge, as of a belly, and is no limb. O(k^2).
template <typename Scalar>
std::vector<bool> matched_or_hidden(const CurveSkeleton<Scalar>& curve, const Embedding& embedding) {
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    std::vector<bool> out(graph.neighbours.size(), false);
    for (const Chain& chain : embedding.chains)
        for (const int node : chain.nodes) out[at(node)] = true;
    const std::vector<bool> on_chain = out;
    const auto is_hidden = [&](int node) {
        for (int other = 0; other < graph.size(); ++other)
            if (on_chain[at(other)] &&
                (core::point(curve.nodes, node) - core::point(curve.nodes, other)).norm() < curve.radii[at(other)])
                return true;
        return false;
    };
    for (int leaf = 0; leaf < graph.size(); ++leaf)
        if (graph.degree(leaf) == 1 && !on_chain[at(leaf)] && is_hidden(leaf))
            for (const int node : core::branch(graph, leaf, graph.neighbours[at(leaf)].front().first)) {
                if (on_chain[at(node)]) break;
                out[at(node)] = true;
            }
    return out;
}

} // namespace detail

template <typename Scalar>
Scalar unmatched_reach(const CurveSkeleton<Scalar>& curve, const Embedding& embedding) {
    core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    Scalar matched = 0;
    for (const Chain& chain : embedding.chains) matched += core::path_length(curve, chain.nodes);
    const std::vector<bool> is_accounted = detail::matched_or_hidden(curve, embedding);
    std::vector<std::pair<int, Scalar>> on_chains;
    for (int node = 0; node < graph.size(); ++node)
        if (is_accounted[detail::at(node)]) on_chains.emplace_back(node, Scalar(0));
    graph.neighbours.push_back(std::move(on_chains)); // a node at no distance from all of them
    Scalar reach = 0;
    for (const Scalar d : core::shortest_paths(graph, graph.size() - 1).distance)
        if (std::isfinite(d)) reach = std::max(reach, d);
    return matched > 0 ? reach / matched : Scalar(0);
}

template <typename Scalar>
Scalar matched_diameter(const CurveSkeleton<Scalar>& curve, const Embedding& embedding) {
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    Scalar diameter = 0;
    for (const Chain& from : embedding.chains) {
        const std::vector<Scalar> distance = core::shortest_paths(graph, from.nodes.back()).distance;
        for (const Chain& to : embedding.chains)
            if (const Scalar d = distance[detail::at(to.nodes.back())]; std::isfinite(d))
                diameter = std::max(diameter, d);
    }
    return diameter;
}

} // namespace skelgen::embedding
