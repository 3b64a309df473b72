#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace skelgen {

/// A point or a direction in space, 3 x 1.
template <typename Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;

/// n points, n x 3, one per row.
template <typename Scalar>
using Points = Eigen::Matrix<Scalar, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// m triangles, m x 3 vertex indices, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// A triangle mesh as two plain matrices: any mesh library comes in through one adaptor, and no stage keeps state in
/// it.
template <typename Scalar = double>
struct TriangleMesh {
    Points<Scalar> vertices; ///< n x 3, in the input's own coordinates and unit
    Triangles faces;         ///< m x 3, indices into `vertices`
};

} // namespace skelgen
