#pragma once

#include <skelgen/core/geometry.hpp>
#include <skelgen/refinement/fork.hpp>

#include <cmath>
#include <limits>

namespace skelgen::refinement {

template <typename Scalar>
std::optional<Vector3<Scalar>> fork_between(const TriangleMesh<Scalar>& mesh, const EndPoint<Scalar>& a,
                                            const EndPoint<Scalar>& b) {
    std::optional<Vector3<Scalar>> fork;
    Scalar nearest = std::numeric_limits<Scalar>::infinity();
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int u = mesh.faces(f, k), v = mesh.faces(f, (k + 1) % 3);
            const Scalar at_u = a.distance[u] - b.distance[u], at_v = a.distance[v] - b.distance[v];
            if ((at_u < 0) == (at_v < 0) || !std::isfinite(at_u) || !std::isfinite(at_v)) continue;
            const Scalar t = at_u / (at_u - at_v), distance = (1 - t) * a.distance[u] + t * a.distance[v];
            if (distance >= nearest) continue;
            nearest = distance;
            fork = (1 - t) * core::point(mesh.vertices, u) + t * core::point(mesh.vertices, v);
        }
    return fork;
}

} // namespace skelgen::refinement
