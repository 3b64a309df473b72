#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/impl/triangulate_rim.hpp>

namespace skelgen::surface {

/// A surface whose small holes are closed.
template <typename Scalar = double>
struct FilledSurface {
    TriangleMesh<Scalar> mesh;          ///< the old vertices and faces first, as they were
    int filled = 0;                     ///< holes closed
    int open = 0;                       ///< holes left
    double open_area = 0;               ///< of the lids that would close the holes left, part of the surface's area
    std::vector<std::vector<int>> rims; ///< per hole closed the vertices around it, in order
};

namespace detail {

/// The rims of a manifold surface's holes.
inline std::vector<Rim> rims_of(const Triangles& faces, Eigen::Index vertex_count) {
    const Triangles adjacency = core::face_adjacency(faces);
    std::vector<int> next(static_cast<std::size_t>(vertex_count), -1), beside = next; // against the sense of the face
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            if (adjacency(f, k) >= 0) continue;
            const auto v = static_cast<std::size_t>(faces(f, (k + 1) % 3));
            next[v] = faces(f, k);
            beside[v] = static_cast<int>(f);
        }
    std::vector<Rim> rims;
    for (std::size_t first = 0; first < next.size(); ++first) {
        Rim rim;
        for (std::size_t v = first; next[v] >= 0; v = static_cast<std::size_t>(std::exchange(next[v], -1))) {
            rim.vertices.push_back(static_cast<int>(v));
            rim.faces.push_back(beside[v]);
        }
        if (!rim.vertices.empty()) rims.push_back(std::move(rim));
    }
    return rims;
}

/// The edges of a surface between vertices of its rims.
class RimEdges {
public:
    RimEdges(const Triangles& faces, const std::vector<Rim>& rims, Eigen::Index vertex_count) {
        std::vector<bool> at_rim(static_cast<std::size_t>(vertex_count), false);
        for (const Rim& rim : rims)
            for (const int v : rim.vertices) at_rim[static_cast<std::size_t>(v)] = true;
        for (Eigen::Index f = 0; f < faces.rows(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int a = faces(f, k), b = faces(f, (k + 1) % 3);
                if (at_rim[static_cast<std::size_t>(a)] && at_rim[static_cast<std::size_t>(b)])
                    edges_.emplace_back(std::min(a, b), std::max(a, b));
            }
        std::sort(edges_.begin(), edges_.end());
    }
    [[nodiscard]] bool has(int a, int b) const {
        return std::binary_search(edges_.begin(), edges_.end(), std::pair(std::min(a, b), std::max(a, b)));
    }

private:
    std::vector<std::pair<int, int>> edges_; ///< the lesser vertex first, in order
};

template <typename Scalar>
Vector3<Scalar> middle_of(const Points<Scalar>& points, const std::vector<int>& rim) {
    Vector3<Scalar> sum = Vector3<Scalar>::Zero();
    for (const int v : rim) sum += core::point(points, v);
    return sum / static_cast<Scalar>(rim.size());
}

template <typename Scalar>
core::Accumulator fan_area(const Points<Scalar>& points, const std::vector<int>& rim, const Vector3<Scalar>& middle) {
    core::Accumulator area = 0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const Vector3<Scalar> a = core::point(points, rim[i]) - middle,
                              b = core::point(points, rim[(i + 1) % rim.size()]) - middle;
        area += a.cross(b).norm() / 2;
    }
    return area;
}

/// What closes a hole: faces of the surface's vertices and, where there is one, of a new vertex after them.
template <typename Scalar>
struct Lid {
    std::vector<std::array<int, 3>> faces;
    std::optional<Vector3<Scalar>> middle;
    core::Accumulator area = 0;
};

template <typename Scalar>
Lid<Scalar> fan_across(const TriangleMesh<Scalar>& mesh, const Rim& rim, int new_vertex) {
    const std::vector<int>& around = rim.vertices;
    Lid<Scalar> out;
    out.middle = middle_of(mesh.vertices, around);
    out.area = fan_area(mesh.vertices, around, *out.middle);
    for (std::size_t i = 0; i < around.size(); ++i)
        out.faces.push_back({around[i], around[(i + 1) % around.size()], new_vertex});
    return out;
}

/// None where the rim has an edge across it wherever a triangle would have to be.
template <typename Scalar>
std::optional<Lid<Scalar>> triangles_across(const TriangleMesh<Scalar>& mesh, const Rim& rim, const RimEdges& edges) {
    const auto vertex = [&](int i) { return rim.vertices[static_cast<std::size_t>(i)]; };
    const auto triangles = triangulate_rim(mesh, rim, [&](int i, int j) { return edges.has(vertex(i), vertex(j)); });
    if (!triangles) return std::nullopt;
    Lid<Scalar> out;
    for (const std::array<int, 3>& t : *triangles) {
        out.faces.push_back({vertex(t[0]), vertex(t[1]), vertex(t[2])});
        const Vector3<Scalar> a = core::point(mesh.vertices, vertex(t[0]));
        out.area +=
            (core::point(mesh.vertices, vertex(t[1])) - a).cross(core::point(mesh.vertices, vertex(t[2])) - a).norm() /
            2;
    }
    return out;
}

} // namespace detail

