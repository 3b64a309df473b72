#pragma once

#include <utility>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// The faces of the mesh that a body was made of, looking outwards: as they are, or all turned over where the mesh is
/// inside out, which programs that leave out what looks away would show as its far side. Inside out is what encloses at
/// least half of the body's volume with the other sign: a shell turned inwards on purpose, as an outline around a
/// drawn figure, is not. Each face keeps its first corner. O(faces).
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
