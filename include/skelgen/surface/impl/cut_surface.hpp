#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// A surface cut in places, and where its vertices come from. The old vertices come first and keep their indices; those
/// along a cut are there twice, and both draw back from it, halfway to their neighbours. The holes are closed by fans
/// around new vertices; holes that were there before stay.
template <typename Scalar = double>
struct CutSurface {
    TriangleMesh<Scalar> mesh;
    std::vector<int> source; ///< per vertex that of the original mesh at the same place, -1 where it closes a hole
};

namespace detail {

/// A mesh while it is being cut: in some corners of its faces copies stand in for their vertices.
template <typename Scalar>
class Cut {
public:
    explicit Cut(const TriangleMesh<Scalar>& mesh)
        : mesh_(mesh), source_(static_cast<std::size_t>(mesh.vertices.rows())) {
        for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
            faces_.push_back({mesh.faces(f, 0), mesh.faces(f, 1), mesh.faces(f, 2)});
        std::iota(source_.begin(), source_.end(), 0);
    }

    /// A new vertex in the same place.
    int copy(int vertex) {
        source_.push_back(vertex);
        return static_cast<int>(source_.size()) - 1;
    }

    int& corner(Eigen::Index face, int k) {
        return faces_[static_cast<std::size_t>(face)][static_cast<std::size_t>(k)];
    }

    /// The surface, its new holes closed.
    CutSurface<Scalar> closed() {
        close(open_edges());
        return result();
    }

private:
    /// Edges that have lost their neighbour, as their faces have them, by first vertex: at vertices that have copies.
    [[nodiscard]] std::multimap<int, int> open_edges() const {
        const std::vector<std::size_t> around = around_copies();
        std::vector<std::array<int, 3>> faces;
        faces.reserve(around.size());
        for (const std::size_t f : around) faces.push_back(faces_[f]);
        const Triangles now = core::face_adjacency(as_matrix(faces));
        for (std::array<int, 3>& face : faces)
            for (int& v : face) v = original(v);
        const Triangles before = core::face_adjacency(as_matrix(faces));
        std::multimap<int, int> out;
        for (std::size_t f = 0; f < around.size(); ++f)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto row = static_cast<Eigen::Index>(f), column = static_cast<Eigen::Index>(k);
                const std::array<int, 3>& face = faces_[around[f]];
                if (before(row, column) >= 0 && now(row, column) < 0) out.emplace(face[k], face[(k + 1) % 3]);
            }
        return out;
    }

    /// The vertex of the mesh in the place of one of its vertices, or of a copy.
    [[nodiscard]] int original(int vertex) const { return source_[static_cast<std::size_t>(vertex)]; }

    /// The faces around vertices that have copies, ascending.
    [[nodiscard]] std::vector<std::size_t> around_copies() const {
        const auto vertices = static_cast<std::size_t>(mesh_.vertices.rows());
        std::vector<bool> has_copy(vertices, false);
        for (std::size_t v = vertices; v < source_.size(); ++v) has_copy[static_cast<std::size_t>(source_[v])] = true;
        std::vector<std::size_t> out;
        for (std::size_t f = 0; f < faces_.size(); ++f)
            if (std::any_of(faces_[f].begin(), faces_[f].end(),
                            [&](int v) { return has_copy[static_cast<std::size_t>(original(v))]; }))
                out.push_back(f);
        return out;
    }

    [[nodiscard]] static Triangles as_matrix(const std::vector<std::array<int, 3>>& faces) {
        Triangles out(static_cast<Eigen::Index>(faces.size()), 3);
        for (std::size_t f = 0; f < faces.size(); ++f)
            out.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
        return out;
    }

    /// Closes every ring of the edges by a fan; chains of them that do not close stay open.
    void close(std::multimap<int, int> edges) {
        while (!edges.empty()) {
            std::vector<int> ring{edges.begin()->first};
            for (auto edge = edges.begin(); edge != edges.end(); edge = edges.find(ring.back())) {
                ring.push_back(edge->second);
                edges.erase(edge);
            }
            if (ring.size() < 4 || ring.front() != ring.back()) continue;
            const auto hub = static_cast<int>(source_.size());
            source_.push_back(-1);
            for (std::size_t i = 0; i + 1 < ring.size(); ++i) faces_.push_back({ring[i + 1], ring[i], hub});
            ring.pop_back();
            rings_.push_back(std::move(ring));
        }
    }

