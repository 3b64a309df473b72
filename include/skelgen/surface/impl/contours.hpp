#pragma once

#include <skelgen/surface/contours.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <skelgen/core/geometry.hpp>

namespace skelgen::surface {
namespace detail {

/// How a function of the vertices, linear on each face, is zero on single faces.
template <typename Scalar, typename Height>
class FaceCutter {
public:
    FaceCutter(const TriangleMesh<Scalar>& mesh, Height height) : mesh_(mesh), height_(std::move(height)) {}

    [[nodiscard]] bool above(int v) const { return height_(v) >= 0; } // a vertex at zero counts as above

    [[nodiscard]] bool is_cut(int f) const {
        const bool first = above(mesh_.faces(f, 0));
        return above(mesh_.faces(f, 1)) != first || above(mesh_.faces(f, 2)) != first;
    }

    /// The edge through which the contour leaves a face that is cut: it runs from above to below.
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
        const Scalar at_a = height_(a), t = at_a / (at_a - height_(b));
        return (1 - t) * core::point(mesh_.vertices, a) + t * core::point(mesh_.vertices, b);
    }

private:
    const TriangleMesh<Scalar>& mesh_;
    Height height_;
};

/// All contours that cut these faces, given in ascending order.
template <typename Scalar, typename Height>
class ContourTracer {
public:
    ContourTracer(const FaceCutter<Scalar, Height>& cutter, const Triangles& adjacency, std::vector<int> cut)
        : cutter_(cutter), adjacency_(adjacency), cut_(std::move(cut)), visited_(cut_.size(), false) {}

    std::vector<Contour<Scalar>> contours() {
        std::vector<Contour<Scalar>> out;
        for (std::size_t i = 0; i < cut_.size(); ++i)
            if (!visited_[i]) out.push_back(trace(cut_[i]));
        return out;
    }

private:
    /// Marks a face as visited; was it before?
    bool visit(int f) {
        const auto place = static_cast<std::size_t>(std::lower_bound(cut_.begin(), cut_.end(), f) - cut_.begin());
        const bool before = visited_[place];
        visited_[place] = true;
        return before;
    }

    Contour<Scalar> trace(int start) {
        int f = start;
        for (int next = f; (next = adjacency_(f, cutter_.entry_edge(f))) >= 0 && next != start;)
            f = next; // to a hole's rim, if any
        Contour<Scalar> contour;
        contour.points.push_back(cutter_.crossing(f, cutter_.entry_edge(f)));
        while (f >= 0 && !visit(f)) {
            contour.faces.push_back(f);
            const int edge = cutter_.exit_edge(f);
            contour.points.push_back(cutter_.crossing(f, edge));
            f = adjacency_(f, edge);
        }
        if (f >= 0)
            contour.points.pop_back(); // closed: back at the first point
        else
            contour.faces.push_back(contour.faces.back()); // the straight closure borrows its neighbour's normal
        return contour;
    }

    const FaceCutter<Scalar, Height>& cutter_;
    const Triangles& adjacency_;
    std::vector<int> cut_;
    std::vector<bool> visited_;
};

/// The contour through one face; none when it is not closed.
template <typename Scalar, typename Height>
std::optional<Contour<Scalar>> closed_contour(const FaceCutter<Scalar, Height>& cutter, const Triangles& adjacency,
                                              int start) {
    Contour<Scalar> contour;
    int f = start;
    do {
        contour.faces.push_back(f);
        const int edge = cutter.entry_edge(f);
        contour.points.push_back(cutter.crossing(f, edge));
        f = adjacency(f, cutter.exit_edge(f));
    } while (f >= 0 && f != start);
    if (f < 0) return std::nullopt;
    return contour;
}

/// Whether the segment from a to b crosses the positive first axis: upwards 1, downwards -1.
template <typename Scalar>
int crossing_of_axis(const Eigen::Matrix<Scalar, 2, 1>& a, const Eigen::Matrix<Scalar, 2, 1>& b) {
    const bool a_below = a[1] < 0, b_below = b[1] < 0;
    if (a_below == b_below) return 0;
    const Scalar twice = a[0] * b[1] - a[1] * b[0];
    if (a_below) return twice > 0 ? 1 : 0;
    return twice < 0 ? -1 : 0;
}

} // namespace detail

