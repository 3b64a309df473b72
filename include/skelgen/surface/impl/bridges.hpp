#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <nanoflann.hpp>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/manifold_parts.hpp>

namespace skelgen::surface {

namespace detail {

/// One of a body's closed parts, and what finds its vertices.
template <typename Scalar>
struct BridgedPart {
    using Tree = nanoflann::KDTreeEigenMatrixAdaptor<Points<Scalar>, 3, nanoflann::metric_L2_Simple>;

    explicit BridgedPart(const TriangleMesh<Scalar>& mesh)
        : vertices(&mesh.vertices), tree(std::make_unique<Tree>(3, mesh.vertices)), volume(core::enclosed_volume(mesh)),
          thickness(6 * volume / core::surface_area(mesh)) {}

    /// The vertex nearest to a place, and how far it is.
    [[nodiscard]] std::pair<Vector3<Scalar>, Scalar> nearest(const Vector3<Scalar>& place) const {
        Eigen::Index index = 0;
        Scalar squared = 0;
        nanoflann::KNNResultSet<Scalar, Eigen::Index> result(1);
        result.init(&index, &squared);
        tree->index->findNeighbors(result, place.data(), nanoflann::SearchParams());
        return {core::point(*vertices, index), std::sqrt(squared)};
    }

    const Points<Scalar>* vertices;
    std::unique_ptr<Tree> tree;
    Scalar volume, thickness; ///< the diameter of a ball with as much volume for its area
};

/// Where two parts lie nearest: the middles of the two sides.
template <typename Scalar>
struct Gap {
    Vector3<Scalar> from, to;
    Scalar width = 0;
};

template <typename Scalar>
Gap<Scalar> gap_between(const BridgedPart<Scalar>& one, const BridgedPart<Scalar>& other) {
    constexpr Scalar as_narrow = Scalar(0.15); // of the slighter part's thickness
    std::vector<std::pair<Vector3<Scalar>, Scalar>> found;
    Gap<Scalar> out;
    out.width = std::numeric_limits<Scalar>::infinity();
    for (Eigen::Index v = 0; v < one.vertices->rows(); ++v) {
        found.push_back(other.nearest(core::point(*one.vertices, v)));
        out.width = std::min(out.width, found.back().second);
    }
    const Scalar most = out.width + as_narrow * std::min(one.thickness, other.thickness);
    Scalar count = 0;
    out.from = out.to = Vector3<Scalar>::Zero();
    for (Eigen::Index v = 0; v < one.vertices->rows(); ++v) {
        const auto& [place, distance] = found[static_cast<std::size_t>(v)];
        if (distance > most) continue;
        out.from += core::point(*one.vertices, v);
        out.to += place;
        ++count;
    }
    out.from /= count;
    out.to /= count;
    return out;
}

/// A closed prism around the way from one place to another, that reaches beyond both by its radius.
template <typename Scalar>
TriangleMesh<Scalar> prism(const Vector3<Scalar>& from, const Vector3<Scalar>& to, Scalar radius) {
    constexpr int sides = 8;
    const Vector3<Scalar> along = (to - from).stableNormalized();
    const Vector3<Scalar> across = along.unitOrthogonal(), third = along.cross(across);
    TriangleMesh<Scalar> out;
    out.vertices.resize(2 * sides, 3);
    for (int k = 0; k < sides; ++k) {
        const Scalar angle = Scalar(2 * std::numbers::pi * k / sides);
        const Vector3<Scalar> rim = radius * (std::cos(angle) * across + std::sin(angle) * third);
        core::set_point<Scalar>(out.vertices, k, from - radius * along + rim);
        core::set_point<Scalar>(out.vertices, sides + k, to + radius * along + rim);
    }
    out.faces.resize(4 * sides - 4, 3);
    Eigen::Index row = 0;
    for (int k = 0; k < sides; ++k) {
        const int next = (k + 1) % sides;
        out.faces.row(row++) << k, next, sides + next;
        out.faces.row(row++) << k, sides + next, sides + k;
    }
    for (int k = 1; k + 1 < sides; ++k) {
        out.faces.row(row++) << 0, k + 1, k;
        out.faces.row(row++) << sides, sides + k, sides + k + 1;
    }
    return out;
}

} // namespace detail

/// What joins the closed parts of a body that do not touch: legs of boxes below a trunk, a head that floats above it.
/// The parts are taken into one from the largest on, always that with the narrowest gap, by a prism between the middles
/// of the two sides where the gap is about as narrow as that, half as wide as the slighter part is thick. Parts of less
/// than a hundredth of the largest one's volume, and gaps wider than a part is thick, stay. \returns the prisms, as
/// closed surfaces that look outwards and reach into both parts; none where nothing is to be joined. Any unit.
/// O(k^2 n log n) for the k <= 24 largest parts.
template <typename Scalar>
std::vector<TriangleMesh<Scalar>> bridges_between(const std::vector<TriangleMesh<Scalar>>& meshes) {
    constexpr std::size_t most_parts = 24;
    constexpr Scalar least_volume = Scalar(0.01);                     // of the largest part's
    constexpr Scalar widest = Scalar(1), half_as_wide = Scalar(0.25); // of the slighter part's thickness
    std::vector<detail::BridgedPart<Scalar>> parts;
    for (const TriangleMesh<Scalar>& mesh : meshes)
        if (core::enclosed_volume(mesh) > 0) parts.emplace_back(mesh);
    std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.volume > b.volume; });
    if (parts.size() > most_parts) parts.erase(parts.begin() + most_parts, parts.end());
    while (parts.size() > 1 && parts.back().volume < least_volume * parts.front().volume) parts.pop_back();

    // Prim's minimum spanning tree.
    std::vector<TriangleMesh<Scalar>> out;
    struct Way {
        detail::Gap<Scalar> gap;
        Scalar thickness = 0;
    };
    std::vector<std::optional<Way>> ways(parts.size()); // to those not yet joined, from what is
    std::size_t last = 0;
    std::vector<bool> is_joined(parts.size(), false);
    for (std::size_t round = 1; round < parts.size(); ++round) {
        is_joined[last] = true;
        std::optional<std::size_t> next;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (is_joined[i]) continue;
            const Way way{detail::gap_between(parts[i], parts[last]),
                          std::min(parts[i].thickness, parts[last].thickness)};
            if (!ways[i] || way.gap.width < ways[i]->gap.width) ways[i] = way;
            if (!next || ways[i]->gap.width < ways[*next]->gap.width) next = i;
        }
        const Way& way = *ways[*next];
        if (way.gap.width <= widest * way.thickness)
            out.push_back(detail::prism(way.gap.from, way.gap.to, half_as_wide * way.thickness));
        last = *next;
    }
    return out;
}

} // namespace skelgen::surface