/// Closes the holes of a manifold surface but for those whose lids have more than `largest` of the surface's area. A
/// lid goes on as the surface does around the hole (triangulate_rim); a fan around a new vertex in the middle of the
/// rim closes holes with too many edges for that, more than 500 together, or where no such lid exists. O(n log n)
/// besides. `at_holes`: per vertex, whether it is one around a hole that may be closed; holes around which there are
/// others stay open. Empty: all may be.
template <typename Scalar>
FilledSurface<Scalar> fill_holes(const TriangleMesh<Scalar>& mesh, double largest,
                                 const std::vector<bool>& at_holes = {}) {
    const auto may_close = [&](const Rim& rim) {
        return at_holes.empty() || std::all_of(rim.vertices.begin(), rim.vertices.end(),
                                               [&](int v) { return at_holes[static_cast<std::size_t>(v)]; });
    };
    FilledSurface<Scalar> out;
    const core::Accumulator area = core::surface_area(mesh);
    double work = 500.0 * 500 * 500; // that triangulations may take: half a second
    std::vector<Vector3<Scalar>> added;
    std::vector<std::array<int, 3>> faces;
    const std::vector<Rim> rims = detail::rims_of(mesh.faces, mesh.vertices.rows());
    const detail::RimEdges edges(mesh.faces, rims, mesh.vertices.rows());
    for (const Rim& rim : rims) {
        const double cube = std::pow(static_cast<double>(rim.vertices.size()), 3);
        std::optional<detail::Lid<Scalar>> lid;
        if (cube <= work) {
            work -= cube;
            lid = detail::triangles_across(mesh, rim, edges);
        }
        if (!lid)
            lid =
                detail::fan_across(mesh, rim, static_cast<int>(mesh.vertices.rows()) + static_cast<int>(added.size()));
        if (lid->area > largest * area || rim.vertices.size() < 3 || !may_close(rim)) {
            ++out.open;
            out.open_area += static_cast<double>(lid->area / area);
            continue;
        }
        ++out.filled;
        out.rims.push_back(rim.vertices);
        if (lid->middle) added.push_back(*lid->middle);
        faces.insert(faces.end(), lid->faces.begin(), lid->faces.end());
    }
    out.mesh.vertices.resize(mesh.vertices.rows() + static_cast<Eigen::Index>(added.size()), 3);
    out.mesh.vertices.topRows(mesh.vertices.rows()) = mesh.vertices;
    for (std::size_t i = 0; i < added.size(); ++i)
        core::set_point(out.mesh.vertices, mesh.vertices.rows() + static_cast<Eigen::Index>(i), added[i]);
    out.mesh.faces.resize(mesh.faces.rows() + static_cast<Eigen::Index>(faces.size()), 3);
    out.mesh.faces.topRows(mesh.faces.rows()) = mesh.faces;
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (int k = 0; k < 3; ++k)
            out.mesh.faces(mesh.faces.rows() + static_cast<Eigen::Index>(i), k) = faces[i][static_cast<std::size_t>(k)];
    return out;
}

} // namespace skelgen::surface
