#pragma once

#include <skelgen/surface/weld.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/sort_by_number.hpp>

namespace skelgen::surface {
namespace detail {

/// How far along a direction a point lies in which hardly any points of a mesh lie level: none of a plane or of a
/// lattice along the axes, as of walls, scanned floors and voxels.
template <typename Scalar>
core::Accumulator along_odd_direction(const Points<Scalar>& points, int v) {
    const Vector3<core::Accumulator> direction(1, std::numbers::sqrt2, std::numbers::sqrt3);
    return core::point(points, v).template cast<core::Accumulator>().dot(direction.normalized());
}

/// Joins points no farther apart than `tolerance` (0: at equal places): a sweep along that direction.
template <typename Scalar>
core::DisjointSets near_points(const Points<Scalar>& points, const std::vector<int>& used, Scalar tolerance) {
    std::vector<std::pair<core::Accumulator, int>> order;
    order.reserve(used.size());
    core::Accumulator farthest = 0;
    for (const int v : used) {
        order.emplace_back(along_odd_direction(points, v), v);
        farthest = std::max(farthest, std::abs(order.back().first));
    }
    order = core::sorted_by_number(std::move(order));
    // What rounding leaves in a place along the direction must not part two points.
    const core::Accumulator reach =
        static_cast<core::Accumulator>(tolerance) + 16 * std::numeric_limits<core::Accumulator>::epsilon() * farthest;
    core::DisjointSets groups(static_cast<std::size_t>(points.rows()));
    std::vector<bool> is_copy(order.size(), false); // at the place of one before, which looks around for both
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (is_copy[i]) continue;
        const Vector3<Scalar> here = core::point(points, order[i].second);
        for (std::size_t j = i + 1; j < order.size() && order[j].first - order[i].first <= reach; ++j) {
            const Vector3<Scalar> there = core::point(points, order[j].second);
            if (here == there) is_copy[j] = true;
            if ((here - there).norm() <= tolerance)
                groups.unite(static_cast<std::size_t>(order[i].second), static_cast<std::size_t>(order[j].second));
        }
    }
    return groups;
}

} // namespace detail

template <typename Scalar>
Eigen::AlignedBox<Scalar, 3> robust_box(const TriangleMesh<Scalar>& mesh) {
    Eigen::AlignedBox<Scalar, 3> box;
    if (mesh.faces.rows() == 0) return box;
    constexpr Eigen::Index samples = 5000; // faces, evenly spread over the list
    const Eigen::Index stride = std::max<Eigen::Index>(1, mesh.faces.rows() / samples);
    std::vector<Scalar> along;
    for (int k = 0; k < 3; ++k) {
        along.clear();
        for (Eigen::Index f = 0; f < mesh.faces.rows(); f += stride)
            for (int c = 0; c < 3; ++c) along.push_back(mesh.vertices(mesh.faces(f, c), k));
        const auto low = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 20);
        const auto high = along.end() - 1 - static_cast<std::ptrdiff_t>(along.size() / 20);
        std::nth_element(along.begin(), low, along.end());
        box.min()[k] = *low;
        std::nth_element(low, high, along.end()); // all before are less
        box.max()[k] = *high;
    }
    return box;
}

template <typename Scalar>
std::optional<Triangles> faces_within_reach(const TriangleMesh<Scalar>& mesh, const Eigen::AlignedBox<Scalar, 3>& box) {
    const Scalar reach = box.diagonal().norm();
    std::vector<bool> is_near(static_cast<std::size_t>(mesh.vertices.rows()));
    for (std::size_t v = 0; v < is_near.size(); ++v)
        is_near[v] = box.exteriorDistance(core::point(mesh.vertices, static_cast<Eigen::Index>(v))) <= reach;
    if (std::all_of(is_near.begin(), is_near.end(), [](bool near) { return near; })) return std::nullopt;
    Triangles out(mesh.faces.rows(), 3);
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        bool near = true;
        for (int k = 0; k < 3; ++k) near = near && is_near[static_cast<std::size_t>(mesh.faces(f, k))];
        if (near) out.row(kept++) = mesh.faces.row(f);
    }
    if (kept == mesh.faces.rows()) return std::nullopt; // no face uses what is far
    out.conservativeResize(kept, 3);
    return out;
}

