#include "tangents.hpp"

#include <array>

#include <Eigen/Geometry>

namespace skelgen::io::detail {

FloatRows tangents(const FloatRows& positions, const FloatRows& normals, const std::vector<std::uint32_t>& faces,
                   const FloatRows& coordinates) {
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
    Rows along_first = Rows::Zero(positions.rows(), 3), along_second = along_first;
    for (std::size_t i = 0; i + 2 < faces.size(); i += 3) {
        const auto vertex = [&](std::size_t k) { return static_cast<Eigen::Index>(faces[i + k]); };
        const std::array<Eigen::Index, 3> corner{vertex(0), vertex(1), vertex(2)};
        const auto edge = [&](std::size_t k) {
            return (positions.row(corner[k]) - positions.row(corner[0])).cast<double>().transpose().eval();
        };
        const auto step = [&](std::size_t k) {
            return (coordinates.row(corner[k]) - coordinates.row(corner[0])).cast<double>().transpose().eval();
        };
        const Eigen::Vector3d a = edge(1), b = edge(2);
        const Eigen::Vector2d s = step(1), t = step(2);
        const double area = a.cross(b).norm(), turn = s[0] * t[1] - s[1] * t[0] < 0 ? -1 : 1;
        // Directions alone count: a face's texture may be stretched as it likes.
        const Eigen::Vector3d first = (turn * (t[1] * a - s[1] * b)).stableNormalized() * area;
        const Eigen::Vector3d second = (turn * (s[0] * b - t[0] * a)).stableNormalized() * area;
        for (const Eigen::Index v : corner) {
            along_first.row(v) += first.transpose();
            along_second.row(v) += second.transpose();
        }
    }
    FloatRows out(positions.rows(), 4);
    for (Eigen::Index v = 0; v < out.rows(); ++v) {
        const Eigen::Vector3d normal = normals.row(v).cast<double>().transpose().normalized();
        Eigen::Vector3d tangent = along_first.row(v).transpose();
        const double length = tangent.norm();
        tangent -= tangent.dot(normal) * normal;
        constexpr double none = 1e-6; // of what rounding leaves of a direction along the normal
        if (!(tangent.norm() > none * length)) tangent = normal.unitOrthogonal();
        tangent.normalize();
        // The picture's up, which normal maps go by, is where the second coordinate falls.
        const bool mirrored = normal.cross(tangent).dot(along_second.row(v).transpose()) > 0;
        out.row(v) << tangent.transpose().cast<float>(), mirrored ? -1.0F : 1.0F;
        out.row(v).head<3>().normalize();
    }
    return out;
}

} // namespace skelgen::io::detail
