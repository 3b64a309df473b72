#include <skelgen/embedding/embed.hpp>

#include <algorithm>
#include <cmath>

#include <skelgen/core/error.hpp>
#include <skelgen/embedding/reduced_graph.hpp>

namespace skelgen {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Chains of the template: from each joint of the reduced graph up to the next one above it.
std::vector<std::vector<int>> template_chains(const SkeletonTemplate& skeleton_template, const ReducedGraph& reduced) {
    std::vector<bool> is_end(skeleton_template.joints.size(), false);
    for (const int j : reduced.origin) is_end[at(j)] = true;
    std::vector<std::vector<int>> chains;
    for (const int end : reduced.origin) {
        std::vector<int> chain{end};
        int j = skeleton_template.joints[at(end)].parent;
        for (; j >= 0; j = skeleton_template.joints[at(j)].parent) {
            chain.push_back(j);
            if (is_end[at(j)]) break;
        }
        if (chain.size() < 2) continue;
        std::reverse(chain.begin(), chain.end());
        chains.push_back(std::move(chain));
    }
    return chains;
}

/// Where each unmatched junction of the curve goes: the matched neighbour in the reduced graph with the most branches.
std::vector<int> merge_targets(const CurveGraph<double>& graph, const std::vector<int>& matched) {
    std::vector<int> target(matched.size());
    for (int v = 0; v < graph.size(); ++v) {
        target[at(v)] = v;
        if (graph.degree(v) < 3 || matched[at(v)] >= 0) continue;
        int best = -1;
        for (const auto& [first, length] : graph.neighbours[at(v)]) {
            int previous = v, w = first;
            while (graph.degree(w) == 2) {
                const auto& list = graph.neighbours[at(w)];
                const int next = list[0].first == previous ? list[1].first : list[0].first;
                previous = w;
                w = next;
            }
            const bool better = best < 0 || graph.degree(w) > graph.degree(best);
            if (matched[at(w)] >= 0 && graph.degree(w) >= 3 && better) best = w;
        }
        if (best >= 0) target[at(v)] = best;
    }
    return target;
}

/// The nodes of a path with merged junctions drawn together: everything before the last node merged into its start, and
/// after the first merged into its end, is the start or end itself.
std::vector<int> without_merged(const std::vector<int>& path, const std::vector<int>& target) {
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

} // namespace

Embedding embed(const CurveSkeleton<double>& curve, const SkeletonTemplate& skeleton_template,
                const MatchingOptions& options) {
    const ReducedGraph reduced_curve = reduce(curve), reduced_template = reduce(skeleton_template);
    const auto wanted = static_cast<int>(reduced_template.origin.size());
    const auto found = static_cast<int>(reduced_curve.origin.size());
    if (found < wanted)
        throw Error(ErrorCode::no_skeleton, "no human body: its curve skeleton has " + std::to_string(found) +
                                                " ends and junctions, the template needs " + std::to_string(wanted) +
                                                "; check that head, hands and feet are there and stand free");
    if (!reduced_curve.distances.allFinite())
        throw Error(ErrorCode::no_skeleton, "no human body: its curve skeleton is in several pieces");
    const Eigen::MatrixXd affinities = affinity_matrix(reduced_curve, reduced_template, options);
    const std::vector<int> rounded = spectral_assignment(affinities, wanted);
    const std::vector<int> partner = least_distorted(
        reduced_curve, reduced_template, descend(reduced_curve, reduced_template, rounded, options), options);

    Embedding out;
    out.distortion = distortion(reduced_curve, reduced_template, partner, options);
    out.node_of_joint.assign(skeleton_template.joints.size(), -1);
    const CurveGraph<double> graph = curve_graph(curve);
    std::vector<int> matched(at(graph.size()), -1);
    for (int j = 0; j < wanted; ++j) {
        const int node = reduced_curve.origin[at(partner[at(j)])], joint = reduced_template.origin[at(j)];
        out.node_of_joint[at(joint)] = node;
        matched[at(node)] = joint;
        ++out.matched_nodes;
    }

    const std::vector<int> target = merge_targets(graph, matched);
    for (std::vector<int>& joints : template_chains(skeleton_template, reduced_template)) {
        const int start = out.node_of_joint[at(joints.front())], end = out.node_of_joint[at(joints.back())];
        const ShortestPaths<double> paths = shortest_paths(graph, start);
        if (!std::isfinite(paths.distance[at(end)]))
            throw Error(ErrorCode::no_skeleton, "no human body: its curve skeleton is in several pieces");
        std::vector<int> nodes = without_merged(paths.path_to(end), target);
        out.chains.push_back({std::move(joints), std::move(nodes)});
    }
    return out;
}

double unmatched_reach(const CurveSkeleton<double>& curve, const Embedding& embedding) {
    CurveGraph<double> graph = curve_graph(curve);
    double matched = 0;
    std::vector<std::pair<int, double>> on_chains;
    for (const Chain& chain : embedding.chains)
        for (std::size_t i = 0; i < chain.nodes.size(); ++i) {
            on_chains.emplace_back(chain.nodes[i], 0.0);
            if (i > 0) matched += (curve.nodes.row(chain.nodes[i]) - curve.nodes.row(chain.nodes[i - 1])).norm();
        }
    graph.neighbours.push_back(std::move(on_chains)); // a node at no distance from all of them
    double reach = 0;
    for (const double d : shortest_paths(graph, graph.size() - 1).distance)
        if (std::isfinite(d)) reach = std::max(reach, d);
    return matched > 0 ? reach / matched : 0;
}

} // namespace skelgen
