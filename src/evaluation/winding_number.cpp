#include <skelgen/evaluation/winding_number.hpp>

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace skelgen {

double winding_number(const TriangleMesh<double>& mesh, const Vector3<double>& point) {
    double half_angles = 0;
    for (Eigen::Index face = 0; face < mesh.faces.rows(); ++face) {
        const auto corner = [&](int k) -> Vector3<double> {
            return mesh.vertices.row(mesh.faces(face, k)).transpose() - point;
        };
        const Vector3<double> a = corner(0), b = corner(1), c = corner(2);
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        half_angles += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return half_angles / (2 * std::numbers::pi);
}

} // namespace skelgen
