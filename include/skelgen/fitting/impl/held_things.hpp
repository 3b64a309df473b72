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
#include <skelgen/embedding/embed.hpp>
#include <skelgen/embedding/missing_limbs.hpp>
#include <skelgen/embedding/proportions.hpp>
#include <skelgen/surface/without_faces.hpp>

namespace skelgen::fitting {
namespace detail {

/// A node of a curve that may be a hand, and the nodes of what it would hold.
struct EndFork {
    int junction = -1;
    std::vector<int> nodes;
};

/// The junctions from which all branches but one end.
template <typename Scalar>
std::vector<EndFork> end_forks(const CurveSkeleton<Scalar>& curve) {
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    std::vector<EndFork> out;
    for (int v = 0; v < graph.size(); ++v) {
        if (graph.degree(v) < 3) continue;
        EndFork fork{v, {}};
        int leading_on = 0;
        for (const auto& [first, length] : graph.neighbours[static_cast<std::size_t>(v)]) {
            const std::vector<int> branch = core::branch(graph, v, first);
            if (graph.degree(branch.back()) == 1)
                fork.nodes.insert(fork.nodes.end(), branch.begin() + 1, branch.end());
            else
                ++leading_on;
        }
        if (leading_on == 1) out.push_back(std::move(fork));
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

/// How much the template is distorted without the branches of some forks, per pair; none where it does not fit well or
/// has one of the forks for something else than a hand.
template <typename Scalar>
std::optional<double> distortion_without(const CurveSkeleton<Scalar>& curve, const std::vector<const EndFork*>& forks,
                                         const SkeletonTemplate& wanted, const embedding::MatchingOptions& options) {
    constexpr double most_left_over = 0.15; // of the chains' length: what else figures wear
    constexpr double well_enough = 0.01;    // per pair: what is left of it distorts the template, too
    std::vector<bool> is_left_out(curve.radii.size(), false);
    for (const EndFork* fork : forks)
        for (const int node : fork->nodes) is_left_out[static_cast<std::size_t>(node)] = true;
    const PartOfCurve<Scalar> part = without_nodes(curve, is_left_out);
    const embedding::FittingTemplate fitting = embedding::fitting_proportions(part.curve, wanted, options);
    const auto found = embedding::embed(part.curve, fitting.skeleton_template, options);
    if (!found || !embedding::legs_go_on(part.curve, *found, fitting.skeleton_template)) return std::nullopt;
    if (static_cast<double>(embedding::unmatched_share(part.curve, *found)) > most_left_over) return std::nullopt;
    const auto is_hand = [&](const EndFork* fork) {
        for (const Side side : {Side::left, Side::right})
            if (const int hand = find_joint(wanted, JointRole::hand, side); hand >= 0)
                if (const int node = found->node_of_joint[static_cast<std::size_t>(hand)];
                    node >= 0 && part.origin[static_cast<std::size_t>(node)] == fork->junction)
                    return true;
        return false;
    };
    const double distortion = embedding::distortion_per_pair(*found);
    const bool fits = distortion < well_enough && std::all_of(forks.begin(), forks.end(), is_hand);
    return fits ? std::optional(distortion) : std::nullopt;
}

/// Of all ways to take the branches of some forks off the one that leaves the least distorted template; empty where
/// none leaves one.
template <typename Scalar>
std::vector<const EndFork*> holding_hands(const CurveSkeleton<Scalar>& curve, const std::vector<EndFork>& forks,
                                          const SkeletonTemplate& wanted, const embedding::MatchingOptions& options) {
    std::vector<const EndFork*> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t way = 1; way < std::size_t{1} << forks.size(); ++way) {
        std::vector<const EndFork*> taken;
        for (std::size_t i = 0; i < forks.size(); ++i)
            if ((way >> i & 1) != 0) taken.push_back(&forks[i]);
        if (taken.size() > 2) continue;
        const auto distortion = distortion_without(curve, taken, wanted, options);
        if (!distortion || !(*distortion < least)) continue;
        least = *distortion;
        best = std::move(taken);
    }
    return best;
}

/// The body cut where the forks' branches leave the balls there, without what lies beyond.
template <typename Scalar>
Body<Scalar> cut_off(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                     const std::vector<const EndFork*>& forks) {
    std::vector<bool> is_held(static_cast<std::size_t>(body.mesh.vertices.rows()), false);
    for (const EndFork* fork : forks)
        for (const int node : fork->nodes) {
            const Scalar away = (core::point(curve.nodes, node) - core::point(curve.nodes, fork->junction)).norm();
            if (away <= curve.radii[static_cast<std::size_t>(fork->junction)]) continue;
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
    const std::vector<detail::EndFork> forks = detail::end_forks(curve);
    if (forks.size() > most_forks) return std::nullopt;
    const std::vector<const detail::EndFork*> hands = detail::holding_hands(curve, forks, wanted, options);
    if (hands.empty()) return std::nullopt;
    Body<Scalar> out = detail::cut_off(body, curve, hands);
    out.repairs.push_back("what is held in " + std::string(hands.size() == 1 ? "one hand" : "both hands") +
                          " taken off");
    return out;
}

} // namespace skelgen::fitting
