#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <vector>

#include <Eigen/Core>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/min_cut.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

namespace detail {

/// An edge of the surface, and how long a line is that crosses it from the middle of one of its faces to the other's.
struct CrossedEdge {
    std::size_t a, b; ///< vertices
    double length;
};

template <typename Scalar>
std::vector<CrossedEdge> crossed_edges(const Body<Scalar>& body) {
    const Triangles& faces = body.mesh.faces;
    const auto corner = [&](Eigen::Index f, int k) { return core::point(body.mesh.vertices, faces(f, k % 3)); };
    const auto way_over = [&](Eigen::Index f, const Vector3<Scalar>& middle) {
        return static_cast<double>(((corner(f, 0) + corner(f, 1) + corner(f, 2)) / Scalar(3) - middle).norm());
    };
    std::vector<CrossedEdge> out;
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int other = body.adjacency(f, k);
            if (other >= 0 && other < f) continue; // found from there
            const Vector3<Scalar> middle = (corner(f, k) + corner(f, k + 1)) / Scalar(2);
            out.push_back({static_cast<std::size_t>(faces(f, k)), static_cast<std::size_t>(faces(f, (k + 1) % 3)),
                           way_over(f, middle) + (other >= 0 ? way_over(other, middle) : 0)});
        }
    return out;
}

/// Labels, and how much of each there is where.
struct SharedLabels {
    std::vector<int> labels;
    const Eigen::MatrixX<core::Accumulator>& shares;
    std::vector<double> largest; ///< share of each label
    const std::vector<int>& mirrored;

    [[nodiscard]] double share(std::size_t v, int label) const {
        return static_cast<double>(shares(static_cast<Eigen::Index>(v), label));
    }
};

using LabelPair = std::array<int, 2>;

/// May this vertex go from the one to the other? There is some of both in it, it is not in its label's core, and is
/// nearer to neither's mirror image.
inline bool is_free(const SharedLabels& shared, const LabelPair& pair, std::size_t v) {
    constexpr double some = 0.03; // left of a label three lengths beyond its border
    constexpr double core = 0.8;  // that share of its largest one: about a length from the border where it is large
    const int own = shared.labels[v];
    if (own != pair[0] && own != pair[1]) return false;
    if (shared.share(v, own) > core * shared.largest[static_cast<std::size_t>(own)]) return false;
    return std::all_of(pair.begin(), pair.end(), [&](int label) {
        const int other = shared.mirrored[static_cast<std::size_t>(label)];
        return shared.share(v, label) > some && shared.share(v, other) <= shared.share(v, label);
    });
}

/// Numbers vertices in the order in which they are met.
class MetVertices {
public:
    std::size_t number_of(std::size_t v) {
        const auto [at, is_new] = number_of_.try_emplace(v, met_.size());
        if (is_new) met_.push_back(v);
        return at->second;
    }
    [[nodiscard]] const std::vector<std::size_t>& met() const { return met_; }

private:
    std::vector<std::size_t> met_;
    std::map<std::size_t, std::size_t> number_of_;
};

/// Parts two labels anew: the cheapest cut between what is held by the one and by the other.
inline void part_anew(SharedLabels& shared, const LabelPair& pair, const std::vector<CrossedEdge>& edges,
                      const std::vector<double>& resistance) {
    constexpr double held = 1e6; // more than all borders of a body, whose area is 1
    const auto is_of = [&](std::size_t v) { return shared.labels[v] == pair[0] || shared.labels[v] == pair[1]; };
    MetVertices vertices;
    std::vector<CrossedEdge> numbered;
    for (const CrossedEdge& edge : edges)
        if (is_of(edge.a) && is_of(edge.b) && (is_free(shared, pair, edge.a) || is_free(shared, pair, edge.b)))
            numbered.push_back({vertices.number_of(edge.a), vertices.number_of(edge.b), edge.length});
    const std::vector<std::size_t>& met = vertices.met();
    const std::size_t first = met.size(), second = first + 1;
    core::CutNetwork network(met.size() + 2);
    for (const CrossedEdge& edge : numbered) network.join(edge.a, edge.b, edge.length, edge.length);
    for (std::size_t i = 0; i < met.size(); ++i) {
        const std::size_t v = met[i];
        const auto bond = [&](int label) {
            if (is_free(shared, pair, v)) return resistance[v] * shared.share(v, label);
            return shared.labels[v] == label ? held : 0.0;
        };
        network.join(first, i, bond(pair[0]), 0);
        network.join(i, second, bond(pair[1]), 0);
    }
    const std::vector<bool> is_first = network.source_side(first, second);
    for (std::size_t i = 0; i < met.size(); ++i) shared.labels[met[i]] = is_first[i] ? pair[0] : pair[1];
}

} // namespace detail

/// Labels whose borders are short: each two that meet are parted anew where the line between them, over the surface, is
/// shortest, by the cheapest cut (KT03). A vertex resists, by its area over `length`, as much as there is of its label
/// in it; the core of each label stays, so none is lost, and what is nearer to a label's mirror image does not go to
/// it. `labels`, n, and `shares`, n x count, as from `part_shares` over that `length`, in the body's unit; `mirrored`,
/// count: per label the one on the other side, or itself. O(n pairs) and what the cuts take, nearly linear in the
/// vertices near borders.
template <typename Scalar>
std::vector<int> with_short_borders(const Body<Scalar>& body, std::vector<int> labels,
                                    const Eigen::MatrixX<core::Accumulator>& shares, double length,
                                    const std::vector<int>& mirrored) {
    const Eigen::VectorX<core::Accumulator> areas = core::vertex_areas(body.mesh);
    std::vector<double> resistance;
    for (const core::Accumulator area : areas) resistance.push_back(static_cast<double>(area) / length);
    const std::vector<detail::CrossedEdge> edges = detail::crossed_edges(body);
    std::set<detail::LabelPair> pairs;
    for (const detail::CrossedEdge& edge : edges)
        if (labels[edge.a] != labels[edge.b])
            pairs.insert({std::min(labels[edge.a], labels[edge.b]), std::max(labels[edge.a], labels[edge.b])});
    detail::SharedLabels shared{std::move(labels), shares, {}, mirrored};
    for (Eigen::Index label = 0; label < shares.cols(); ++label)
        shared.largest.push_back(static_cast<double>(shares.col(label).maxCoeff()));
    for (const detail::LabelPair& pair : pairs) detail::part_anew(shared, pair, edges, resistance);
    return std::move(shared.labels);
}

} // namespace skelgen::applications