template <typename Scalar>
std::vector<Contour<Scalar>> plane_contours(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency,
                                            const FaceTree<Scalar>& tree, const Vector3<Scalar>& normal,
                                            Scalar offset) {
    const auto height = [&](int v) { return normal.dot(core::point(mesh.vertices, v)) - offset; };
    const detail::FaceCutter<Scalar, decltype(height)> cutter(mesh, height);
    return detail::ContourTracer(cutter, adjacency, tree.faces_across(mesh, normal, offset)).contours();
}

template <typename Scalar>
std::vector<Contour<Scalar>> level_contours(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency,
                                            const Eigen::VectorX<Scalar>& field, Scalar level) {
    const auto height = [&](int v) { return field[v] - level; };
    const detail::FaceCutter<Scalar, decltype(height)> cutter(mesh, height);
    std::vector<int> cut;
    for (int f = 0; f < mesh.faces.rows(); ++f)
        if (cutter.is_cut(f)) cut.push_back(f);
    return detail::ContourTracer(cutter, adjacency, std::move(cut)).contours();
}

template <typename Scalar>
PlanarRelation<Scalar> relate(const Contour<Scalar>& contour, const Vector3<Scalar>& point,
                              const Vector3<Scalar>& normal) {
    using Planar = Eigen::Matrix<Scalar, 2, 1>;
    const Vector3<Scalar> u = normal.unitOrthogonal(), v = normal.cross(u);
    const auto planar = [&](const Vector3<Scalar>& p) { return Planar(u.dot(p - point), v.dot(p - point)); };
    PlanarRelation<Scalar> out;
    int windings = 0;
    Scalar squared = std::numeric_limits<Scalar>::infinity();
    Planar a = planar(contour.points.back());
    for (const Vector3<Scalar>& p : contour.points) {
        const Planar b = planar(p);
        out.area += (a[0] * b[1] - a[1] * b[0]) / 2;
        windings += detail::crossing_of_axis<Scalar>(a, b);
        squared = std::min(squared, b.squaredNorm());
        a = b;
    }
    out.distance = std::sqrt(squared);
    out.encloses = windings != 0;
    return out;
}

template <typename Scalar>
std::optional<Contour<Scalar>> contour_around(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency,
                                              const FaceTree<Scalar>& tree, const Vector3<Scalar>& point,
                                              const Vector3<Scalar>& normal, Scalar reach) {
    const Scalar offset = normal.dot(point);
    const auto height = [&](int v) { return normal.dot(core::point(mesh.vertices, v)) - offset; };
    const detail::FaceCutter<Scalar, decltype(height)> cutter(mesh, height);
    // Looking around in the plane, the first face to be seen is on the contour that bounds what is around the point,
    // unless something hollow is seen first.
    const int seen = tree.first_along(mesh, point, normal.unitOrthogonal()).face;
    if (seen >= 0 && cutter.is_cut(seen))
        if (auto contour = detail::closed_contour(cutter, adjacency, seen); contour && contour->points.size() >= 3)
            if (relate(*contour, point, normal).encloses) return contour;

    std::optional<Contour<Scalar>> chosen;
    PlanarRelation<Scalar> best;
    for (Contour<Scalar>& contour : plane_contours(mesh, adjacency, tree, normal, offset)) {
        if (contour.points.size() < 3) continue;
        const PlanarRelation<Scalar> relation = relate(contour, point, normal);
        if (!relation.encloses && relation.distance > reach) continue;
        const bool better =
            !chosen || (relation.encloses && !best.encloses) ||
            (relation.encloses == best.encloses &&
             (relation.encloses ? std::abs(relation.area) < std::abs(best.area) : relation.distance < best.distance));
        if (!better) continue;
        chosen = std::move(contour);
        best = relation;
    }
    return chosen;
}

} // namespace skelgen::surface
