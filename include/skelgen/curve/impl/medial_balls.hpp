#pragma once

#include <skelgen/curve/medial_balls.hpp>

#include <functional>

#include <nanoflann.hpp>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::curve {
namespace detail {

template <typename Scalar>
using VertexTree = nanoflann::KDTreeEigenMatrixAdaptor<Points<Scalar>, 3, nanoflann::metric_L2_Simple>;

/// A ball that would touch a second point closer to the first than this angle (seen from the centre, as a cosine; 37
/// degrees) is held up by the mesh's own facets, not by the opposite side of the body. Calibrated.
template <typename Scalar>
inline constexpr Scalar nearly_same_direction = Scalar(0.8);

} // namespace detail

template <typename Scalar>
MedialBalls<Scalar> medial_balls(const TriangleMesh<Scalar>& mesh, std::type_identity_t<Scalar> largest_radius) {
    constexpr int most_steps = 30; // a ball shrinks in a few steps; none may go on for its last bits
    constexpr std::size_t most_in_leaf = 10;
    const Points<Scalar> normals = core::vertex_normals(mesh);
    const detail::VertexTree<Scalar> tree(3, std::cref(mesh.vertices), most_in_leaf);
    MedialBalls<Scalar> balls{Points<Scalar>(mesh.vertices.rows(), 3),
                              Eigen::Matrix<Scalar, Eigen::Dynamic, 1>(mesh.vertices.rows())};
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        const Vector3<Scalar> p = mesh.vertices.row(v), n = normals.row(v);
        Scalar radius = largest_radius;
        for (int step = 0; step < most_steps; ++step) {
            const Vector3<Scalar> centre = p - radius * n;
            Eigen::Index nearest = 0;
            Scalar squared_distance = 0;
            tree.query(centre.data(), 1, &nearest, &squared_distance);
            const Vector3<Scalar> chord = p - core::point(mesh.vertices, nearest);
            const Scalar along = chord.dot(n);
            const bool is_empty = squared_distance >= radius * radius * (1 - core::rounding<Scalar>());
            if (nearest == v || is_empty || along <= 0) break;
            const Scalar shrunk = chord.squaredNorm() / (2 * along);
            // The two contact points subtend this angle at the new centre.
            if (1 - chord.squaredNorm() / (2 * shrunk * shrunk) > detail::nearly_same_direction<Scalar>) break;
            radius = shrunk;
        }
        balls.radii[v] = radius;
        balls.centres.row(v) = (p - radius * n).transpose();
    }
    return balls;
}

} // namespace skelgen::curve
