#include <skelgen/embedding/loop_cuts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/embedding/embed.hpp>

namespace skelgen {
namespace {

using Edge = std::array<int, 2>;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Edge edge_between(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

CurveSkeleton<double> without_edges(CurveSkeleton<double> curve, const std::set<Edge>& removed) {
    std::erase_if(curve.edges, [&](const Edge& e) { return removed.contains(e); });
    return curve;
}

bool connected(const CurveGraph<double>& graph, int a, int b) {
    return std::isfinite(shortest_paths(graph, a).distance[at(b)]);
}

/// Paths from junction to junction that lie on a loop, each once; both ends included.
std::vector<std::vector<int>> loop_branches(const CurveSkeleton<double>& curve) {
    const CurveGraph<double> graph = curve_graph(curve);
    std::vector<std::vector<int>> out;
    for (int v = 0; v < graph.size(); ++v) {
        if (graph.degree(v) < 3) continue;
        for (const auto& [first, length] : graph.neighbours[at(v)]) {
            std::vector<int> path{v, first};
            while (graph.degree(path.back()) == 2) {
                const auto& list = graph.neighbours[at(path.back())];
                path.push_back(list[0].first == path[path.size() - 2] ? list[1].first : list[0].first);
            }
            if (graph.degree(path.back()) < 3) continue;                                       // a leaf
            if (std::pair(v, first) > std::pair(path.back(), path[path.size() - 2])) continue; // seen from there
            if (connected(curve_graph(without_edges(curve, {edge_between(v, first)})), v, first))
                out.push_back(std::move(path));
        }
    }
    return out;
}

/// First node of the path farther than `distance` from its start along it; at most the last.
std::size_t first_beyond(const CurveSkeleton<double>& curve, const std::vector<int>& path, double distance) {
    double arc = 0;
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
        arc += (curve.nodes.row(path[i]) - curve.nodes.row(path[i - 1])).norm();
        if (arc > distance) return i;
    }
    return path.size() - 1;
}

double length(const CurveSkeleton<double>& curve, const std::vector<int>& path) {
    double sum = 0;
    for (std::size_t i = 1; i < path.size(); ++i)
        sum += (curve.nodes.row(path[i]) - curve.nodes.row(path[i - 1])).norm();
    return sum;
}

/// Radius of the thickest limb, relative to the curve's diameter: thighs are cut at most, trunks are not.
constexpr double thickest_limb = 0.05;

/// A loop cut, and the edges that go with it: the cut one, and those of what remains within the junction it sticks in.
struct Candidate {
    LoopCut cut;
    std::set<Edge> edges;
};

std::set<Edge> edges_of(const std::vector<int>& path) {
    std::set<Edge> out;
    for (std::size_t i = 1; i < path.size(); ++i) out.insert(edge_between(path[i - 1], path[i]));
    return out;
}

/// The branch cut before its node `position`.
LoopCut cut_before(const CurveSkeleton<double>& curve, const std::vector<int>& branch, std::size_t position) {
    const CurveGraph<double> rest = curve_graph(without_edges(curve, edges_of(branch)));
    const std::vector<double> to_start = shortest_paths(rest, branch.front()).distance;
    const std::vector<double> to_end = shortest_paths(rest, branch.back()).distance;
    const auto cut = branch.begin() + static_cast<std::ptrdiff_t>(position);
    LoopCut out;
    out.limb.assign(cut, cut + (branch.end() - cut + 1) / 2);
    for (int v = 0; v < rest.size(); ++v) {
        const bool on_limb_side = std::find(cut, branch.end(), v) != branch.end() && v != branch.front();
        if (!on_limb_side && (to_start[at(v)] <= to_end[at(v)])) out.other.push_back(v);
    }
    return out;
}

Candidate candidate(const CurveSkeleton<double>& curve, const std::vector<int>& branch, std::size_t position,
                    bool with_stub) {
    Candidate out{cut_before(curve, branch, position), {edge_between(branch[position - 1], branch[position])}};
    if (with_stub) out.edges.merge(edges_of({branch.begin(), branch.begin() + static_cast<std::ptrdiff_t>(position)}));
    return out;
}

std::vector<Candidate> candidates(const CurveSkeleton<double>& curve) {
    std::vector<Candidate> out;
    for (std::vector<int> branch : loop_branches(curve)) {
        for (int side = 0; side < 2; ++side) {
            const std::size_t outside = first_beyond(curve, branch, curve.radii[at(branch.front())]);
            if (outside + 1 < branch.size()) out.push_back(candidate(curve, branch, outside, true));
            std::reverse(branch.begin(), branch.end());
        }
        const std::size_t middle = first_beyond(curve, branch, 0.5 * length(curve, branch));
        out.push_back(candidate(curve, branch, middle, false));
    }
    const double limb = thickest_limb * curve_diameter(curve_graph(curve));
    std::erase_if(out, [&](const Candidate& c) { return curve.radii[at(c.cut.limb.front())] > limb; });
    return out;
}

/// Without nodes that no edge leads to.
CurveSkeleton<double> compact(const CurveSkeleton<double>& curve) {
    std::vector<int> index(at(static_cast<int>(curve.nodes.rows())), -1);
    for (const auto& [a, b] : curve.edges) index[at(a)] = index[at(b)] = 0;
    CurveSkeleton<double> out;
    out.nodes.resize(std::count(index.begin(), index.end(), 0), 3);
    int kept = 0;
    for (std::size_t v = 0; v < index.size(); ++v) {
        if (index[v] < 0) continue;
        index[v] = kept;
        out.nodes.row(kept++) = curve.nodes.row(static_cast<Eigen::Index>(v));
        out.radii.push_back(curve.radii[v]);
        out.regions.push_back(curve.regions[v]);
    }
    for (const auto& [a, b] : curve.edges) out.edges.push_back(edge_between(index[at(a)], index[at(b)]));
    return out;
}

double distortion_of(const CurveSkeleton<double>& curve, const SkeletonTemplate& skeleton_template,
                     const MatchingOptions& options) {
    try {
        return embed(compact(curve), skeleton_template, options).distortion;
    } catch (const Error&) {
        return std::numeric_limits<double>::infinity();
    }
}

/// Distortions that differ by rounding alone are equal, so that a turned body is cut in the same places.
double graded(double distortion) { return std::floor(1e9 * distortion); }

/// Some loops opened.
struct Opening {
    std::vector<LoopCut> cuts;
    std::set<Edge> edges;
    double distortion = std::numeric_limits<double>::infinity();
};

} // namespace

std::vector<LoopCut> find_loop_cuts(const CurveSkeleton<double>& curve, const SkeletonTemplate& skeleton_template,
                                    const MatchingOptions& options) {
    constexpr std::size_t beam = 6;
    constexpr int most_loops = 6;
    const int loops = cycle_count(curve);
    if (loops < 1 || loops > most_loops) return {};
    std::vector<Opening> openings{Opening{}};
    for (int level = 0; level < loops; ++level) {
        std::vector<Opening> next;
        for (const Opening& opening : openings)
            for (const Candidate& found : candidates(without_edges(curve, opening.edges))) {
                Opening wider = opening;
                wider.cuts.push_back(found.cut);
                wider.edges.insert(found.edges.begin(), found.edges.end());
                const bool known = std::any_of(next.begin(), next.end(),
                                               [&](const Opening& other) { return other.edges == wider.edges; });
                if (known) continue;
                wider.distortion = distortion_of(without_edges(curve, wider.edges), skeleton_template, options);
                next.push_back(std::move(wider));
            }
        std::stable_sort(next.begin(), next.end(), [](const Opening& a, const Opening& b) {
            return graded(a.distortion) < graded(b.distortion);
        });
        if (next.size() > beam) next.resize(beam);
        openings = std::move(next);
    }
    if (openings.empty() || !std::isfinite(openings.front().distortion)) return {};
    return openings.front().cuts;
}

} // namespace skelgen
