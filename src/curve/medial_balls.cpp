#include <skelgen/curve/medial_balls.hpp>

#include <nanoflann.hpp>

#include <skelgen/core/geometry.hpp>

namespace skelgen {
namespace {

using Tree = nanoflann::KDTreeEigenMatrixAdaptor<Points<double>, 3, nanoflann::metric_L2_Simple>;

/// A ball that would touch a second point closer to the first than this angle (seen from the centre, as a cosine) is
/// held up by the mesh's own facets, not by the opposite side of the body.
constexpr double nearly_same_direction = 0.8;

} // namespace

MedialBalls medial_balls(const TriangleMesh<double>& mesh, double largest_radius) {
    const Points<double> normals = vertex_normals(mesh);
    const Tree tree(3, std::cref(mesh.vertices), 10);
    MedialBalls balls{Points<double>(mesh.vertices.rows(), 3), Eigen::VectorXd(mesh.vertices.rows())};
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        const Vector3<double> p = mesh.vertices.row(v), n = normals.row(v);
        double radius = largest_radius;
        for (int step = 0; step < 30; ++step) {
            const Vector3<double> centre = p - radius * n;
            Eigen::Index nearest = 0;
            double squared_distance = 0;
            tree.query(centre.data(), 1, &nearest, &squared_distance);
            const Vector3<double> chord = p - Vector3<double>(mesh.vertices.row(nearest));
            const double along = chord.dot(n);
            if (nearest == v || squared_distance >= radius * radius * (1 - 1e-9) || along <= 0) break;
            const double shrunk = chord.squaredNorm() / (2 * along);
            // The two contact points subtend this angle at the new centre.
            if (1 - chord.squaredNorm() / (2 * shrunk * shrunk) > nearly_same_direction) break;
            radius = shrunk;
        }
        balls.radii[v] = radius;
        balls.centres.row(v) = (p - radius * n).transpose();
    }
    return balls;
}

} // namespace skelgen
