#pragma once

#include <skelgen/surface/manifold_parts.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::surface {
namespace detail {

class DisjointSets {
public:
    explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

    std::size_t find(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void unite(std::size_t a, std::size_t b) {
        a = find(a);
        b = find(b);
        if (a != b) parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::size_t> parent_;
};

/// A directed edge u -> v of a face and the corner (3 f + k) it starts at.
struct DirectedEdge {
    int low, high;
    std::size_t corner;
    bool forward; ///< runs from low to high
};

inline std::vector<DirectedEdge> directed_edges(const Triangles& faces) {
    std::vector<DirectedEdge> edges;
    edges.reserve(static_cast<std::size_t>(faces.rows()) * 3);
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int u = faces(f, k), v = faces(f, (k + 1) % 3);
            edges.push_back({std::min(u, v), std::max(u, v), static_cast<std::size_t>(3 * f + k), u < v});
        }
    std::sort(edges.begin(), edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
        if (a.low != b.low) return a.low < b.low;
        if (a.high != b.high) return a.high < b.high;
        return a.corner < b.corner;
    });
    return edges;
}

inline std::size_t next_corner(std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

} // namespace detail

template <typename Scalar>
ManifoldParts<Scalar> largest_manifold_part(const TriangleMesh<Scalar>& mesh) {
    const auto corners = static_cast<std::size_t>(mesh.faces.rows()) * 3;
    const auto vertex_at = [&](std::size_t corner) {
        return mesh.faces(static_cast<Eigen::Index>(corner / 3), static_cast<Eigen::Index>(corner % 3));
    };
    const auto repeats_a_vertex = [&](Eigen::Index f) {
        return mesh.faces(f, 0) == mesh.faces(f, 1) || mesh.faces(f, 1) == mesh.faces(f, 2) ||
               mesh.faces(f, 2) == mesh.faces(f, 0);
    };

    detail::DisjointSets same_vertex(corners), same_piece(corners / 3);
    const std::vector<detail::DirectedEdge> edges = detail::directed_edges(mesh.faces);
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
        if (end - i == 2 && edges[i].forward != edges[i + 1].forward) {
            const std::size_t a = edges[i].corner, b = edges[i + 1].corner;
            same_vertex.unite(a, detail::next_corner(b));
            same_vertex.unite(detail::next_corner(a), b);
            same_piece.unite(a / 3, b / 3);
        }
        i = end;
    }

    std::vector<core::Accumulator> piece_area(corners / 3, 0);
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        piece_area[same_piece.find(static_cast<std::size_t>(f))] += core::face_area_vector(mesh, f).norm();
    const auto largest = static_cast<std::size_t>(
        std::distance(piece_area.begin(), std::max_element(piece_area.begin(), piece_area.end())));

    ManifoldParts<Scalar> out;
    std::vector<int> index(corners, -1);
    std::vector<std::array<int, 3>> faces;
    for (std::size_t f = 0; f < corners / 3; ++f) {
        const std::size_t piece = same_piece.find(f);
        if (piece != largest) {
            out.dropped_pieces += piece == f;
            continue;
        }
        if (repeats_a_vertex(static_cast<Eigen::Index>(f))) continue;
        std::array<int, 3> face{};
        for (std::size_t k = 0; k < 3; ++k) {
            int& v = index[same_vertex.find(3 * f + k)];
            if (v < 0) {
                v = static_cast<int>(out.source.size());
                out.source.push_back(vertex_at(3 * f + k));
            }
            face[k] = v;
        }
        faces.push_back(face);
    }
    out.mesh.vertices.resize(static_cast<Eigen::Index>(out.source.size()), 3);
    for (std::size_t v = 0; v < out.source.size(); ++v)
        out.mesh.vertices.row(static_cast<Eigen::Index>(v)) = mesh.vertices.row(out.source[v]);
    out.mesh.faces.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        out.mesh.faces.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
    return out;
}

} // namespace skelgen::surface
