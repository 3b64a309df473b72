#pragma once

#include <skelgen/fitting/held_things.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/embedding/missing_limbs.hpp>
#include <skelgen/embedding/proportions.hpp>
#include <skelgen/surface/without_faces.hpp>

namespace skelgen::fitting {
namespace detail {

/// A node of a curve that may be a hand, the nodes of what it would hold, and which node the other hand would be, if
/// that is why.
struct Grip {
    int hand = -1;
    std::vector<int> held;
    int other_hand = -1;
};

/// The junctions from which all branches but one end.
template <typename Scalar>
std::vector<Grip> forks_at_ends(const CurveSkeleton<Scalar>& curve) {
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    std::vector<Grip> out;
    for (int v = 0; v < graph.size(); ++v) {
        if (graph.degree(v) < 3) continue;
        Grip grip{v, {}, -1};
        int leading_on = 0;
        for (const auto& [first, length] : graph.neighbours[static_cast<std::size_t>(v)]) {
            const std::vector<int> branch = core::branch(graph, v, first);
            if (graph.degree(branch.back()) == 1)
                grip.held.insert(grip.held.end(), branch.begin() + 1, branch.end());
            else
                ++leading_on;
        }
        if (leading_on == 1) out.push_back(std::move(grip));
    }
    return out;
}

/// For each two branches that end, of which one is clearly longer: where it has the length of the other. There a hand
/// may hold something whose other end is too short for a branch of its own: arms are equally long.
template <typename Scalar>
std::vector<Grip> beyond_equal_lengths(const CurveSkeleton<Scalar>& curve) {
    constexpr Scalar clearly = Scalar(1.2), no_longer = Scalar(2); // as what it holds is at most as long as an arm
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    std::vector<std::vector<int>> lines; // from where they fork to their ends
    std::vector<Eigen::Matrix<Scalar, Eigen::Dynamic, 1>> ways;
    for (int end = 0; end < graph.size(); ++end) {
        if (graph.degree(end) != 1) continue;
        lines.push_back(core::branch(graph, end, graph.neighbours[static_cast<std::size_t>(end)][0].first));
        std::reverse(lines.back().begin(), lines.back().end());
        ways.push_back(core::arc_lengths<Scalar>(curve.nodes(lines.back(), Eigen::all)));
    }
    std::vector<Grip> out;
    for (std::size_t i = 0; i < lines.size(); ++i)
        for (std::size_t k = 0; k < lines.size(); ++k) {
            const Scalar longer = ways[i][ways[i].size() - 1], shorter = ways[k][ways[k].size() - 1];
            if (longer < clearly * shorter || longer > no_longer * shorter) continue;
            const auto there = std::lower_bound(ways[i].begin(), ways[i].end(), shorter) - ways[i].begin();
            out.push_back({lines[i][static_cast<std::size_t>(there)],
                           {lines[i].begin() + there + 1, lines[i].end()},
                           lines[k].back()});
        }
    return out;
}

/// A curve without some of its nodes, and where those that are left were.
template <typename Scalar>
struct PartOfCurve {
    CurveSkeleton<Scalar> curve; ///< without regions
    std::vector<int> origin;
};

template <typename Scalar>
PartOfCurve<Scalar> without_nodes(const CurveSkeleton<Scalar>& curve, const std::vector<bool>& is_left_out) {
    PartOfCurve<Scalar> out;
    std::vector<int> now(is_left_out.size(), -1);
    for (std::size_t v = 0; v < is_left_out.size(); ++v) {
        if (is_left_out[v]) continue;
        now[v] = static_cast<int>(out.origin.size());
        out.origin.push_back(static_cast<int>(v));
        out.curve.radii.push_back(curve.radii[v]);
    }
    out.curve.nodes.resize(static_cast<Eigen::Index>(out.origin.size()), 3);
    out.curve.regions.resize(out.origin.size());
    for (std::size_t v = 0; v < out.origin.size(); ++v)
        out.curve.nodes.row(static_cast<Eigen::Index>(v)) = curve.nodes.row(out.origin[v]);
    for (const auto& [a, b] : curve.edges)
        if (const int from = now[static_cast<std::size_t>(a)], to = now[static_cast<std::size_t>(b)];
            from >= 0 && to >= 0)
            out.curve.edges.push_back({from, to});
    return out;
}

/// How much the template is distorted without what some grips hold, per pair; none where it does not fit well or has
/// one of the grips for something else than a hand.
template <typename Scalar>
std::optional<double> distortion_without(const CurveSkeleton<Scalar>& curve, const std::vector<const Grip*>& grips,
                                         const SkeletonTemplate& wanted, const embedding::MatchingOptions& options) {
    constexpr double most_left_over = 0.15; // of the chains' length: what else figures wear
    constexpr double well_enough = 0.01;    // per pair: what is left of it distorts the template, too
    std::vector<bool> is_left_out(curve.radii.size(), false);
    for (const Grip* grip : grips)
        for (const int node : grip->held) is_left_out[static_cast<std::size_t>(node)] = true;
    const PartOfCurve<Scalar> part = without_nodes(curve, is_left_out);
    const embedding::FittingTemplate fitting = embedding::fitting_proportions(part.curve, wanted, options);
    const auto found = embedding::embed(part.curve, fitting.skeleton_template, options);
    if (!found || !embedding::legs_go_on(part.curve, *found, fitting.skeleton_template)) return std::nullopt;
    if (static_cast<double>(embedding::unmatched_share(part.curve, *found)) > most_left_over) return std::nullopt;
    const auto hand_of = [&](Side side) { // the curve's node, or -1
        const int joint = find_joint(wanted, JointRole::hand, side);
        const int node = joint >= 0 ? found->node_of_joint[static_cast<std::size_t>(joint)] : -1;
        return node >= 0 ? part.origin[static_cast<std::size_t>(node)] : -1;
    };
    const int left = hand_of(Side::left), right = hand_of(Side::right);
    const auto is_hand = [&](const Grip* grip) {
        if (grip->hand != left && grip->hand != right) return false;
        return grip->other_hand < 0 || grip->other_hand == (grip->hand == left ? right : left);
    };
    const double distortion = embedding::distortion_per_pair(*found);
    const bool fits = distortion < well_enough && std::all_of(grips.begin(), grips.end(), is_hand);
    return fits ? std::optional(distortion) : std::nullopt;
}

/// Of the ways to empty one grip, or, where none of these leaves a template that fits, two of the forks, the one that
/// leaves the least distorted; empty where there is none, or nothing is better.
template <typename Scalar>
std::vector<const Grip*> holding_hands(const CurveSkeleton<Scalar>& curve, const std::vector<Grip>& forks,
                                       const std::vector<Grip>& others, const SkeletonTemplate& wanted,
                                       const embedding::MatchingOptions& options) {
    std::vector<const Grip*> best;
    double least =
        distortion_without<Scalar>(curve, {}, wanted, options).value_or(std::numeric_limits<double>::infinity());
    const auto try_way = [&](std::vector<const Grip*> way) {
        const auto distortion = distortion_without(curve, way, wanted, options);
        if (!distortion || !(*distortion < least)) return;
        least = *distortion;
        best = std::move(way);
    };
    for (const Grip& grip : forks) try_way({&grip});
    for (const Grip& grip : others) try_way({&grip});
    if (!best.empty()) return best;
    for (std::size_t i = 0; i < forks.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) try_way({&forks[k], &forks[i]});
    return best;
}

/// The body cut where what is held leaves the hands' balls, without what lies beyond.
template <typename Scalar>
Body<Scalar> cut_off(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                     const std::vector<const Grip*>& grips) {
    std::vector<bool> is_held(static_cast<std::size_t>(body.mesh.vertices.rows()), false);
    for (const Grip* grip : grips)
        for (const int node : grip->held) {
            const Scalar away = (core::point(curve.nodes, node) - core::point(curve.nodes, grip->hand)).norm();
            if (away <= curve.radii[static_cast<std::size_t>(grip->hand)]) continue;
            for (const int v : curve.regions[static_cast<std::size_t>(node)])
                is_held[static_cast<std::size_t>(v)] = true;
        }
    std::vector<bool> is_left_out(static_cast<std::size_t>(body.mesh.faces.rows()), false);
    for (Eigen::Index f = 0; f < body.mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            if (is_held[static_cast<std::size_t>(body.mesh.faces(f, k))])
                is_left_out[static_cast<std::size_t>(f)] = true;
    return surface::without_faces(body, is_left_out);
}

} // namespace detail

template <typename Scalar>
std::optional<Body<Scalar>> without_held_things(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                                                const SkeletonTemplate& wanted,
                                                const embedding::MatchingOptions& options) {
    constexpr std::size_t most_forks = 5; // two hands, the legs, a head with horns, and one more
    if (core::cycle_count(curve) > 0) return std::nullopt;
    const std::vector<detail::Grip> forks = detail::forks_at_ends(curve);
    if (forks.size() > most_forks) return std::nullopt;
    const std::vector<detail::Grip> beyond = detail::beyond_equal_lengths(curve);
    const std::vector<const detail::Grip*> hands = detail::holding_hands(curve, forks, beyond, wanted, options);
    if (hands.empty()) return std::nullopt;
    Body<Scalar> out = detail::cut_off(body, curve, hands);
    out.repairs.push_back("what is held in " + std::string(hands.size() == 1 ? "one hand" : "both hands") +
                          " taken off");
    return out;
}

} // namespace skelgen::fitting
