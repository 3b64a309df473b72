#pragma once

#include <Eigen/Core>

#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// The largest ball inside the surface that touches it at each vertex.
struct MedialBalls {
    Points<double> centres; ///< n x 3
    Eigen::VectorXd radii;  ///< n
};

/// Maximal inscribed balls at the vertices by the shrinking-ball iteration (Ma, Bae & Choi 2012) against the vertices
/// of the same mesh, none larger than `largest_radius`. Faces must point outwards. O(n log n).
[[nodiscard]] MedialBalls medial_balls(const TriangleMesh<double>& mesh, double largest_radius);

} // namespace skelgen
