#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// The rim of a hole in a manifold surface.
struct Rim {
    std::vector<int> vertices; ///< in the order in which faces that close the hole have to run
    std::vector<int> faces;    ///< the surface's face at the edge from each vertex to the next
};

namespace detail {

/// How good triangles are: less is better.
template <typename Scalar>
struct Bend {
    Scalar most = 0; ///< over edges, 1 minus the cosine of the angle between their faces: 0 flat, 2 folded back
    Scalar area = 0;

    friend Bend operator+(const Bend& a, const Bend& b) { return {std::max(a.most, b.most), a.area + b.area}; }
    friend bool operator<(const Bend& a, const Bend& b) { return a.most != b.most ? a.most < b.most : a.area < b.area; }
};

/// The best triangles of ever longer parts of a rim.
template <typename Scalar>
class RimTriangles {
public:
    RimTriangles(const TriangleMesh<Scalar>& mesh, const Rim& rim, const std::function<bool(int, int)>& is_edge)
        : mesh_(mesh), rim_(rim), size_(static_cast<int>(rim.vertices.size())),
          best_(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_)) {
        for (int span = 2; span < size_; ++span)
            for (int first = 0; first + span < size_; ++first)
                if (span == size_ - 1 || !is_edge(first, first + span)) close(first, first + span);
    }

    [[nodiscard]] std::optional<std::vector<std::array<int, 3>>> triangles() const {
        if (at(0, size_ - 1).apex < 0) return std::nullopt;
        std::vector<std::array<int, 3>> out;
        std::vector<std::pair<int, int>> pending{{0, size_ - 1}};
        while (!pending.empty()) {
            const auto [first, last] = pending.back();
            pending.pop_back();
            if (last - first < 2) continue;
            const int apex = at(first, last).apex;
            out.push_back({first, apex, last});
            pending.emplace_back(first, apex);
            pending.emplace_back(apex, last);
        }
        return out;
    }

private:
    /// Of the part of the rim between two of its vertices, closed by the edge between them.
    struct Part {
        Bend<Scalar> bend;
        Vector3<Scalar> normal = Vector3<Scalar>::Zero(); ///< of the triangle at that edge
        int apex = -1;                                    ///< that triangle's third corner; none: it cannot be closed
    };

    [[nodiscard]] Part& at(int first, int last) {
        return best_[static_cast<std::size_t>(first) * static_cast<std::size_t>(size_) +
                     static_cast<std::size_t>(last)];
    }
    [[nodiscard]] const Part& at(int first, int last) const {
        return best_[static_cast<std::size_t>(first) * static_cast<std::size_t>(size_) +
                     static_cast<std::size_t>(last)];
    }
    [[nodiscard]] Vector3<Scalar> place(int i) const {
        return core::point(mesh_.vertices, rim_.vertices[static_cast<std::size_t>(i)]);
    }
    /// Of the surface's face at the edge from a vertex to the next.
    [[nodiscard]] Vector3<Scalar> normal_beyond(int i) const {
        return core::face_area_vector(mesh_, rim_.faces[static_cast<std::size_t>(i)]).stableNormalized();
    }
    /// Of what lies at the edge from `first` to `last` already.
    [[nodiscard]] Vector3<Scalar> normal_at(int first, int last) const {
        return last == first + 1 ? normal_beyond(first) : at(first, last).normal;
    }

    void close(int first, int last) {
        Part& part = at(first, last);
        for (int apex = first + 1; apex < last; ++apex) {
            if (apex > first + 1 && at(first, apex).apex < 0) continue;
            if (last > apex + 1 && at(apex, last).apex < 0) continue;
            const Vector3<Scalar> doubled =
                (place(apex) - place(first)).cross(place(last) - place(first)); // area times two
            const Scalar size = doubled.norm();
            if (!(size > 0)) continue;
            const Vector3<Scalar> normal = doubled / size;
            Scalar flattest = std::min(normal.dot(normal_at(first, apex)), normal.dot(normal_at(apex, last)));
            if (last - first == size_ - 1) flattest = std::min(flattest, normal.dot(normal_beyond(last)));
            const Bend<Scalar> bend = Bend<Scalar>{1 - flattest, size / 2} + at(first, apex).bend + at(apex, last).bend;
            if (part.apex < 0 || bend < part.bend) part = {bend, normal, apex};
        }
    }

    const TriangleMesh<Scalar>& mesh_;
    const Rim& rim_;
    int size_;
    std::vector<Part> best_;
};

} // namespace detail

/// The triangles (indices into the rim's vertices) that close a hole with no new vertex and bend as little as possible
/// at any edge, those to the faces around the hole included, and of these the ones with the least area (Lie03; BS95):
/// across a tube's open side, and not through it. `is_edge(i, j)` says whether two of the rim's vertices that are no
/// neighbours on it have an edge already, which no triangle may then use. Any unit. \returns nothing where no such
/// triangles exist. \throws Error usage when the rim has not one face for each vertex. O(n^3), in memory O(n^2).
template <typename Scalar>
std::optional<std::vector<std::array<int, 3>>> triangulate_rim(const TriangleMesh<Scalar>& mesh, const Rim& rim,
                                                               const std::function<bool(int, int)>& is_edge) {
    if (rim.faces.size() != rim.vertices.size())
        throw Error(ErrorCode::usage, "triangulate_rim: the rim must have one face for each vertex");
    if (rim.vertices.size() < 3) return std::nullopt;
    return detail::RimTriangles<Scalar>(mesh, rim, is_edge).triangles();
}

} // namespace skelgen::surface
