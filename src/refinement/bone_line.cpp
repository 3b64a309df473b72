#include "bone_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>

namespace skelgen::detail {

namespace {

constexpr double inlier_distance = 0.25; // of the limb's median thickness: bones are that straight

double squared_distance(const Line& line, const Vector3<double>& p) {
    return (p - line.point).cross(line.direction).squaredNorm();
}

/// Least squares line through points.
Line principal_line(const std::vector<Vector3<double>>& points) {
    Line line{Vector3<double>::Zero(), Vector3<double>::Zero()};
    for (const auto& p : points) line.point += p;
    line.point /= static_cast<double>(points.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const auto& p : points) covariance += (p - line.point) * (p - line.point).transpose();
    line.direction = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(2);
    if (line.direction.dot(points.back() - points.front()) < 0) line.direction = -line.direction;
    return line;
}

/// Those of the points that lie near the line through two of them that most points are near (MSAC over all pairs).
std::vector<Vector3<double>> consensus(const std::vector<Vector3<double>>& points, double distance) {
    const double farthest = distance * distance;
    Line best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j) {
            if (!((points[j] - points[i]).norm() > distance)) continue;
            const Line line{points[i], (points[j] - points[i]).normalized()};
            double cost = 0;
            for (const auto& p : points) cost += std::min(squared_distance(line, p), farthest);
            if (cost >= least) continue;
            least = cost;
            best = line;
        }
    if (!std::isfinite(least)) return {};
    std::vector<Vector3<double>> near;
    for (const auto& p : points)
        if (squared_distance(best, p) < farthest) near.push_back(p);
    return near;
}

} // namespace

std::optional<Line> fit_bone(const Centreline& centreline, double from, double to, double flatness) {
    std::vector<Vector3<double>> points;
    std::vector<double> thickness;
    for (Eigen::Index i = 0; i < centreline.points.rows(); ++i)
        if (centreline.arc[i] >= from && centreline.arc[i] <= to && centreline.area[i] > 0 &&
            centreline.flatness[i] < flatness) {
            points.emplace_back(centreline.points.row(i).transpose());
            thickness.push_back(centreline.thickness[i]);
        }
    if (points.size() < 3) return std::nullopt;
    const auto middle = thickness.begin() + static_cast<std::ptrdiff_t>(thickness.size() / 2);
    std::nth_element(thickness.begin(), middle, thickness.end());
    const auto near = consensus(points, inlier_distance * *middle);
    if (near.size() < 3) return std::nullopt;
    return principal_line(near);
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
