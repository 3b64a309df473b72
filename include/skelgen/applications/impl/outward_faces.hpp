#pragma once

#include <skelgen/applications/outward_faces.hpp>

#include <utility>

#include <skelgen/core/geometry.hpp>

namespace skelgen::applications {

template <typename Scalar>
Triangles outward_faces(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body) {
    TriangleMesh<Scalar> canonical = mesh; // around the origin: what an open mesh encloses depends on where that is
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        core::set_point<Scalar>(canonical.vertices, v, body.similarity.to_canonical(core::point(mesh.vertices, v)));
    if (core::enclosed_volume(canonical) < -core::enclosed_volume(body.mesh) / 2)
        canonical.faces.col(1).swap(canonical.faces.col(2));
    return std::move(canonical.faces);
}

} // namespace skelgen::applications
