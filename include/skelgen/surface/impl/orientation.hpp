#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/face_tree.hpp>
#include <skelgen/surface/impl/visibility.hpp>

namespace skelgen::surface {

/// A mesh whose faces look outwards.
template <typename Scalar = double>
struct OrientedMesh {
    TriangleMesh<Scalar> mesh; ///< faces in their order and, but for turned ones, as they were
    int turned = 0;            ///< faces turned round
};

namespace detail {

/// Across each of a face's edges the face that alone shares it, -1 where none or several do, and whether both run the
/// same way there, so that one of the two is to be turned.
struct Neighbour {
    int face = -1;
    bool opposed = false;
};

struct Neighbours {
    std::vector<std::array<Neighbour, 3>> of_face;
    bool all_agree = true;
};

inline Neighbours neighbours_of(const Triangles& faces) {
    Neighbours out;
    out.of_face.resize(static_cast<std::size_t>(faces.rows()));
    const std::vector<core::DirectedEdge> edges = core::directed_edges(faces);
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        while (end < edges.size() && edges[end].joins_same(edges[i])) ++end;
        if (end - i == 2) {
            const std::size_t a = edges[i].corner, b = edges[i + 1].corner;
            const bool opposed = edges[i].forward == edges[i + 1].forward;
            out.of_face[a / 3][a % 3] = {static_cast<int>(b / 3), opposed};
            out.of_face[b / 3][b % 3] = {static_cast<int>(a / 3), opposed};
            out.all_agree = out.all_agree && !opposed;
        }
        i = end;
    }
    return out;
}

/// A connected piece: its faces, and whether it has no end.
struct ConnectedPiece {
    std::vector<int> faces;
    bool closed = true;
};

/// The piece around a face, and in `turn` which of its faces have to be turned for all to agree with that one.
inline ConnectedPiece piece_around(int first, const Neighbours& neighbours, std::vector<bool>& visited,
                                   std::vector<bool>& turn) {
    ConnectedPiece out;
    out.faces.push_back(first);
    visited[static_cast<std::size_t>(first)] = true;
    for (std::size_t i = 0; i < out.faces.size(); ++i) {
        const auto f = static_cast<std::size_t>(out.faces[i]);
        for (const Neighbour& next : neighbours.of_face[f]) {
            if (next.face < 0) {
                out.closed = false;
                continue;
            }
            const auto g = static_cast<std::size_t>(next.face);
            if (visited[g]) continue;
            visited[g] = true;
            turn[g] = turn[f] != next.opposed;
            out.faces.push_back(next.face);
        }
    }
    return out;
}

template <typename Scalar>
void turn_face(TriangleMesh<Scalar>& mesh, int f) {
    std::swap(mesh.faces(f, 1), mesh.faces(f, 2));
}

/// Volume that some faces enclose with the cone over their rims from their middle: positive where they look away from
/// it.
template <typename Scalar>
core::Accumulator volume_of(const TriangleMesh<Scalar>& mesh, const std::vector<int>& faces) {
    Vector3<core::Accumulator> middle = Vector3<core::Accumulator>::Zero();
    core::Accumulator area = 0, volume = 0;
    const auto corner = [&](int f, int k) {
        return Vector3<core::Accumulator>(
            core::point(mesh.vertices, mesh.faces(f, k)).template cast<core::Accumulator>());
    };
    const auto area_vector = [&](int f) {
        return Vector3<core::Accumulator>((corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0)) / 2);
    };
    for (const int f : faces) {
        const core::Accumulator weight = area_vector(f).norm();
        middle += weight / 3 * (corner(f, 0) + corner(f, 1) + corner(f, 2));
        area += weight;
    }
    if (area > 0) middle /= area;
    for (const int f : faces) volume += area_vector(f).dot(corner(f, 0) - middle) / 3;
    return volume;
}

} // namespace detail

/// Turns faces until neighbours along edges of two faces agree, as few as possible by area, and then each piece
/// outwards: a closed one by its volume, an open one by the side that more rays see (TPS14). A piece that has no two
/// sides (a Moebius band) is left with a line where neighbours disagree. O(n log n).
template <typename Scalar>
OrientedMesh<Scalar> orient(TriangleMesh<Scalar> mesh) {
    constexpr int samples = 64; // per piece; four rays each from both sides
    OrientedMesh<Scalar> out{std::move(mesh), 0};
    const auto m = static_cast<std::size_t>(out.mesh.faces.rows());
    const detail::Neighbours neighbours = detail::neighbours_of(out.mesh.faces);
    std::vector<bool> visited(m, false), turn(m, false);
    std::vector<detail::ConnectedPiece> open;
    const auto turn_all = [&](const std::vector<int>& faces) {
        for (const int f : faces) {
            detail::turn_face(out.mesh, f);
            turn[static_cast<std::size_t>(f)] = !turn[static_cast<std::size_t>(f)];
        }
    };
    for (std::size_t first = 0; first < m; ++first) {
        if (visited[first]) continue;
        detail::ConnectedPiece piece = detail::piece_around(static_cast<int>(first), neighbours, visited, turn);
        core::Accumulator turned = 0, kept = 0;
        for (const int f : piece.faces) {
            (turn[static_cast<std::size_t>(f)] ? turned : kept) += core::face_area_vector(out.mesh, f).norm();
            if (turn[static_cast<std::size_t>(f)]) detail::turn_face(out.mesh, f);
        }
        if (turned > kept) turn_all(piece.faces);
        if (!piece.closed)
            open.push_back(std::move(piece));
        else if (detail::volume_of(out.mesh, piece.faces) < 0)
            turn_all(piece.faces);
    }
    if (!open.empty()) {
        const FaceTree<Scalar> tree(out.mesh);
        for (const detail::ConnectedPiece& piece : open) {
            const Visibility seen = look_out(out.mesh, tree, piece.faces, samples);
            const bool from_behind =
                seen.front != seen.back ? seen.front < seen.back : detail::volume_of(out.mesh, piece.faces) < 0;
            if (from_behind) turn_all(piece.faces);
        }
    }
    for (const bool turned : turn) out.turned += turned;
    return out;
}

} // namespace skelgen::surface
