#pragma once

#include <skelgen/applications/own_part.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

#include <skelgen/surface/pieces.hpp>
#include <skelgen/surface/weld.hpp>

namespace skelgen::applications {
namespace detail {

/// Faces whose corners at the same place are the same vertex, and which of the original's they are.
template <typename Scalar>
struct WeldedFaces {
    TriangleMesh<Scalar> mesh;
    std::vector<int> source;
    std::vector<bool> is_own; ///< per vertex: the body stands for it
};

template <typename Scalar>
WeldedFaces<Scalar> welded_faces(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body) {
    auto welded = surface::weld(mesh, Scalar(0));
    WeldedFaces<Scalar> out{{std::move(welded.mesh.vertices), {}}, {}, {}};
    const auto corner = [&](Eigen::Index f, int k) {
        return welded.placed[static_cast<std::size_t>(mesh.faces(f, k))];
    };
    out.mesh.faces.resize(mesh.faces.rows(), 3);
    Eigen::Index row = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const int a = corner(f, 0), b = corner(f, 1), c = corner(f, 2);
        if (a == b || b == c || c == a) continue; // shows nothing
        out.mesh.faces.row(row++) << a, b, c;
        out.source.push_back(static_cast<int>(f));
    }
    out.mesh.faces.conservativeResize(row, Eigen::NoChange);
    out.is_own.resize(static_cast<std::size_t>(out.mesh.vertices.rows()), false);
    const auto mark = [&](std::size_t v) {
        if (welded.placed[v] >= 0) out.is_own[static_cast<std::size_t>(welded.placed[v])] = true;
    };
    for (const int v : body.source)
        if (v >= 0) mark(static_cast<std::size_t>(v));
    for (std::size_t v = 0; v < body.nearest.size(); ++v)
        if (body.nearest[v] >= 0) mark(v);
    return out;
}

/// The original's numbers of the faces that `chosen` has, which are some of the welded ones in their order.
template <typename Scalar>
std::vector<int> numbers_of(const Triangles& chosen, const WeldedFaces<Scalar>& welded) {
    std::vector<int> out;
    for (std::size_t f = 0; f < welded.source.size() && static_cast<Eigen::Index>(out.size()) < chosen.rows(); ++f)
        if (welded.mesh.faces.row(static_cast<Eigen::Index>(f)) == chosen.row(static_cast<Eigen::Index>(out.size())))
            out.push_back(welded.source[f]);
    return out;
}

/// The faces of that of the bodies in a mesh which most of a body's own vertices are on; none where there is one alone.
template <typename Scalar>
std::vector<int> own_faces(const WeldedFaces<Scalar>& welded) {
    std::vector<int> best;
    std::ptrdiff_t most = -1;
    int bodies = 1;
    for (int number = 1; number <= bodies; ++number) {
        const surface::BodyFaces faces = surface::faces_of_body(welded.mesh, number);
        bodies = faces.bodies;
        const auto corners = faces.faces.reshaped();
        const std::ptrdiff_t own = std::count_if(corners.begin(), corners.end(), [&](int v) {
            return static_cast<bool>(welded.is_own[static_cast<std::size_t>(v)]);
        });
        if (bodies == 1) return {};
        if (own <= most) continue;
        most = own;
        best = numbers_of(faces.faces, welded);
    }
    return best;
}

/// The body of a mesh as that of the part of it that has these vertices.
template <typename Scalar>
Body<Scalar> body_of_part(Body<Scalar> body, const std::vector<int>& vertices, Eigen::Index all) {
    std::vector<int> now(static_cast<std::size_t>(all), -1);
    for (std::size_t v = 0; v < vertices.size(); ++v) now[static_cast<std::size_t>(vertices[v])] = static_cast<int>(v);
    body.source = surface::composed(std::move(body.source), now);
    if (body.nearest.empty()) return body;
    std::vector<int> nearest;
    for (const int v : vertices) nearest.push_back(body.nearest[static_cast<std::size_t>(v)]);
    body.nearest = std::move(nearest);
    return body;
}

} // namespace detail

template <typename Scalar>
OwnBody<Scalar> own_body(TriangleMesh<Scalar> mesh, Body<Scalar> body) {
    OwnPart part;
    part.faces = detail::own_faces(detail::welded_faces(mesh, body));
    if (part.faces.empty()) return {std::move(mesh), std::move(body), std::move(part)};
    part.is_all = false;
    TriangleMesh<Scalar> own{mesh.vertices, {}};
    own.faces.resize(static_cast<Eigen::Index>(part.faces.size()), 3);
    for (std::size_t i = 0; i < part.faces.size(); ++i)
        own.faces.row(static_cast<Eigen::Index>(i)) = mesh.faces.row(part.faces[i]);
    auto used = surface::used_part(own);
    body = detail::body_of_part(std::move(body), used.source, mesh.vertices.rows());
    part.vertices = std::move(used.source);
    return {std::move(used.mesh), std::move(body), std::move(part)};
}

} // namespace skelgen::applications
