#pragma once

#include <type_traits>

#include <skelgen/core/mesh.hpp>

namespace skelgen::curve {

/// The largest ball inside the surface that touches it at each vertex.
template <typename Scalar = double>
struct MedialBalls {
    Points<Scalar> centres;                         ///< n x 3
    Eigen::Matrix<Scalar, Eigen::Dynamic, 1> radii; ///< n
};

/// Maximal inscribed balls at the vertices by the shrinking-ball iteration (MBC12 section 3) against the vertices of
/// the same mesh, none larger than `largest_radius` (in the mesh's unit). Faces must point outwards. O(n log n).
template <typename Scalar>
[[nodiscard]] MedialBalls<Scalar> medial_balls(const TriangleMesh<Scalar>& mesh,
                                               std::type_identity_t<Scalar> largest_radius);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/medial_balls.hpp>
#endif
