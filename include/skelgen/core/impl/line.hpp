#pragma once

#include <skelgen/core/line.hpp>

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include <skelgen/core/geometry.hpp>

namespace skelgen::core {

template <typename Scalar>
FittedLine<Scalar> principal_line(const std::vector<Vector3<Scalar>>& points) {
    FittedLine<Scalar> line;
    const auto count = static_cast<Scalar>(points.size());
    for (const auto& p : points) line.point += p;
    line.point /= count;
    Eigen::Matrix3<Scalar> moments = Eigen::Matrix3<Scalar>::Zero();
    for (const auto& p : points) add_outer_product<Scalar>(moments, 1, p - line.point);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3<Scalar>> axes(moments);
    line.direction = axes.eigenvectors().col(2);
    if (line.direction.dot(points.back() - points.front()) < 0) line.direction = -line.direction;
    line.roughness = std::sqrt(std::max(axes.eigenvalues()[1], Scalar(0)) / count);
    return line;
}

} // namespace skelgen::core
