#pragma once

#include <skelgen/surface/cut_surface.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>

#include <skelgen/core/adjacency.hpp>

namespace skelgen::surface {
namespace detail {

enum class Place : std::uint8_t { nowhere, part, other };

/// The mesh while it is being cut.
template <typename Scalar>
class Cut {
public:
    Cut(const TriangleMesh<Scalar>& mesh, const std::vector<int>& part, const std::vector<int>& other)
        : mesh_(mesh), place_(static_cast<std::size_t>(mesh.vertices.rows()), Place::nowhere), copy_(place_.size(), -1),
          source_(place_.size()) {
        for (const int v : other) place_[static_cast<std::size_t>(v)] = Place::other;
        for (const int v : part) place_[static_cast<std::size_t>(v)] = Place::part;
        for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
            faces_.push_back({mesh.faces(f, 0), mesh.faces(f, 1), mesh.faces(f, 2)});
            joins_.push_back(has(f, Place::part) && has(f, Place::other));
        }
        std::iota(source_.begin(), source_.end(), 0);
    }

    CutSurface<Scalar> run() {
        for (std::size_t f = 0; f < joins_.size(); ++f)
            if (joins_[f])
                for (int& v : faces_[f]) v = of_other_side(v);
        close(open_edges());
        return result();
    }

private:
    [[nodiscard]] Place place(int v) const { return place_[static_cast<std::size_t>(v)]; }

    [[nodiscard]] bool has(Eigen::Index f, Place wanted) const {
        return place(mesh_.faces(f, 0)) == wanted || place(mesh_.faces(f, 1)) == wanted ||
               place(mesh_.faces(f, 2)) == wanted;
    }

    /// What takes a vertex's place in the faces that join the parts.
    int of_other_side(int v) {
        if (place(v) != Place::part) return v;
        int& copy = copy_[static_cast<std::size_t>(v)];
        if (copy < 0) {
            copy = static_cast<int>(source_.size());
            source_.push_back(v);
        }
        return copy;
    }

    /// Edges that have lost their neighbour, as their faces have them, by first vertex.
    [[nodiscard]] std::multimap<int, int> open_edges() const {
        const Triangles adjacency = core::face_adjacency(mesh_.faces);
        std::multimap<int, int> out;
        for (std::size_t f = 0; f < faces_.size(); ++f)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto row = static_cast<Eigen::Index>(f);
                const int g = adjacency(row, static_cast<Eigen::Index>(k));
                const bool touched = place(mesh_.faces(row, static_cast<Eigen::Index>(k))) == Place::part ||
                                     place(mesh_.faces(row, static_cast<Eigen::Index>((k + 1) % 3))) == Place::part;
                if (g >= 0 && touched && joins_[f] != joins_[static_cast<std::size_t>(g)])
                    out.emplace(faces_[f][k], faces_[f][(k + 1) % 3]);
            }
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
        out.mesh.faces.resize(static_cast<Eigen::Index>(faces_.size()), 3);
        for (std::size_t f = 0; f < faces_.size(); ++f)
            out.mesh.faces.row(static_cast<Eigen::Index>(f)) << faces_[f][0], faces_[f][1], faces_[f][2];
        return out;
    }

    const TriangleMesh<Scalar>& mesh_;
    std::vector<Place> place_;
    std::vector<int> copy_;
    std::vector<int> source_;
    std::vector<std::array<int, 3>> faces_;
    std::vector<bool> joins_;
    std::vector<std::vector<int>> rings_; ///< of the holes, whose hubs come last
};

} // namespace detail

template <typename Scalar>
CutSurface<Scalar> cut_surface(const TriangleMesh<Scalar>& mesh, const std::vector<int>& part,
                               const std::vector<int>& other) {
    return detail::Cut<Scalar>(mesh, part, other).run();
}

} // namespace skelgen::surface
