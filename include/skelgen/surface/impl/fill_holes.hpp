#pragma once

#include <skelgen/surface/fill_holes.hpp>

#include <array>
#include <cstddef>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::surface {
namespace detail {

/// The rims of a manifold surface's holes: vertices in the order in which faces that close them have to run.
inline std::vector<std::vector<int>> rims_of(const Triangles& faces, Eigen::Index vertex_count) {
    const Triangles adjacency = core::face_adjacency(faces);
    std::vector<int> next(static_cast<std::size_t>(vertex_count), -1); // against the sense of the face at the rim
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            if (adjacency(f, k) < 0) next[static_cast<std::size_t>(faces(f, (k + 1) % 3))] = faces(f, k);
    std::vector<std::vector<int>> rims;
    for (std::size_t first = 0; first < next.size(); ++first) {
        std::vector<int> rim;
        for (auto v = static_cast<int>(first); v >= 0;) {
            const int following = next[static_cast<std::size_t>(v)];
            if (following < 0) break;
            rim.push_back(v);
            next[static_cast<std::size_t>(v)] = -1;
            v = following;
        }
        if (!rim.empty()) rims.push_back(std::move(rim));
    }
    return rims;
}

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

} // namespace detail

template <typename Scalar>
FilledSurface<Scalar> fill_holes(const TriangleMesh<Scalar>& mesh, double largest) {
    FilledSurface<Scalar> out;
    const core::Accumulator area = core::surface_area(mesh);
    std::vector<Vector3<Scalar>> added;
    std::vector<std::array<int, 3>> faces;
    for (const std::vector<int>& rim : detail::rims_of(mesh.faces, mesh.vertices.rows())) {
        const Vector3<Scalar> middle = detail::middle_of(mesh.vertices, rim);
        const core::Accumulator fan = detail::fan_area(mesh.vertices, rim, middle);
        if (fan > largest * area || rim.size() < 3) {
            ++out.open;
            out.open_area += static_cast<double>(fan / area);
            continue;
        }
        ++out.filled;
        if (rim.size() == 3) {
            faces.push_back({rim[0], rim[1], rim[2]});
            continue;
        }
        const int centre = static_cast<int>(mesh.vertices.rows()) + static_cast<int>(added.size());
        added.push_back(middle);
        for (std::size_t i = 0; i < rim.size(); ++i) faces.push_back({rim[i], rim[(i + 1) % rim.size()], centre});
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
