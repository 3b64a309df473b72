#pragma once

#include <skelgen/refinement/cross_section.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::refinement {
namespace detail {

/// A contour in face order, before its measures are known.
template <typename Scalar>
struct Contour {
    std::vector<Vector3<Scalar>> points;
    std::vector<int> faces; ///< faces[i] carries the segment from points[i] to points[i + 1]
};

/// Follows the contours where a field, linear on each face, is zero.
template <typename Scalar>
class ContourTracer {
public:
    ContourTracer(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency, Eigen::VectorX<Scalar> height)
        : mesh_(mesh), adjacency_(adjacency), height_(std::move(height)),
          visited_(static_cast<std::size_t>(mesh.faces.rows()), false) {}

    std::vector<Contour<Scalar>> contours() {
        std::vector<Contour<Scalar>> out;
        for (Eigen::Index f = 0; f < mesh_.faces.rows(); ++f)
            if (is_cut(f) && !visited_[static_cast<std::size_t>(f)]) out.push_back(trace(static_cast<int>(f)));
        return out;
    }

private:
    [[nodiscard]] bool above(int v) const { return height_[v] >= 0; } // a vertex in the plane counts as above

    [[nodiscard]] bool is_cut(Eigen::Index f) const {
        const bool a = above(mesh_.faces(f, 0));
        return above(mesh_.faces(f, 1)) != a || above(mesh_.faces(f, 2)) != a;
    }

    /// The edge through which the contour leaves face `f`: it runs from above to below.
    [[nodiscard]] int exit_edge(int f) const {
        for (int k = 0; k < 3; ++k)
            if (above(mesh_.faces(f, k)) && !above(mesh_.faces(f, (k + 1) % 3))) return k;
        return 0;
    }
    [[nodiscard]] int entry_edge(int f) const {
        for (int k = 0; k < 3; ++k)
            if (!above(mesh_.faces(f, k)) && above(mesh_.faces(f, (k + 1) % 3))) return k;
        return 0;
    }

    [[nodiscard]] Vector3<Scalar> crossing(int f, int edge) const {
        int a = mesh_.faces(f, edge), b = mesh_.faces(f, (edge + 1) % 3);
        if (a > b) std::swap(a, b); // the same point, to the last bit, from both sides
        const Scalar t = height_[a] / (height_[a] - height_[b]);
        return ((1 - t) * mesh_.vertices.row(a) + t * mesh_.vertices.row(b)).transpose();
    }

    Contour<Scalar> trace(int start) {
        int f = start;
        for (int next = f; (next = adjacency_(f, entry_edge(f))) >= 0 && next != start;)
            f = next; // to a hole's rim, if any
        Contour<Scalar> contour;
        contour.points.push_back(crossing(f, entry_edge(f)));
        while (f >= 0 && !visited_[static_cast<std::size_t>(f)]) {
            visited_[static_cast<std::size_t>(f)] = true;
            contour.faces.push_back(f);
            const int edge = exit_edge(f);
            contour.points.push_back(crossing(f, edge));
            f = adjacency_(f, edge);
        }
        if (f >= 0)
            contour.points.pop_back(); // closed: back at the first point
        else
            contour.faces.push_back(contour.faces.back()); // the straight closure borrows its neighbour's normal
        return contour;
    }

    const TriangleMesh<Scalar>& mesh_;
    const Triangles& adjacency_;
    Eigen::VectorX<Scalar> height_;
    std::vector<bool> visited_;
};

/// Signed area around a point, and whether the contour winds around it.
template <typename Scalar>
struct PlanarRelation {
    Scalar area = 0;
    Scalar distance = std::numeric_limits<Scalar>::infinity(); ///< from the point to the nearest contour vertex
    bool encloses = false;
};

template <typename Scalar>
PlanarRelation<Scalar> relate(const Contour<Scalar>& contour, const Vector3<Scalar>& point,
                              const Vector3<Scalar>& normal) {
    PlanarRelation<Scalar> out;
    Scalar angle = 0;
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
        const Vector3<Scalar> a = contour.points[i] - point,
                              b = contour.points[(i + 1) % contour.points.size()] - point;
        const Scalar cross = normal.dot(a.cross(b));
        out.area += cross / 2;
        angle += std::atan2(cross, a.dot(b));
        out.distance = std::min(out.distance, a.norm());
    }
    out.encloses = std::abs(angle) > std::numbers::pi_v<Scalar>; // it is 0 or a multiple of twice that
    return out;
}

template <typename Scalar>
CrossSection<Scalar> measure_contour(const Contour<Scalar>& contour, const TriangleMesh<Scalar>& mesh,
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
        const Vector3<Scalar>&p = contour.points[i], q = contour.points[(i + 1) % n];
        out.points.row(row) = p.transpose();
        out.normals.row(row) = core::face_area_vector(mesh, contour.faces[i]).normalized().transpose();
        out.lengths[row] = (q - p).norm();
        const Scalar twice = normal.dot((p - base).cross(q - base));
        area += twice / 2;
        moment += twice / 6 * ((p - base) + (q - base));
        mean += out.lengths[row] * (p + q) / 2;
    }
    out.perimeter = out.lengths.sum();
    out.area = std::abs(area);
    const bool has_area = out.area > core::rounding<Scalar>() * out.perimeter * out.perimeter;
    out.centroid = has_area ? Vector3<Scalar>(base + moment / area) : Vector3<Scalar>(mean / out.perimeter);
    for (Eigen::Index i = 0; i < out.points.rows(); ++i) {
        const Vector3<Scalar> middle =
            (out.points.row(i) + out.points.row((i + 1) % out.points.rows())).transpose() / 2;
        out.thickness += out.lengths[i] / out.perimeter * (middle - out.centroid).norm();
    }
    return out;
}

} // namespace detail

template <typename Scalar>
std::optional<CrossSection<Scalar>> Slicer<Scalar>::around(const Vector3<Scalar>& point, const Vector3<Scalar>& normal,
                                                           Scalar reach) const {
    const std::vector<detail::Contour<Scalar>> contours =
        detail::ContourTracer<Scalar>(mesh_, adjacency_, (mesh_.vertices * normal).array() - point.dot(normal))
            .contours();
    const detail::Contour<Scalar>* chosen = nullptr;
    detail::PlanarRelation<Scalar> best;
    for (const detail::Contour<Scalar>& contour : contours) {
        if (contour.points.size() < 3) continue;
        const detail::PlanarRelation<Scalar> relation = detail::relate(contour, point, normal);
        if (!relation.encloses && relation.distance > reach) continue;
        const bool better =
            chosen == nullptr || (relation.encloses && !best.encloses) ||
            (relation.encloses == best.encloses &&
             (relation.encloses ? std::abs(relation.area) < std::abs(best.area) : relation.distance < best.distance));
        if (!better) continue;
        chosen = &contour;
        best = relation;
    }
    if (chosen == nullptr) return std::nullopt;
    CrossSection<Scalar> section = detail::measure_contour(*chosen, mesh_, normal);
    if (!(section.perimeter > 0)) return std::nullopt; // a plane that touches a vertex
    return section;
}

template <typename Scalar>
std::optional<Vector3<Scalar>> Slicer<Scalar>::level_set_centre(const Eigen::VectorX<Scalar>& field, Scalar level,
                                                                const Vector3<Scalar>& near, Scalar reach) const {
    std::optional<Vector3<Scalar>> centre;
    Scalar longest = 0;
    bool any_near = false;
    for (const detail::Contour<Scalar>& contour :
         detail::ContourTracer<Scalar>(mesh_, adjacency_, field.array() - level).contours()) {
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

} // namespace skelgen::refinement
