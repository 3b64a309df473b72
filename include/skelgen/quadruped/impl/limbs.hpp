#pragma once

#include <skelgen/quadruped/limbs.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/quadruped/trust_table.hpp>

namespace skelgen::quadruped {
namespace detail {

using embedding::detail::at;

/// Which end is what: numbers of ends, -1 for a tail that is not there.
struct Roles {
    std::array<int, 2> fore{}, hind{};
    int head = 0, tail = -1;
};

/// The ends of a curve, how far they are from each other, and how thick the body is at each.
template <typename Scalar>
struct Ends {
    std::vector<int> nodes;
    std::vector<core::ShortestPaths<Scalar>> ways; ///< from each
    std::vector<Scalar> thickness;
    int all = 0; ///< of the curve, with those that do not take part

    [[nodiscard]] Scalar distance(int a, int b) const { return ways[at(a)].distance[at(nodes[at(b)])]; }

    /// How far an end is from the way between two others, on a tree.
    [[nodiscard]] Scalar off(int end, int a, int b) const {
        return (distance(end, a) + distance(end, b) - distance(a, b)) / 2;
    }
};

/// Of two ends or more the `most_ends` that add most to the tree between them.
template <typename Scalar>
Ends<Scalar> chosen_ends(const CurveSkeleton<Scalar>& curve, const core::CurveGraph<Scalar>& graph) {
    Ends<Scalar> all, out;
    for (int v = 0; v < graph.size(); ++v)
        if (graph.degree(v) == 1) {
            all.nodes.push_back(v);
            all.ways.push_back(core::shortest_paths(graph, v));
        }
    const auto count = static_cast<int>(all.nodes.size());
    std::vector<int> chosen{0, 1};
    for (int a = 0; a < count; ++a)
        for (int b = 0; b < a; ++b)
            if (all.distance(b, a) > all.distance(chosen[0], chosen[1])) chosen = {b, a};
    const Scalar diameter = all.distance(chosen[0], chosen[1]);
    while (chosen.size() < std::min(most_ends, at(count))) {
        int best = -1;
        Scalar farthest = 0;
        for (int end = 0; end < count; ++end) {
            if (std::find(chosen.begin(), chosen.end(), end) != chosen.end()) continue;
            Scalar off = all.off(end, chosen[0], chosen[1]);
            for (std::size_t a = 0; a < chosen.size(); ++a)
                for (std::size_t b = 0; b < a; ++b) off = std::min(off, all.off(end, chosen[a], chosen[b]));
            if (best >= 0 && off <= farthest) continue;
            best = end;
            farthest = off;
        }
        chosen.push_back(best);
    }
    constexpr auto reach = static_cast<Scalar>(0.1); // of the diameter
    out.all = count;
    for (const int end : chosen) {
        Scalar sum = 0, near = 0;
        for (int v = 0; v < graph.size(); ++v)
            if (all.ways[at(end)].distance[at(v)] < reach * diameter) {
                sum += curve.radii[at(v)];
                near += 1;
            }
        out.nodes.push_back(all.nodes[at(end)]);
        out.ways.push_back(std::move(all.ways[at(end)]));
        out.thickness.push_back(sum / std::max(near, Scalar(1)));
    }
    return out;
}

template <typename Scalar>
double log_ratio(Scalar a, Scalar b, Scalar least) {
    return std::log(static_cast<double>((a + least) / (b + least)));
}

/// What a choice of ends shows along the curve alone, and how much it costs: cheap numbers that put off what is no
/// animal, so that the rest may be looked at closely.
template <typename Scalar>
std::pair<Evidence, double> along(const Ends<Scalar>& ends, const Roles& roles, Scalar diameter, Scalar& size) {
    const auto& [fore, hind, head, tail] = roles;
    const auto between = [&, &hind = hind](int end, int other) { // mean over both hind legs
        return (ends.off(end, other, hind[0]) + ends.off(end, other, hind[1])) / 2;
    };
    const Scalar least = static_cast<Scalar>(1e-3) * diameter;
    const std::array legs{between(fore[0], head), between(fore[1], head), ends.off(hind[0], hind[1], head),
                          ends.off(hind[1], hind[0], head)};
    const std::array shoulders{between(head, fore[0]), between(head, fore[1])};
    const Scalar neck = (shoulders[0] + shoulders[1]) / 2, hips = ends.off(head, hind[0], hind[1]);
    const Scalar leg = std::accumulate(legs.begin(), legs.end(), Scalar(0)) / 4;
    size = std::max(hips - neck, least) + leg;
    const auto part = [&](Scalar length) { return static_cast<double>(length / size); };
    Evidence out;
    using enum Witness;
    out[fore_lengths] = std::abs(log_ratio(legs[0], legs[1], least));
    out[hind_lengths] = std::abs(log_ratio(legs[2], legs[3], least));
    out[fore_to_hind] = log_ratio(legs[0] + legs[1], legs[2] + legs[3], least);
    out[fore_apart] = part(std::abs(shoulders[0] - shoulders[1]));
    out[trunk_length] = part(hips - neck);
    out[neck_length] = part(neck);
    out[lacks_tail] = tail < 0 ? 1 : 0;
    if (tail >= 0) {
        out[tail_length] = part(ends.off(tail, hind[0], hind[1]));
        out[tail_apart] = part(hips - std::min(hips, between(head, tail)));
        out[tail_to_head] = log_ratio(ends.thickness[at(tail)], ends.thickness[at(head)], least);
    }
    for (int end = 0; end < static_cast<int>(ends.nodes.size()); ++end) {
        if (end == fore[0] || end == fore[1] || end == hind[0] || end == hind[1] || end == head || end == tail)
            continue;
        Scalar off =
            std::min({ends.off(end, fore[0], fore[1]), ends.off(end, hind[0], hind[1]), ends.off(end, fore[0], head),
                      ends.off(end, hind[0], head), ends.off(end, hind[1], head)});
        if (tail >= 0) off = std::min({off, ends.off(end, tail, head), ends.off(end, tail, hind[0])});
        constexpr auto of_neck = static_cast<Scalar>(0.7); // nearer to its end a branch is the head's
        const bool is_heads = between(head, end) < of_neck * neck;
        double& longest = out[is_heads ? unmatched_head : unmatched];
        longest = std::max(longest, part(off));
        if (!is_heads && part(off) > 0.1) out[unmatched_many] += 1;
    }
    out[end_count] = ends.all;
    const auto thickness = [&](int end) { return ends.thickness[at(end)]; };
    out[fore_ends] = std::abs(log_ratio(thickness(fore[0]), thickness(fore[1]), least));
    out[hind_ends] = std::abs(log_ratio(thickness(hind[0]), thickness(hind[1]), least));
    const Scalar fore_feet = thickness(fore[0]) + thickness(fore[1]),
                 hind_feet = thickness(hind[0]) + thickness(hind[1]);
    out[head_to_feet] = log_ratio(thickness(head), (fore_feet + hind_feet) / 4, least);
    out[fore_to_hind_ends] = log_ratio(fore_feet, hind_feet, least);
    const auto lacking = [](double value, double wanted) { return std::max(0.0, wanted - value); };
    const double cost = out[fore_lengths] + out[hind_lengths] + std::abs(out[fore_to_hind]) / 2 + 2 * out[fore_apart] +
                        3 * lacking(out[trunk_length], 0.25) + 2 * lacking(out[neck_length], 0.2) + 2 * out[unmatched] +
                        0.3 * out[unmatched_head] + 0.2 * out[lacks_tail] + (out[fore_ends] + out[hind_ends]) / 2 +
                        lacking(out[head_to_feet], 0);
    return {out, cost};
}

/// How far forward of its straight line a way lies, on the average of its lower, middle and upper third.
template <typename Scalar>
std::array<double, 3> bends(const CurveSkeleton<Scalar>& curve, const std::vector<int>& way,
                            const Vector3<Scalar>& forward, Scalar size) {
    if (way.size() < 4) return {};
    const Vector3<Scalar> start = core::point(curve.nodes, way.front()),
                          chord = core::point(curve.nodes, way.back()) - start;
    const Scalar square = std::max(chord.squaredNorm(), std::numeric_limits<Scalar>::min());
    const std::size_t third = std::max<std::size_t>(1, way.size() / 3);
    std::array<double, 3> sum{}, count{};
    for (std::size_t i = 0; i < way.size(); ++i) {
        const Vector3<Scalar> off = core::point(curve.nodes, way[i]) - start;
        const std::size_t part = std::min<std::size_t>(2, i / third);
        sum[part] += static_cast<double>((off - chord * (off.dot(chord) / square)).dot(forward) / size);
        count[part] += 1;
    }
    for (std::size_t part = 0; part < 3; ++part) sum[part] /= std::max(count[part], 1.0);
    return sum;
}

template <typename Scalar>
Scalar mean_radius(const CurveSkeleton<Scalar>& curve, const std::vector<int>& way, std::size_t nodes) {
    Scalar sum = 0;
    const std::size_t count = std::min(way.size(), std::max<std::size_t>(1, nodes));
    for (std::size_t i = 0; i < count; ++i) sum += curve.radii[at(way[i])];
    return sum / static_cast<Scalar>(count);
}

/// How many nodes two ways from the same start share.
inline std::size_t shared_nodes(const std::vector<int>& a, const std::vector<int>& b) {
    return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

/// The ways along the curve between the ends of an animal. The fore legs leave the trunk where they leave the way from
/// head to hips, the trunk ends in the middle between these places.
template <typename Scalar>
Limbs<Scalar> ways_of(const Ends<Scalar>& ends, const Roles& roles) {
    Limbs<Scalar> out;
    const auto from_head = [&](int end) { return ends.ways[at(roles.head)].path_to(ends.nodes[at(end)]); };
    const std::array hind{from_head(roles.hind[0]), from_head(roles.hind[1])};
    const std::size_t to_hips = shared_nodes(hind[0], hind[1]);
    std::array<std::size_t, 2> to_shoulder{};
    for (std::size_t side = 0; side < 2; ++side) {
        const std::vector<int> fore = from_head(roles.fore[side]);
        to_shoulder[side] = std::min(shared_nodes(fore, hind[0]), to_hips);
        out.legs[side].assign(fore.rbegin(), fore.rend() - static_cast<std::ptrdiff_t>(to_shoulder[side] - 1));
        out.legs[2 + side].assign(hind[side].rbegin(), hind[side].rend() - static_cast<std::ptrdiff_t>(to_hips - 1));
    }
    std::size_t shoulders = (to_shoulder[0] + to_shoulder[1]) / 2;
    if (shoulders == to_hips && to_hips > 1) --shoulders; // a trunk has a length
    const auto begin = hind[0].begin();
    out.neck.assign(begin, begin + static_cast<std::ptrdiff_t>(shoulders));
    out.trunk.assign(begin + static_cast<std::ptrdiff_t>(shoulders - 1), begin + static_cast<std::ptrdiff_t>(to_hips));
    std::reverse(out.neck.begin(), out.neck.end());
    std::reverse(out.trunk.begin(), out.trunk.end());
    if (roles.tail >= 0) {
        out.tail = ends.ways[at(roles.tail)].path_to(out.trunk.front());
        std::reverse(out.tail.begin(), out.tail.end());
    }
    return out;
}

/// The animal's directions: forward from hips to shoulders, down where the legs point across that.
template <typename Scalar>
BodyFrame<Scalar> frame_of(const CurveSkeleton<Scalar>& curve, const Limbs<Scalar>& limbs) {
    BodyFrame<Scalar> out;
    out.origin = core::point(curve.nodes, limbs.trunk.front());
    out.forward = (core::point(curve.nodes, limbs.trunk.back()) - out.origin).normalized();
    Vector3<Scalar> up = Vector3<Scalar>::Zero();
    for (const std::vector<int>& leg : limbs.legs)
        up += (core::point(curve.nodes, leg.back()) - core::point(curve.nodes, leg.front())).normalized();
    out.up = (up - out.forward * up.dot(out.forward)).normalized();
    out.left = out.up.cross(out.forward);
    return out;
}

/// Adds to the evidence what places and radii show.
template <typename Scalar>
void add_directions(Evidence& out, const CurveSkeleton<Scalar>& curve, const Limbs<Scalar>& limbs) {
    using enum Witness;
    const auto& [origin, left, forward, up] = limbs.frame;
    const auto place = [&](int node) { return core::point(curve.nodes, node); };
    const auto cosine = [](const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
        return static_cast<double>(a.normalized().dot(b.normalized()));
    };
    std::array<Vector3<Scalar>, 4> way;
    std::array<double, 4> down{};
    double along_trunk = 0, straight = 0, girth = 0, toe = 0;
    for (std::size_t leg = 0; leg < 4; ++leg) {
        const std::vector<int>& nodes = limbs.legs[leg];
        const Vector3<Scalar> whole = place(nodes.front()) - place(nodes.back());
        way[leg] = whole.normalized();
        down[leg] = -static_cast<double>(way[leg].dot(up));
        along_trunk += std::abs(static_cast<double>(way[leg].dot(forward))) / 4;
        const Scalar length = core::path_length(curve, nodes);
        straight += length > 0 ? static_cast<double>(whole.norm() / length) / 4 : 0;
        girth += static_cast<double>(mean_radius(curve, nodes, nodes.size() * 2 / 3)) / 4;
        toe += cosine(place(nodes.front()) - place(nodes[std::min<std::size_t>(3, nodes.size() - 1)]), forward) / 4;
    }
    out[fore_parallel] = cosine(way[0], way[1]);
    out[hind_parallel] = cosine(way[2], way[3]);
    out[legs_parallel] = cosine(way[0] + way[1], way[2] + way[3]);
    out[legs_along] = along_trunk;
    out[legs_down] = std::accumulate(down.begin(), down.end(), 0.0) / 4;
    out[least_down] = *std::min_element(down.begin(), down.end());
    out[legs_straight] = straight;
    out[toes] = toe;
    const Vector3<Scalar> shoulders = place(limbs.trunk.back());
    const Scalar along_curve = core::path_length(curve, limbs.trunk);
    out[trunk_straight] = along_curve > 0 ? static_cast<double>((shoulders - origin).norm() / along_curve) : 0;
    out[head_forward] = cosine(place(limbs.neck.back()) - shoulders, forward);
    out[head_up] = cosine(place(limbs.neck.back()) - shoulders, up);
    if (!limbs.tail.empty()) {
        out[tail_back] = -cosine(place(limbs.tail.back()) - origin, forward);
        out[tail_up] = cosine(place(limbs.tail.back()) - origin, up);
    }
    constexpr auto least = static_cast<Scalar>(1e-6);
    const Scalar trunk_radius = mean_radius(curve, limbs.trunk, limbs.trunk.size());
    out[trunk_girth] = log_ratio(trunk_radius / limbs.size, Scalar(1), least);
    out[leg_girth] = log_ratio(static_cast<Scalar>(girth), trunk_radius, least * limbs.size);
    out[neck_girth] = log_ratio(mean_radius(curve, limbs.neck, limbs.neck.size()), trunk_radius, least * limbs.size);
    const auto sideways = [&, &left = left](int leg) {
        return static_cast<double>(place(limbs.legs[at(leg)].front()).dot(left) / limbs.size);
    };
    const double fore = sideways(left_fore) - sideways(right_fore), hind = sideways(left_hind) - sideways(right_hind);
    out[fore_width] = std::abs(fore);
    out[hind_width] = std::abs(hind);
    for (std::size_t leg = 0; leg < 4; ++leg) {
        const std::array<double, 3> bend = bends(curve, limbs.legs[leg], forward, limbs.size);
        const auto first = static_cast<std::size_t>(leg < 2 ? fore_lower_bend : hind_lower_bend);
        for (std::size_t part = 0; part < 3; ++part) out.values[first + part] += bend[part] / 2;
    }
}

/// Both legs of a pair, the left one first: by where they are beyond the foot, which may cross to the other side.
template <typename Scalar>
void tell_sides(Limbs<Scalar>& limbs, const CurveSkeleton<Scalar>& curve) {
    const auto sideways = [&](const std::vector<int>& leg) {
        Scalar sum = 0;
        const std::size_t first = leg.size() * 2 / 5;
        for (std::size_t i = first; i < leg.size(); ++i) sum += core::point(curve.nodes, leg[i]).dot(limbs.frame.left);
        return sum / static_cast<Scalar>(leg.size() - first);
    };
    for (const int leg : {left_fore, left_hind})
        if (sideways(limbs.legs[at(leg)]) < sideways(limbs.legs[at(leg + 1)]))
            std::swap(limbs.legs[at(leg)], limbs.legs[at(leg + 1)]);
}

/// All choices of roles that are not too odd along the curve, the cheapest first.
template <typename Scalar>
std::vector<Roles> cheapest_roles(const Ends<Scalar>& ends, Scalar diameter) {
    constexpr std::size_t most_looked_at = 150; // 60 of 62 animals have a right one among them
    const auto count = static_cast<int>(ends.nodes.size());
    std::vector<std::pair<double, Roles>> found;
    const auto is_free = [](const Roles& roles, int end, bool with_head) {
        return end != roles.fore[0] && end != roles.fore[1] && end != roles.hind[0] && end != roles.hind[1] &&
               !(with_head && end == roles.head);
    };
    Roles roles;
    const auto try_tails = [&] {
        for (roles.tail = -1; roles.tail < count; ++roles.tail) {
            if (roles.tail >= 0 && !is_free(roles, roles.tail, true)) continue;
            Scalar size = 0;
            found.emplace_back(along(ends, roles, diameter, size).second, roles);
        }
    };
    for (roles.fore[0] = 0; roles.fore[0] < count; ++roles.fore[0])
        for (roles.fore[1] = 0; roles.fore[1] < roles.fore[0]; ++roles.fore[1])
            for (roles.hind[0] = 0; roles.hind[0] < count; ++roles.hind[0])
                for (roles.hind[1] = 0; roles.hind[1] < roles.hind[0]; ++roles.hind[1]) {
                    const auto& [fore, hind, head, tail] = roles;
                    if (hind[0] == fore[0] || hind[0] == fore[1] || hind[1] == fore[0] || hind[1] == fore[1]) continue;
                    for (roles.head = 0; roles.head < count; ++roles.head)
                        if (is_free(roles, roles.head, false)) try_tails();
                }
    const std::size_t kept = std::min(found.size(), most_looked_at);
    const auto is_cheaper = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::stable_sort(found.begin(), found.end(), is_cheaper);
    std::vector<Roles> out;
    for (std::size_t i = 0; i < kept; ++i) out.push_back(found[i].second);
    return out;
}

} // namespace detail

SKELGEN_INLINE std::string_view to_string(Witness witness) {
    static constexpr std::array<std::string_view, witness_count> names{
        "fore_lengths",     "hind_lengths",      "fore_to_hind",
        "fore_apart",       "trunk_length",      "neck_length",
        "tail_length",      "tail_apart",        "lacks_tail",
        "unmatched",        "unmatched_many",    "unmatched_head",
        "end_count",        "fore_ends",         "hind_ends",
        "head_to_feet",     "fore_to_hind_ends", "tail_to_head",
        "trunk_girth",      "leg_girth",         "neck_girth",
        "fore_parallel",    "hind_parallel",     "legs_parallel",
        "legs_along",       "legs_down",         "least_down",
        "legs_straight",    "trunk_straight",    "head_forward",
        "head_up",          "tail_back",         "tail_up",
        "fore_width",       "hind_width",        "fore_lower_bend",
        "fore_middle_bend", "fore_upper_bend",   "hind_lower_bend",
        "hind_middle_bend", "hind_upper_bend",   "toes"};
    return names[static_cast<std::size_t>(witness)];
}

SKELGEN_INLINE double probability_right(const Evidence& evidence) {
    double log_odds = trust_offset;
    for (std::size_t w = 0; w < witness_count; ++w)
        log_odds += trust_weights[w] * (evidence.values[w] - trust_means[w]);
    return core::logistic(log_odds + voices_of(trust_trees, evidence.values));
}

template <typename Scalar>
std::vector<Limbs<Scalar>> find_limbs(const CurveSkeleton<Scalar>& curve, std::size_t most) {
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    std::vector<Limbs<Scalar>> out;
    const int count = core::end_count(curve);
    if (core::component_count(curve) != 1 || count < 5 || count > embedding::most_reduced_nodes) return out;
    const detail::Ends<Scalar> ends = detail::chosen_ends(curve, graph);
    const Scalar diameter = ends.distance(0, 1);
    if (!(diameter > 0)) return out;
    for (const detail::Roles& roles : detail::cheapest_roles(ends, diameter)) {
        Limbs<Scalar> limbs = detail::ways_of(ends, roles);
        limbs.evidence = detail::along(ends, roles, diameter, limbs.size).first;
        if (limbs.trunk.size() < 2) continue;
        limbs.frame = detail::frame_of(curve, limbs);
        detail::add_directions(limbs.evidence, curve, limbs);
        detail::tell_sides(limbs, curve);
        limbs.probability = probability_right(limbs.evidence);
        out.push_back(std::move(limbs));
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const auto& a, const auto& b) { return a.probability > b.probability; });
    if (out.size() > most) out.resize(most);
    return out;
}

} // namespace skelgen::quadruped