template <typename Scalar>
Welding find_welds(const TriangleMesh<Scalar>& mesh, Scalar tolerance, const std::vector<bool>& apart) {
    const auto n = static_cast<std::size_t>(mesh.vertices.rows());
    if (!apart.empty() && apart.size() != n)
        throw Error(ErrorCode::usage, "weld: `apart` has to have one entry for each vertex");
    std::vector<bool> is_used(n, false);
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) is_used[static_cast<std::size_t>(mesh.faces.data()[i])] = true;
    std::vector<int> used;
    used.reserve(n);
    for (std::size_t v = 0; v < n; ++v)
        if (is_used[v]) used.push_back(static_cast<int>(v));
    if (apart.empty()) {
        core::DisjointSets groups = detail::near_points(mesh.vertices, used, tolerance);
        return {std::move(used), std::move(groups)};
    }
    std::vector<int> loose = used;
    std::erase_if(loose, [&](int v) { return apart[static_cast<std::size_t>(v)]; });
    core::DisjointSets groups = detail::near_points(mesh.vertices, loose, tolerance);
    return {std::move(used), std::move(groups)};
}

template <typename Scalar>
WeldedMesh<Scalar> weld(const TriangleMesh<Scalar>& mesh, Welding welding) {
    const auto n = static_cast<std::size_t>(mesh.vertices.rows());
    const std::vector<int>& used = welding.used;
    const auto first_of = [&](int v) { return static_cast<int>(welding.groups.find(static_cast<std::size_t>(v))); };
    WeldedMesh<Scalar> out;
    out.placed.assign(n, -1);
    out.unused = static_cast<int>(n - used.size());
    int kept = 0;
    for (const int v : used) {
        const int first = first_of(v);
        out.placed[static_cast<std::size_t>(v)] = first == v ? kept++ : out.placed[static_cast<std::size_t>(first)];
    }
    out.welded = static_cast<int>(used.size()) - kept;
    out.mesh.vertices.resize(kept, 3);
    for (const int v : used)
        if (first_of(v) == v) out.mesh.vertices.row(out.placed[static_cast<std::size_t>(v)]) = mesh.vertices.row(v);
    out.mesh.faces = mesh.faces;
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i)
        out.mesh.faces.data()[i] = out.placed[static_cast<std::size_t>(mesh.faces.data()[i])];
    return out;
}

template <typename Scalar>
WeldedMesh<Scalar> weld(const TriangleMesh<Scalar>& mesh, Scalar tolerance, const std::vector<bool>& apart) {
    return weld(mesh, find_welds(mesh, tolerance, apart));
}

template <typename Scalar>
std::vector<bool> in_closed_pieces(const TriangleMesh<Scalar>& mesh, const std::vector<int>& placed) {
    constexpr int least_faces = 4; // a tetrahedron's; a triangle stored with both its sides has two
    const auto n = static_cast<std::size_t>(mesh.vertices.rows());
    core::DisjointSets joined(n);
    const auto vertex = [&](Eigen::Index f, int k) { return static_cast<std::size_t>(mesh.faces(f, k)); };
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 1; k < 3; ++k) joined.unite(vertex(f, 0), vertex(f, k));
    std::vector<int> faces(n, 0);
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) ++faces[joined.find(vertex(f, 0))];
    std::vector<bool> is_closed(n, false), is_copy(n, true);
    for (std::size_t piece = 0; piece < n; ++piece) is_closed[piece] = faces[piece] >= least_faces;
    const std::vector<core::DirectedEdge> edges = core::directed_edges(mesh.faces);
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        while (end < edges.size() && edges[end].joins_same(edges[i])) ++end;
        if (end - i != 2) is_closed[joined.find(static_cast<std::size_t>(edges[i].low))] = false;
        i = end;
    }
    std::vector<std::size_t> piece_at(n, n); // per place the one piece there, n + 1 for several
    const auto place_of = [&](std::size_t v) { return static_cast<std::size_t>(placed[v]); };
    for (std::size_t v = 0; v < n; ++v) {
        if (placed[v] < 0) continue;
        std::size_t& piece = piece_at[place_of(v)];
        piece = piece == n || piece == joined.find(v) ? joined.find(v) : n + 1;
    }
    for (std::size_t v = 0; v < n; ++v)
        if (placed[v] >= 0 && piece_at[place_of(v)] <= n) is_copy[joined.find(v)] = false;
    std::vector<bool> out(n, false);
    for (std::size_t v = 0; v < n; ++v) out[v] = is_closed[joined.find(v)] && !is_copy[joined.find(v)];
    return out;
}

} // namespace skelgen::surface
