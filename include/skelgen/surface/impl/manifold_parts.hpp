#pragma once

#include <skelgen/surface/manifold_parts.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::surface {
namespace detail {

inline std::size_t next_corner(std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

/// Which corners are one vertex, and which faces one piece.
struct ManifoldPieces {
    core::DisjointSets same_vertex, same_piece;
};

inline ManifoldPieces join_faces(const Triangles& faces) {
    const auto corners = static_cast<std::size_t>(faces.rows()) * 3;
    ManifoldPieces out{core::DisjointSets(corners), core::DisjointSets(corners / 3)};
    const std::vector<core::DirectedEdge> edges = core::directed_edges(faces);
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        while (end < edges.size() && edges[end].joins_same(edges[i])) ++end;
        if (end - i == 2 && edges[i].forward != edges[i + 1].forward) {
            const std::size_t a = edges[i].corner, b = edges[i + 1].corner;
            out.same_vertex.unite(a, next_corner(b));
            out.same_vertex.unite(next_corner(a), b);
            out.same_piece.unite(a / 3, b / 3);
        }
        i = end;
    }
    return out;
}

/// The piece of these faces; `index` holds -1 for each corner of theirs, and the new vertices afterwards.
template <typename Scalar>
ManifoldParts<Scalar> extract_piece(const TriangleMesh<Scalar>& mesh, const std::vector<std::size_t>& piece,
                                    core::DisjointSets& same_vertex, std::vector<int>& index) {
    ManifoldParts<Scalar> out;
    std::vector<std::array<int, 3>> faces;
    for (const std::size_t f : piece) {
        const auto row = static_cast<Eigen::Index>(f);
        const int a = mesh.faces(row, 0), b = mesh.faces(row, 1), c = mesh.faces(row, 2);
        if (a == b || b == c || c == a) continue;
        std::array<int, 3> face{};
        for (std::size_t k = 0; k < 3; ++k) {
            int& v = index[same_vertex.find(3 * f + k)];
            if (v < 0) {
                v = static_cast<int>(out.source.size());
                out.source.push_back(mesh.faces(row, static_cast<Eigen::Index>(k)));
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

/// The faces of each piece, in ascending order; the piece with the largest area first, of equals that of the first
/// face.
template <typename Scalar>
std::vector<std::pair<core::Accumulator, std::vector<std::size_t>>> pieces_by_area(const TriangleMesh<Scalar>& mesh,
                                                                                   core::DisjointSets& same_piece) {
    const auto faces = static_cast<std::size_t>(mesh.faces.rows());
    std::vector<std::pair<core::Accumulator, std::vector<std::size_t>>> pieces;
    std::vector<std::size_t> number(faces, faces);
    for (std::size_t f = 0; f < faces; ++f) {
        std::size_t& piece = number[same_piece.find(f)];
        if (piece == faces) {
            piece = pieces.size();
            pieces.emplace_back();
        }
        pieces[piece].first += core::face_area_vector(mesh, static_cast<Eigen::Index>(f)).norm();
        pieces[piece].second.push_back(f);
    }
    std::stable_sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    return pieces;
}

} // namespace detail

template <typename Scalar>
std::vector<ManifoldParts<Scalar>> manifold_parts(const TriangleMesh<Scalar>& mesh, double least_area) {
    detail::ManifoldPieces joined = detail::join_faces(mesh.faces);
    std::vector<int> index(static_cast<std::size_t>(mesh.faces.rows()) * 3, -1);
    std::vector<ManifoldParts<Scalar>> out;
    const auto pieces = detail::pieces_by_area(mesh, joined.same_piece);
    for (const auto& [area, piece] : pieces)
        if (area >= least_area * pieces.front().first)
            out.push_back(detail::extract_piece(mesh, piece, joined.same_vertex, index));
    return out;
}

namespace detail {

/// Of each corner of a closed surface the number of its fan, in which faces follow each other around a vertex: the
/// vertex where that has one alone, the next free one for each more.
inline std::vector<int> numbered_fans(const Triangles& faces, Eigen::Index vertices) {
    struct Corner {
        int after, before; ///< of the face, seen from the vertex
        std::size_t at;
    };
    std::vector<std::size_t> end(static_cast<std::size_t>(vertices) + 1, 0);
    for (Eigen::Index i = 0; i < faces.size(); ++i) ++end[static_cast<std::size_t>(faces.data()[i]) + 1];
    for (std::size_t v = 1; v < end.size(); ++v) end[v] += end[v - 1];
    std::vector<Corner> corners(static_cast<std::size_t>(faces.size()));
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            corners[end[static_cast<std::size_t>(faces(f, k))]++] = {faces(f, (k + 1) % 3), faces(f, (k + 2) % 3),
                                                                     static_cast<std::size_t>(3 * f + k)};
    std::vector<int> fans(corners.size(), -1);
    auto next_fan = static_cast<int>(vertices);
    std::size_t begin = 0;
    for (std::size_t v = 0; v + 1 < end.size(); begin = end[v++]) {
        const auto first = corners.begin() + static_cast<std::ptrdiff_t>(begin),
                   last = corners.begin() + static_cast<std::ptrdiff_t>(end[v]);
        for (auto start = first; start != last; ++start) {
            if (fans[start->at] >= 0) continue;
            const int fan = start == first ? static_cast<int>(v) : next_fan++;
            for (auto here = start; here != last && fans[here->at] < 0;) {
                fans[here->at] = fan;
                const int next = here->before;
                here = std::find_if(first, last, [&](const Corner& corner) { return corner.after == next; });
            }
        }
    }
    return fans;
}

} // namespace detail

template <typename Scalar>
ManifoldParts<Scalar> manifold_part_of_sound(const TriangleMesh<Scalar>& mesh) {
    ManifoldParts<Scalar> out;
    out.source.reserve(static_cast<std::size_t>(mesh.vertices.rows()));
    out.mesh.faces.resize(mesh.faces.rows(), 3);
    const std::vector<int> fans = detail::numbered_fans(mesh.faces, mesh.vertices.rows());
    std::vector<int> index(fans.empty() ? 0 : 1 + static_cast<std::size_t>(*std::max_element(fans.begin(), fans.end())),
                           -1);
    for (std::size_t i = 0; i < fans.size(); ++i) { // in the order in which faces use them
        int& v = index[static_cast<std::size_t>(fans[i])];
        if (v < 0) {
            v = static_cast<int>(out.source.size());
            out.source.push_back(mesh.faces.data()[i]);
        }
        out.mesh.faces.data()[i] = v;
    }
    out.mesh.vertices.resize(static_cast<Eigen::Index>(out.source.size()), 3);
    for (std::size_t v = 0; v < out.source.size(); ++v)
        out.mesh.vertices.row(static_cast<Eigen::Index>(v)) = mesh.vertices.row(out.source[v]);
    return out;
}

template <typename Scalar>
ManifoldParts<Scalar> largest_manifold_part(const TriangleMesh<Scalar>& mesh) {
    detail::ManifoldPieces joined = detail::join_faces(mesh.faces);
    std::vector<int> index(static_cast<std::size_t>(mesh.faces.rows()) * 3, -1);
    const auto pieces = detail::pieces_by_area(mesh, joined.same_piece);
    if (pieces.empty()) return {};
    ManifoldParts<Scalar> out = detail::extract_piece(mesh, pieces.front().second, joined.same_vertex, index);
    out.dropped_pieces = static_cast<int>(pieces.size()) - 1;
    return out;
}

template <typename Scalar>
TriangleMesh<Scalar> side_by_side(const TriangleMesh<Scalar>& one, const TriangleMesh<Scalar>& other) {
    TriangleMesh<Scalar> out;
    out.vertices.resize(one.vertices.rows() + other.vertices.rows(), 3);
    out.vertices << one.vertices, other.vertices;
    out.faces.resize(one.faces.rows() + other.faces.rows(), 3);
    out.faces << one.faces, other.faces;
    out.faces.bottomRows(other.faces.rows()).array() += static_cast<int>(one.vertices.rows());
    return out;
}

} // namespace skelgen::surface