    /// The rings, which come in pairs at the same place, draw back halfway to their neighbours; each hub is the middle
    /// of its ring.
    void draw_back(Points<Scalar>& vertices) const {
        std::vector<bool> on_ring(source_.size(), false);
        for (const auto& ring : rings_)
            for (const int v : ring) on_ring[static_cast<std::size_t>(v)] = true;
        Points<Scalar> sum = Points<Scalar>::Zero(vertices.rows(), 3);
        std::vector<int> count(source_.size(), 0);
        for (const auto& face : faces_)
            for (std::size_t k = 0; k < 3; ++k)
                for (const int w : {face[(k + 1) % 3], face[(k + 2) % 3]}) {
                    const auto neighbour = static_cast<std::size_t>(w);
                    if (on_ring[neighbour] || source_[neighbour] < 0) continue;
                    sum.row(face[k]) += vertices.row(w);
                    ++count[static_cast<std::size_t>(face[k])];
                }
        int hub = static_cast<int>(source_.size() - rings_.size());
        for (const auto& ring : rings_) {
            vertices.row(hub).setZero();
            for (const int v : ring) {
                if (const int n = count[static_cast<std::size_t>(v)]; n > 0)
                    vertices.row(v) = Scalar(0.5) * (vertices.row(v) + sum.row(v) / static_cast<Scalar>(n));
                vertices.row(hub) += vertices.row(v) / static_cast<Scalar>(ring.size());
            }
            ++hub;
        }
    }

    [[nodiscard]] CutSurface<Scalar> result() const {
        CutSurface<Scalar> out{{}, source_};
        out.mesh.vertices.resize(static_cast<Eigen::Index>(source_.size()), 3);
        for (std::size_t v = 0; v < source_.size(); ++v)
            out.mesh.vertices.row(static_cast<Eigen::Index>(v)) = mesh_.vertices.row(std::max(source_[v], 0));
        draw_back(out.mesh.vertices);
        out.mesh.faces = as_matrix(faces_);
        return out;
    }

    const TriangleMesh<Scalar>& mesh_;
    std::vector<int> source_;
    std::vector<std::array<int, 3>> faces_;
    std::vector<std::vector<int>> rings_; ///< of the holes, whose hubs come last
};

} // namespace detail

/// Cuts a surface along closed paths of its edges, each a list of vertices in order; no vertex may be on two, or twice
/// on one, or at a boundary. `mesh` must be manifold, `adjacency` as from core::face_adjacency(mesh.faces). O(n log n).
template <typename Scalar>
CutSurface<Scalar> cut_along(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency,
                             const std::vector<std::vector<int>>& loops) {
    // Each of the loops' vertices comes from one and goes to one: faces to the left of the way get its copy.
    std::vector<int> to(static_cast<std::size_t>(mesh.vertices.rows()), -1), from = to;
    for (const std::vector<int>& loop : loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const int v = loop[i], next = loop[(i + 1) % loop.size()];
            to[static_cast<std::size_t>(v)] = next;
            from[static_cast<std::size_t>(next)] = v;
        }
    detail::Cut<Scalar> cut(mesh);
    for (Eigen::Index first = 0; first < mesh.faces.rows(); ++first)
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.faces(first, k);
            if (to[static_cast<std::size_t>(v)] != mesh.faces(first, (k + 1) % 3)) continue;
            const int copy = cut.copy(v);
            Eigen::Index face = first;
            for (int corner = k; face >= 0;) { // counter-clockwise around v, to where the way comes from
                cut.corner(face, corner) = copy;
                const int last = mesh.faces(face, (corner + 2) % 3);
                if (last == from[static_cast<std::size_t>(v)]) break;
                face = adjacency(face, (corner + 2) % 3);
                for (corner = 0; face >= 0 && mesh.faces(face, corner) != v;) ++corner;
            }
        }
    return cut.closed();
}

} // namespace skelgen::surface
