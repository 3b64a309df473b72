#pragma once

#include <skelgen/search/held_things.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
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

namespace skelgen::search {
namespace detail {

/// A node of a curve that may be a hand, the branches of what it would hold, and which node the other hand would be,
/// if that is why.
struct Grip {
    std::vector<int> arm;               ///< from the hand inwards
    std::vector<std::vector<int>> held; ///< outwards, each without the hand
    int other_hand = -1;

    [[nodiscard]] int hand() const { return arm.front(); }
};

/// The junctions from which all branches but one end.
template <typename Scalar>
std::vector<Grip> forks_at_ends(const CurveSkeleton<Scalar>& curve) {
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    std::vector<Grip> out;
    for (int v = 0; v < graph.size(); ++v) {
        if (graph.degree(v) < 3) continue;
        Grip grip;
        int leading_on = 0;
        for (const auto& [first, length] : graph.neighbours[static_cast<std::size_t>(v)]) {
            std::vector<int> branch = core::branch(graph, v, first);
            if (graph.degree(branch.back()) == 1) {
                grip.held.emplace_back(branch.begin() + 1, branch.end());
            } else {
                grip.arm = std::move(branch);
                ++leading_on;
            }
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
            const auto hand =
                lines[i].begin() + (std::lower_bound(ways[i].begin(), ways[i].end(), shorter) - ways[i].begin());
            out.push_back({{std::make_reverse_iterator(hand + 1), lines[i].rend()},
                           {{hand + 1, lines[i].end()}},
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

/// A way to empty some grips, and how well the template fits what is left.
template <typename Scalar>
struct Emptied {
    std::vector<const Grip*> grips;
    std::vector<Scalar> hands; ///< per grip how much the arm is shorter than the other one: what a hand has beyond it
    double distortion = std::numeric_limits<double>::infinity(); ///< per pair
};

/// What is left without what some grips hold; none where the template does not fit that well or has one of the grips
/// for something else than a hand.
template <typename Scalar>
std::optional<Emptied<Scalar>> emptied(const CurveSkeleton<Scalar>& curve, const std::vector<const Grip*>& grips,
                                       const SkeletonTemplate& wanted, const embedding::MatchingOptions& options) {
    constexpr double most_left_over = 0.15; // of the chains' length: what else figures wear
    constexpr double well_enough = 0.01;    // per pair: what is left of it distorts the template, too
    constexpr double well_fitted = 0.006;   // per pair: registered bodies have no more
    std::vector<bool> is_left_out(curve.radii.size(), false);
    for (const Grip* grip : grips)
        for (const std::vector<int>& branch : grip->held)
            for (const int node : branch) is_left_out[static_cast<std::size_t>(node)] = true;
    const PartOfCurve<Scalar> part = without_nodes(curve, is_left_out);
    const auto fitting = embedding::fitting_proportions(part.curve, wanted, options);
    if (!fitting) return std::nullopt;
    const embedding::Embedding& found = fitting->embedding;
    Emptied<Scalar> out{grips, {}, embedding::distortion_per_pair(found)};
    if (!(out.distortion < well_enough)) return std::nullopt;
    // Animals' legs do not go on from the trunk, nor does a person's template fit animals well.
    const bool is_persons = !fitting->is_odd && out.distortion < well_fitted;
    if (!is_persons && !embedding::legs_go_on(part.curve, found, fitting->skeleton_template)) return std::nullopt;
    if (static_cast<double>(embedding::unmatched_share(part.curve, found)) > most_left_over) return std::nullopt;
    const auto node_of = [&](JointRole role, Side side) { // the part's node, or -1
        const int joint = find_joint(wanted, role, side);
        return joint >= 0 ? found.node_of_joint[static_cast<std::size_t>(joint)] : -1;
    };
    const int left = node_of(JointRole::hand, Side::left), right = node_of(JointRole::hand, Side::right);
    const auto from_chest =
        core::shortest_paths(core::curve_graph(part.curve), node_of(JointRole::chest, Side::none)).distance;
    const auto is_at = [&](int node, int part_node) {
        return part_node >= 0 && part.origin[static_cast<std::size_t>(part_node)] == node;
    };
    for (const Grip* grip : grips) {
        if (!is_at(grip->hand(), left) && !is_at(grip->hand(), right)) return std::nullopt;
        const int own = is_at(grip->hand(), left) ? left : right, other = own == left ? right : left;
        if (grip->other_hand >= 0 && !is_at(grip->other_hand, other)) return std::nullopt;
        out.hands.push_back(other < 0 ? Scalar(0)
                                      : from_chest[static_cast<std::size_t>(other)] -
                                            from_chest[static_cast<std::size_t>(own)]);
    }
    return out;
}

/// Of the ways to empty one grip, or, where none of these leaves a template that fits, two of the forks, the one that
/// leaves the least distorted; with no grips where there is none.
template <typename Scalar>
Emptied<Scalar> best_emptied(const CurveSkeleton<Scalar>& curve, const std::vector<Grip>& forks,
                             const std::vector<Grip>& others, const SkeletonTemplate& wanted,
                             const embedding::MatchingOptions& options) {
    Emptied<Scalar> best;
    const auto try_way = [&](const std::vector<const Grip*>& way) {
        auto without = emptied(curve, way, wanted, options);
        if (without && without->distortion < best.distortion) best = *std::move(without);
    };
    for (const Grip& grip : forks) try_way({&grip});
    for (const Grip& grip : others) try_way({&grip});
    if (!best.grips.empty()) return best;
    for (std::size_t i = 0; i < forks.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) try_way({&forks[k], &forks[i]});
    return best;
}

/// Of what is held the branch that leads on most nearly as the arm does, over so long a way.
template <typename Scalar>
std::size_t straightest(const CurveSkeleton<Scalar>& curve, const Grip& grip, Scalar way) {
    const Vector3<Scalar> hand = core::point(curve.nodes, grip.hand());
    const auto towards = [&](const std::vector<int>& branch) { // the first node so far away, or the last
        const auto there = std::find_if(branch.begin(), branch.end() - 1, [&](int node) {
            return (core::point(curve.nodes, node) - hand).norm() >= way;
        });
        return (core::point(curve.nodes, *there) - hand).stableNormalized();
    };
    const Vector3<Scalar> back = towards(grip.arm);
    std::vector<Scalar> bends;
    for (const std::vector<int>& branch : grip.held) bends.push_back(back.dot(towards(branch)));
    return static_cast<std::size_t>(std::min_element(bends.begin(), bends.end()) - bends.begin());
}

/// The body without what is held, cut where it leaves the hand's ball; `with_fingers`: of the branch that leads on from
/// the arm so much is left as the other hand goes on.
template <typename Scalar>
Body<Scalar> cut_off(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve, const Emptied<Scalar>& without,
                     bool with_fingers) {
    std::vector<bool> is_held(static_cast<std::size_t>(body.mesh.vertices.rows()), false);
    for (std::size_t i = 0; i < without.grips.size(); ++i) {
        const Grip& grip = *without.grips[i];
        const Scalar radius = curve.radii[static_cast<std::size_t>(grip.hand())];
        const Scalar fingers = with_fingers ? std::max(without.hands[i], radius) : radius;
        const std::size_t as_fingers = straightest(curve, grip, fingers);
        for (std::size_t b = 0; b < grip.held.size(); ++b)
            for (const int node : grip.held[b]) {
                const Scalar away = (core::point(curve.nodes, node) - core::point(curve.nodes, grip.hand())).norm();
                if (away <= (b == as_fingers ? fingers : radius)) continue;
                for (const int v : curve.regions[static_cast<std::size_t>(node)])
                    is_held[static_cast<std::size_t>(v)] = true;
            }
    }
    std::vector<bool> is_left_out(static_cast<std::size_t>(body.mesh.faces.rows()), false);
    for (Eigen::Index f = 0; f < body.mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            if (is_held[static_cast<std::size_t>(body.mesh.faces(f, k))])
                is_left_out[static_cast<std::size_t>(f)] = true;
    Body<Scalar> out = surface::without_faces(body, is_left_out);
    out.repairs.push_back("what is held in " + std::string(without.grips.size() == 1 ? "one hand" : "both hands") +
                          " taken off");
    return out;
}

} // namespace detail

template <typename Scalar>
std::vector<Body<Scalar>> without_held_things(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                                              const SkeletonTemplate& wanted,
                                              const embedding::MatchingOptions& options) {
    constexpr std::size_t most_forks = 5; // two hands, the legs, a head with horns, and one more
    if (core::cycle_count(curve) > 0) return {};
    const std::vector<detail::Grip> forks = detail::forks_at_ends(curve);
    if (forks.size() > most_forks) return {};
    const std::vector<detail::Grip> beyond = detail::beyond_equal_lengths(curve);
    const detail::Emptied<Scalar> hands = detail::best_emptied(curve, forks, beyond, wanted, options);
    if (hands.grips.empty()) return {};
    std::vector<Body<Scalar>> out;
    for (const bool with_fingers : {false, true}) out.push_back(detail::cut_off(body, curve, hands, with_fingers));
    return out;
}

} // namespace skelgen::search
