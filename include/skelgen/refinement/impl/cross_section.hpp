#pragma once

#include <skelgen/refinement/cross_section.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Eigenvalues>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::refinement {
namespace detail {

template <typename Scalar>
CrossSection<Scalar> measure_contour(const surface::Contour<Scalar>& contour, const Points<Scalar>& face_normals,
                                     const Vector3<Scalar>& normal) {
    const std::size_t n = contour.points.size();
    CrossSection<Scalar> out;
    out.points.resize(static_cast<Eigen::Index>(n), 3);
    out.normals.resize(static_cast<Eigen::Index>(n), 3);
    out.lengths.resize(static_cast<Eigen::Index>(n));
    const Vector3<Scalar> base = contour.points[0];
    Vector3<Scalar> moment = Vector3<Scalar>::Zero(), mean = Vector3<Scalar>::Zero();
    Scalar area = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const Vector3<Scalar>&p = contour.points[i], &q = contour.points[i + 1 < n ? i + 1 : 0];
        core::set_point(out.points, row, p);
        core::set_point(out.normals, row, core::point(face_normals, contour.faces[i]));
        const Scalar length = out.lengths[row] = (q - p).norm();
        const Scalar twice = normal.dot((p - base).cross(q - base));
        area += twice / 2;
        moment += twice / 6 * ((p - base) + (q - base));
        mean += length * (p + q) / 2;
    }
    out.perimeter = out.lengths.sum();
    out.area = std::abs(area);
    const bool has_area = out.area > core::rounding<Scalar>() * out.perimeter * out.perimeter;
    out.centroid = has_area ? Vector3<Scalar>(base + moment / area) : Vector3<Scalar>(mean / out.perimeter);
    for (std::size_t i = 0; i < n; ++i) {
        const Vector3<Scalar> middle = (contour.points[i] + contour.points[i + 1 < n ? i + 1 : 0]) / 2;
        out.thickness += out.lengths[static_cast<Eigen::Index>(i)] / out.perimeter * (middle - out.centroid).norm();
    }
    return out;
}

} // namespace detail

template <typename Scalar>
std::optional<CrossSection<Scalar>> Slicer<Scalar>::around(const Vector3<Scalar>& point, const Vector3<Scalar>& normal,
                                                           Scalar reach) const {
    const auto contour = surface::contour_around(mesh_, adjacency_, tree_, point, normal, reach);
    if (!contour) return std::nullopt;
    CrossSection<Scalar> section = detail::measure_contour(*contour, normals_, normal);
    if (!(section.perimeter > 0)) return std::nullopt; // a plane that touches a vertex
    return section;
}

template <typename Scalar>
std::optional<Vector3<Scalar>> level_set_centre(const surface::LevelSets<Scalar>& sets, Scalar level,
                                                const Vector3<Scalar>& near, Scalar reach) {
    std::optional<Vector3<Scalar>> centre;
    Scalar longest = 0;
    bool any_near = false;
    for (const surface::Contour<Scalar>& contour : sets.contours(level)) {
        Vector3<Scalar> mean = Vector3<Scalar>::Zero();
        Scalar length = 0;
        for (std::size_t i = 0; i < contour.points.size(); ++i) {
            const Vector3<Scalar>&p = contour.points[i], q = contour.points[(i + 1) % contour.points.size()];
            mean += (q - p).norm() * (p + q) / 2;
            length += (q - p).norm();
        }
        if (!(length > 0)) continue;
        mean /= length;
        const bool is_near = (mean - near).norm() <= reach + length / (2 * std::numbers::pi_v<Scalar>);
        if (any_near && !is_near) continue;
        if (any_near == is_near && length <= longest) continue;
        any_near = is_near;
        longest = length;
        centre = mean;
    }
    return centre;
}

template <typename Scalar>
Scalar gauss_map_flatness(const CrossSection<Scalar>& section) {
    Eigen::Matrix3<Scalar> covariance = Eigen::Matrix3<Scalar>::Zero();
    for (Eigen::Index i = 0; i < section.normals.rows(); ++i)
        core::add_outer_product<Scalar>(covariance, section.lengths[i], core::point(section.normals, i));
    const Scalar trace = covariance.trace();
    if (!(trace > 0)) return Scalar(1) / 3;
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3<Scalar>>(covariance).eigenvalues()[0] / trace;
}

template <typename Scalar>
Scalar egg_shape(const CrossSection<Scalar>& section, const Vector3<Scalar>& direction) {
    const Eigen::VectorX<Scalar> along = section.points * direction;
    return (along.maxCoeff() + along.minCoeff()) / 2 - section.centroid.dot(direction);
}

template <typename Scalar>
Vector3<Scalar> widest_direction(const CrossSection<Scalar>& section) {
    // The area as triangles from its centre, signed by their sense: each has, by Simpson's rule, the moments of its two
    // corners and of their sum.
    std::vector<Vector3<Scalar>> corners;
    Vector3<Scalar> normal = Vector3<Scalar>::Zero();
    const Eigen::Index count = section.points.rows();
    for (Eigen::Index i = 0; i < count; ++i) corners.emplace_back(core::point(section.points, i) - section.centroid);
    const auto next = [&](std::size_t i) { return corners[(i + 1) % corners.size()]; };
    for (std::size_t i = 0; i < corners.size(); ++i) normal += corners[i].cross(next(i));
    Eigen::Matrix3<Scalar> moments = Eigen::Matrix3<Scalar>::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Scalar part = normal.dot(corners[i].cross(next(i)));
        for (const Vector3<Scalar>& q : {corners[i], next(i), Vector3<Scalar>(corners[i] + next(i))})
            core::add_outer_product<Scalar>(moments, part, q);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3<Scalar>> axes(moments);
    const Eigen::Vector3<Scalar> spread = axes.eigenvalues().cwiseMax(Scalar(0)).cwiseSqrt();
    if (!(spread[2] > 0)) return Vector3<Scalar>::Zero();
    return (1 - spread[1] / spread[2]) * axes.eigenvectors().col(2);
}

} // namespace skelgen::refinement
