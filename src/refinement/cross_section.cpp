#include <skelgen/refinement/cross_section.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Eigenvalues>

#include <skelgen/core/geometry.hpp>

namespace skelgen {
namespace {

/// A contour in face order, before its measures are known.
struct Contour {
    std::vector<Vector3<double>> points;
    std::vector<int> faces; ///< faces[i] carries the segment from points[i] to points[i + 1]
};

class Tracer {
public:
    /// Contours where the field `height`, linear on each face, is zero.
    Tracer(const TriangleMesh<double>& mesh, const Triangles& adjacency, Eigen::VectorXd height)
        : mesh_(mesh), adjacency_(adjacency), height_(std::move(height)),
          visited_(static_cast<std::size_t>(mesh.faces.rows()), false) {}

    std::vector<Contour> contours() {
        std::vector<Contour> out;
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

    [[nodiscard]] Vector3<double> crossing(int f, int edge) const {
        int a = mesh_.faces(f, edge), b = mesh_.faces(f, (edge + 1) % 3);
        if (a > b) std::swap(a, b); // the same point, to the last bit, from both sides
        const double t = height_[a] / (height_[a] - height_[b]);
        return ((1 - t) * mesh_.vertices.row(a) + t * mesh_.vertices.row(b)).transpose();
    }

    Contour trace(int start) {
        int f = start;
        for (int next = f; (next = adjacency_(f, entry_edge(f))) >= 0 && next != start;)
            f = next; // to a hole's rim, if any
        Contour contour;
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

    const TriangleMesh<double>& mesh_;
    const Triangles& adjacency_;
    Eigen::VectorXd height_;
    std::vector<bool> visited_;
};

/// Signed area around `point`, and whether the contour winds around it.
struct PlanarRelation {
    double area = 0;
    double distance = std::numeric_limits<double>::infinity(); ///< from the point to the nearest contour vertex
    bool encloses = false;
};

PlanarRelation relate(const Contour& contour, const Vector3<double>& point, const Vector3<double>& normal) {
    PlanarRelation out;
    double angle = 0;
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
        const Vector3<double> a = contour.points[i] - point,
                              b = contour.points[(i + 1) % contour.points.size()] - point;
        const double cross = normal.dot(a.cross(b));
        out.area += cross / 2;
        angle += std::atan2(cross, a.dot(b));
        out.distance = std::min(out.distance, a.norm());
    }
    out.encloses = std::abs(angle) > EIGEN_PI;
    return out;
}

CrossSection measure(const Contour& contour, const TriangleMesh<double>& mesh, const Vector3<double>& normal) {
    const std::size_t n = contour.points.size();
    CrossSection out;
    out.points.resize(static_cast<Eigen::Index>(n), 3);
    out.normals.resize(static_cast<Eigen::Index>(n), 3);
    out.lengths.resize(static_cast<Eigen::Index>(n));
    const Vector3<double> base = contour.points[0];
    Vector3<double> moment = Vector3<double>::Zero(), mean = Vector3<double>::Zero();
    double area = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const Vector3<double>&p = contour.points[i], q = contour.points[(i + 1) % n];
        out.points.row(row) = p.transpose();
        out.normals.row(row) = face_area_vector(mesh, contour.faces[i]).normalized().transpose();
        out.lengths[row] = (q - p).norm();
        const double twice = normal.dot((p - base).cross(q - base));
        area += twice / 2;
        moment += twice / 6 * ((p - base) + (q - base));
        mean += out.lengths[row] * (p + q) / 2;
    }
    out.perimeter = out.lengths.sum();
    out.area = std::abs(area);
    const bool has_area = out.area > 1e-9 * out.perimeter * out.perimeter;
    out.centroid = has_area ? Vector3<double>(base + moment / area) : Vector3<double>(mean / out.perimeter);
    for (Eigen::Index i = 0; i < out.points.rows(); ++i) {
        const Vector3<double> middle =
            (out.points.row(i) + out.points.row((i + 1) % out.points.rows())).transpose() / 2;
        out.thickness += out.lengths[i] / out.perimeter * (middle - out.centroid).norm();
    }
    return out;
}

} // namespace

std::optional<CrossSection> Slicer::around(const Vector3<double>& point, const Vector3<double>& normal,
                                           double reach) const {
    const std::vector<Contour> contours =
        Tracer(mesh_, adjacency_, (mesh_.vertices * normal).array() - point.dot(normal)).contours();
    const Contour* chosen = nullptr;
    PlanarRelation best;
    for (const Contour& contour : contours) {
        if (contour.points.size() < 3) continue;
        const PlanarRelation relation = relate(contour, point, normal);
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
    CrossSection section = measure(*chosen, mesh_, normal);
    if (!(section.perimeter > 0)) return std::nullopt; // a plane that touches a vertex
    return section;
}

std::optional<Vector3<double>> Slicer::level_set_centre(const Eigen::VectorXd& field, double level,
                                                        const Vector3<double>& near, double reach) const {
    std::optional<Vector3<double>> centre;
    double longest = 0;
    bool any_near = false;
    for (const Contour& contour : Tracer(mesh_, adjacency_, field.array() - level).contours()) {
        Vector3<double> mean = Vector3<double>::Zero();
        double length = 0;
        for (std::size_t i = 0; i < contour.points.size(); ++i) {
            const Vector3<double>&p = contour.points[i], q = contour.points[(i + 1) % contour.points.size()];
            mean += (q - p).norm() * (p + q) / 2;
            length += (q - p).norm();
        }
        if (!(length > 0)) continue;
        mean /= length;
        const bool is_near = (mean - near).norm() <= reach + length / (2 * EIGEN_PI);
        if (any_near && !is_near) continue;
        if (any_near == is_near && length <= longest) continue;
        any_near = is_near;
        longest = length;
        centre = mean;
    }
    return centre;
}

double gauss_map_flatness(const CrossSection& section) {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (Eigen::Index i = 0; i < section.normals.rows(); ++i)
        covariance += section.lengths[i] * section.normals.row(i).transpose() * section.normals.row(i);
    const double trace = covariance.trace();
    if (!(trace > 0)) return 1.0 / 3;
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()[0] / trace;
}

double egg_shape(const CrossSection& section, const Vector3<double>& direction) {
    const Eigen::VectorXd along = section.points * direction;
    return (along.maxCoeff() + along.minCoeff()) / 2 - section.centroid.dot(direction);
}

} // namespace skelgen
