#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <skelgen/surface/body.hpp>
#include <skelgen/surface/impl/fill_holes.hpp>
#include <skelgen/surface/manifold_parts.hpp>

namespace skelgen::surface {

/// The body without some of its faces (`is_left_out`, one entry for each), the holes that they leave closed; others
/// stay as they are. Of what is in pieces then the largest. O(n log n), and as fill_holes.
template <typename Scalar>
Body<Scalar> without_faces(const Body<Scalar>& body, const std::vector<bool>& is_left_out) {
    TriangleMesh<Scalar> open{body.mesh.vertices, Triangles(body.mesh.faces.rows(), 3)};
    std::vector<bool> at_left_out(static_cast<std::size_t>(body.mesh.vertices.rows()), false);
    Eigen::Index count = 0;
    for (Eigen::Index f = 0; f < body.mesh.faces.rows(); ++f)
        if (!is_left_out[static_cast<std::size_t>(f)])
            open.faces.row(count++) = body.mesh.faces.row(f);
        else
            for (int k = 0; k < 3; ++k) at_left_out[static_cast<std::size_t>(body.mesh.faces(f, k))] = true;
    open.faces.conservativeResize(count, 3);
    ManifoldParts<Scalar> part = largest_manifold_part(open);
    std::vector<bool> at_rim(part.source.size());
    for (std::size_t v = 0; v < at_rim.size(); ++v) at_rim[v] = at_left_out[static_cast<std::size_t>(part.source[v])];
    FilledSurface<Scalar> closed = fill_holes(part.mesh, 1.0, at_rim);
    part.source.resize(static_cast<std::size_t>(closed.mesh.vertices.rows()), -1);
    return resurfaced(body, std::move(closed.mesh), std::move(part.source));
}

} // namespace skelgen::surface
