#pragma once

#include <skelgen/embedding/loop_cuts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/embedding/missing_limbs.hpp>
#include <skelgen/embedding/reduced_graph.hpp>

namespace skelgen::embedding {
namespace detail {

using Edge = std::array<int, 2>;

inline Edge edge_between(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

inline std::set<Edge> edges_of(const std::vector<int>& path) {
    std::set<Edge> out;
    for (std::size_t i = 1; i < path.size(); ++i) out.insert(edge_between(path[i - 1], path[i]));
    return out;
}

template <typename Scalar>
CurveSkeleton<Scalar> without_edges(CurveSkeleton<Scalar> curve, const std::set<Edge>& removed) {
    std::erase_if(curve.edges, [&](const Edge& e) { return removed.contains(e); });
    return curve;
}

template <typename Scalar>
bool are_connected(const core::CurveGraph<Scalar>& graph, int a, int b) {
    return std::isfinite(core::shortest_paths(graph, a).distance[at(b)]);
}

/// Paths from junction to junction that lie on a loop, each once; both ends included.
template <typename Scalar>
std::vector<std::vector<int>> loop_branches(const CurveSkeleton<Scalar>& curve) {
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    std::vector<std::vector<int>> out;
    for (int v = 0; v < graph.size(); ++v) {
        if (graph.degree(v) < 3) continue;
        for (const auto& [first, length] : graph.neighbours[at(v)]) {
            std::vector<int> path = core::branch(graph, v, first);
            if (graph.degree(path.back()) < 3) continue;                                       // a leaf
            if (std::pair(v, first) > std::pair(path.back(), path[path.size() - 2])) continue; // seen from there
            if (are_connected(core::curve_graph(without_edges(curve, {edge_between(v, first)})), v, first))
                out.push_back(std::move(path));
        }
    }
    return out;
}

/// The edges of loops that are no limb's: short ones that go out from a junction and back to it, as of a finger on a
/// hip. An arm that touches the trunk makes one of a quarter of the way from toe to fingertip, and more.
template <typename Scalar>
std::set<Edge> edges_of_small_loops(const CurveSkeleton<Scalar>& curve) {
    constexpr auto longest = static_cast<Scalar>(0.2); // of the curve's diameter
    const Scalar bound = longest * core::curve_diameter(core::curve_graph(curve));
    std::set<Edge> out;
    for (const std::vector<int>& branch : loop_branches(curve))
        if (branch.front() == branch.back() && core::path_length(curve, branch) < bound) out.merge(edges_of(branch));
    return out;
}

/// First node of the path farther than `distance` from its start along it; at most the last.
template <typename Scalar>
std::size_t first_beyond(const CurveSkeleton<Scalar>& curve, const std::vector<int>& path, Scalar distance) {
    Scalar arc = 0;
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
        arc += (core::point(curve.nodes, path[i]) - core::point(curve.nodes, path[i - 1])).norm();
        if (arc > distance) return i;
    }
    return path.size() - 1;
}

/// A loop cut, and the edges that go with it: the cut one, and those of what remains within the junction it sticks in.
struct CutCandidate {
    LoopCut cut;
    std::set<Edge> edges;
};

/// The branch cut before its node `position`.
template <typename Scalar>
LoopCut cut_before(const CurveSkeleton<Scalar>& curve, const std::vector<int>& branch, std::size_t position) {
    const core::CurveGraph<Scalar> rest = core::curve_graph(without_edges(curve, edges_of(branch)));
    const std::vector<Scalar> to_start = core::shortest_paths(rest, branch.front()).distance;
    const std::vector<Scalar> to_end = core::shortest_paths(rest, branch.back()).distance;
    const auto cut = branch.begin() + static_cast<std::ptrdiff_t>(position);
    LoopCut out;
    out.limb.assign(cut, cut + (branch.end() - cut + 1) / 2);
    for (int v = 0; v < rest.size(); ++v) {
        const bool on_limb_side = std::find(cut, branch.end(), v) != branch.end() && v != branch.front();
        if (!on_limb_side && to_start[at(v)] <= to_end[at(v)]) out.other.push_back(v);
    }
    return out;
}

template <typename Scalar>
CutCandidate cut_candidate(const CurveSkeleton<Scalar>& curve, const std::vector<int>& branch, std::size_t position,
                           bool with_stub) {
    CutCandidate out{cut_before(curve, branch, position), {edge_between(branch[position - 1], branch[position])}};
    if (with_stub) out.edges.merge(edges_of({branch.begin(), branch.begin() + static_cast<std::ptrdiff_t>(position)}));
    return out;
}

template <typename Scalar>
std::vector<CutCandidate> cut_candidates(const CurveSkeleton<Scalar>& curve) {
    // Radius of the thickest limb that is cut, relative to the curve's diameter; 9 cm on an adult, with 2.4 m from toe
    // to fingertip: thighs are cut at most, trunks are not.
    constexpr auto thickest_limb = static_cast<Scalar>(0.038);
    // A trunk is half as wide again as the ball in it.
    constexpr auto width = static_cast<Scalar>(1.5);
    std::vector<CutCandidate> out;
    for (std::vector<int> branch : loop_branches(curve)) {
        for (int side = 0; side < 2; ++side) {
            const std::size_t outside = first_beyond(curve, branch, width * curve.radii[at(branch.front())]);
            if (outside + 1 < branch.size()) out.push_back(cut_candidate(curve, branch, outside, true));
            std::reverse(branch.begin(), branch.end());
        }
        const std::size_t middle = first_beyond(curve, branch, core::path_length(curve, branch) / 2);
        out.push_back(cut_candidate(curve, branch, middle, false));
    }
    const Scalar limb = thickest_limb * core::curve_diameter(core::curve_graph(curve));
    std::erase_if(out, [&](const CutCandidate& c) { return curve.radii[at(c.cut.limb.front())] > limb; });
    return out;
}

/// Without nodes that no edge leads to; what is embedded needs no regions.
template <typename Scalar>
CurveSkeleton<Scalar> without_lone_nodes(const CurveSkeleton<Scalar>& curve) {
    std::vector<int> index(static_cast<std::size_t>(curve.nodes.rows()), -1);
    for (const auto& [a, b] : curve.edges) index[at(a)] = index[at(b)] = 0;
    CurveSkeleton<Scalar> out;
    out.nodes.resize(std::count(index.begin(), index.end(), 0), 3);
    int kept = 0;
    for (std::size_t v = 0; v < index.size(); ++v) {
        if (index[v] < 0) continue;
        index[v] = kept;
        out.nodes.row(kept++) = curve.nodes.row(static_cast<Eigen::Index>(v));
        out.radii.push_back(curve.radii[v]);
    }
    out.regions.resize(out.radii.size());
    for (const auto& [a, b] : curve.edges) out.edges.push_back(edge_between(index[at(a)], index[at(b)]));
    return out;
}

/// Of the template in the curve without these edges; infinite where it does not fit. Distortions that differ by
/// rounding alone are made equal, so that a turned body is cut in the same places.
template <typename Scalar>
double graded_distortion(const CurveSkeleton<Scalar>& curve, const std::set<Edge>& removed,
                         const SkeletonTemplate& skeleton_template, const MatchingOptions& options) {
    const Outcome<Embedding> embedding =
        embed(without_lone_nodes(without_edges(curve, removed)), skeleton_template, options);
    if (!embedding) return std::numeric_limits<double>::infinity();
    return std::floor(embedding->distortion / static_cast<double>(core::rounding<Scalar>()));
}

/// Whether a body cut so may yet be fitted: what the template fits badly without these edges it fits badly when the
/// surface is cut there, too, whose curve takes its time.
template <typename Scalar>
bool may_fit(const CurveSkeleton<Scalar>& curve, const std::set<Edge>& removed,
             const SkeletonTemplate& skeleton_template, const MatchingOptions& options) {
    constexpr double worst = 0.012; // per pair, twice what fits well; cut bodies that were found had half of that
    const CurveSkeleton<Scalar> opened = without_lone_nodes(without_edges(curve, removed));
    const Outcome<Embedding> embedding = embed(opened, skeleton_template, options);
    return embedding && distortion_per_pair(*embedding) <= worst;
}

/// Some loops opened.
struct Opening {
    LoopCuts cuts;
    std::set<Edge> edges;
    double distortion = std::numeric_limits<double>::infinity(); ///< graded
};

} // namespace detail

template <typename Scalar>
int contact_count(const CurveSkeleton<Scalar>& curve) {
    if (core::cycle_count(curve) == 0) return 0;
    return core::cycle_count(
        detail::without_lone_nodes(detail::without_edges(curve, detail::edges_of_small_loops(curve))));
}

template <typename Scalar>
std::vector<LoopCuts> find_loop_cuts(const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& skeleton_template,
                                     const MatchingOptions& options) {
    using detail::Opening;
    constexpr std::size_t beam = 6; // bounds the work: a loop has some ten candidates, and the best is among the first
    constexpr int most_loops =
        6; // hands on hips, legs together and heels: a body makes four; more are a scan's tunnels
    validate(options);
    constexpr std::size_t most_branches = 40; // a body with so many loops has 5 limbs, and 3 branches more for each
    const int loops = contact_count(curve);
    if (loops < 1 || loops > most_loops || core::branches(core::curve_graph(curve)).size() > most_branches) return {};
    std::vector<Opening> openings{Opening{{}, detail::edges_of_small_loops(curve)}};
    for (int level = 0; level < loops; ++level) {
        std::vector<Opening> next;
        for (const Opening& opening : openings)
            for (const detail::CutCandidate& found :
                 detail::cut_candidates(detail::without_edges(curve, opening.edges))) {
                Opening wider = opening;
                wider.cuts.push_back(found.cut);
                wider.edges.insert(found.edges.begin(), found.edges.end());
                const bool known = std::any_of(next.begin(), next.end(),
                                               [&](const Opening& other) { return other.edges == wider.edges; });
                if (known) continue;
                wider.distortion = detail::graded_distortion(curve, wider.edges, skeleton_template, options);
                next.push_back(std::move(wider));
            }
        std::stable_sort(next.begin(), next.end(),
                         [](const Opening& a, const Opening& b) { return a.distortion < b.distortion; });
        if (next.size() > beam) next.resize(beam);
        openings = std::move(next);
    }
    constexpr double as_good = 1.5; // times the least distortion: calibrated on generated bodies that touch themselves
    constexpr std::size_t most_ways = 3;
    std::vector<LoopCuts> out;
    for (Opening& opening : openings)
        if (std::isfinite(opening.distortion) && opening.distortion <= as_good * openings.front().distortion &&
            out.size() < most_ways && detail::may_fit(curve, opening.edges, skeleton_template, options))
            out.push_back(std::move(opening.cuts));
    return out;
}

} // namespace skelgen::embedding
