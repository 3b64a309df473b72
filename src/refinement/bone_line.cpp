#include "bone_line.hpp"

#include <vector>

#include <Eigen/Eigenvalues>

namespace skelgen::detail {

std::optional<Line> fit_bone(const Centreline& centreline, double from, double to, double flatness) {
    std::vector<Eigen::Index> used;
    for (Eigen::Index i = 0; i < centreline.points.rows(); ++i)
        if (centreline.arc[i] >= from && centreline.arc[i] <= to && centreline.area[i] > 0 &&
            centreline.flatness[i] < flatness)
            used.push_back(i);
    if (used.size() < 3) return std::nullopt;

    Line line{Vector3<double>::Zero(), Vector3<double>::Zero()};
    for (const Eigen::Index i : used) line.point += centreline.points.row(i).transpose();
    line.point /= static_cast<double>(used.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Eigen::Index i : used) {
        const Vector3<double> d = centreline.points.row(i).transpose() - line.point;
        covariance += d * d.transpose();
    }
    line.direction = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(2);
    const Vector3<double> outwards =
        (centreline.points.row(used.back()) - centreline.points.row(used.front())).transpose();
    if (line.direction.dot(outwards) < 0) line.direction = -line.direction;
    return line;
}

std::optional<Vector3<double>> meeting_point(const Line& a, const Line& b) {
    const double c = a.direction.dot(b.direction), sine_squared = 1 - c * c;
    if (sine_squared < 1e-3) return std::nullopt;
    const Vector3<double> between = b.point - a.point;
    const double s = (between.dot(a.direction) - c * between.dot(b.direction)) / sine_squared;
    const double t = (c * between.dot(a.direction) - between.dot(b.direction)) / sine_squared;
    return Vector3<double>(0.5 * (a.point + s * a.direction + b.point + t * b.direction));
}

} // namespace skelgen::detail
