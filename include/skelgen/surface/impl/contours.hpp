#pragma once

#include <skelgen/surface/contours.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_set>
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

/// The contour through a face that is cut, from the next face on or, where it is broken by a hole, from the hole on.
template <typename Scalar, typename Height>
Contour<Scalar> contour_through(const FaceCutter<Scalar, Height>& cutter, const Triangles& adjacency, int start) {
    int f = start;
    for (int next = f; (next = adjacency(f, cutter.entry_edge(f))) >= 0 && next != start;) f = next;
    const int first = f;
    Contour<Scalar> contour;
    contour.points.push_back(cutter.crossing(f, cutter.entry_edge(f)));
    do {
        contour.faces.push_back(f);
        const int edge = cutter.exit_edge(f);
        contour.points.push_back(cutter.crossing(f, edge));
        f = adjacency(f, edge);
    } while (f >= 0 && f != first);
    if (f >= 0)
        contour.points.pop_back(); // back at the first point
    else
        contour.faces.push_back(contour.faces.back()); // the straight closure borrows its neighbour's normal
    return contour;
}

/// All contours that cut these faces, which are all that are cut, in ascending order.
template <typename Scalar, typename Height>
std::vector<Contour<Scalar>> all_contours(const FaceCutter<Scalar, Height>& cutter, const Triangles& adjacency,
                                          const std::vector<int>& cut) {
    std::vector<Contour<Scalar>> out;
    std::vector<bool> visited(cut.size(), false);
    for (std::size_t i = 0; i < cut.size(); ++i) {
        if (visited[i]) continue;
        out.push_back(contour_through(cutter, adjacency, cut[i]));
        for (const int f : out.back().faces)
            visited[static_cast<std::size_t>(std::lower_bound(cut.begin(), cut.end(), f) - cut.begin())] = true;
    }
    return out;
}

/// Those of all contours that cut one of these faces, in the order they have among all.
template <typename Scalar, typename Height>
std::vector<Contour<Scalar>> contours_through(const FaceCutter<Scalar, Height>& cutter, const Triangles& adjacency,
                                              const std::vector<int>& faces) {
    std::vector<std::pair<int, Contour<Scalar>>> found; // by the lowest face
    std::unordered_set<int> visited;
    for (const int f : faces) {
        if (!cutter.is_cut(f) || visited.contains(f)) continue;
        Contour<Scalar> contour = contour_through(cutter, adjacency, f);
        const int lowest = *std::min_element(contour.faces.begin(), contour.faces.end());
        if (lowest != f) contour = contour_through(cutter, adjacency, lowest);
        visited.insert(contour.faces.begin(), contour.faces.end());
        found.emplace_back(lowest, std::move(contour));
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Contour<Scalar>> out;
    for (auto& [lowest, contour] : found) out.push_back(std::move(contour));
    return out;
}

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
    return detail::all_contours(cutter, adjacency, tree.faces_across(mesh, normal, offset));
}

template <typename Scalar>
std::vector<Contour<Scalar>> level_contours(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency,
                                            const Eigen::VectorX<Scalar>& field, Scalar level) {
    const auto height = [&](int v) { return field[v] - level; };
    const detail::FaceCutter<Scalar, decltype(height)> cutter(mesh, height);
    std::vector<int> cut;
    for (int f = 0; f < mesh.faces.rows(); ++f)
        if (cutter.is_cut(f)) cut.push_back(f);
    return detail::all_contours(cutter, adjacency, cut);
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
    const Vector3<Scalar> direction = normal.unitOrthogonal();
    const int seen = tree.first_along(mesh, point, direction).face;
    if (seen >= 0 && cutter.is_cut(seen))
        if (auto contour = detail::closed_contour(cutter, adjacency, seen); contour && contour->points.size() >= 3)
            if (relate(*contour, point, normal).encloses) return contour;

    std::optional<Contour<Scalar>> chosen;
    Scalar least = std::numeric_limits<Scalar>::infinity();
    const auto choose = [&](Contour<Scalar>& contour, Scalar size) {
        if (!(size < least)) return;
        chosen = std::move(contour);
        least = size;
    };
    // What encloses the point is seen in any direction, though perhaps behind others, but for one that has a hole
    // there.
    std::vector<int> around = tree.faces_along(mesh, point, direction);
    const std::vector<int> behind = tree.faces_along(mesh, point, -direction);
    around.insert(around.end(), behind.begin(), behind.end());
    for (Contour<Scalar>& contour : detail::contours_through(cutter, adjacency, around))
        if (contour.points.size() >= 3)
            if (const auto relation = relate(contour, point, normal); relation.encloses)
                choose(contour, std::abs(relation.area));
    if (chosen) return chosen;
    for (Contour<Scalar>& contour :
         detail::contours_through(cutter, adjacency, tree.faces_across(mesh, normal, offset, point, reach)))
        if (contour.points.size() >= 3)
            if (const auto relation = relate(contour, point, normal); relation.distance <= reach)
                choose(contour, relation.distance);
    return chosen;
}

} // namespace skelgen::surface
