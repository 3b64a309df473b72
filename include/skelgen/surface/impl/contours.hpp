#pragma once

#include <skelgen/surface/contours.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <skelgen/core/geometry.hpp>

namespace skelgen::surface {
namespace detail {

/// A face, and the values at its corners of a function that is linear on it.
template <typename Scalar>
struct FaceHeights {
    int face;
    std::array<int, 3> corners;
    std::array<Scalar, 3> heights;

    [[nodiscard]] bool above(std::size_t k) const { return heights[k] >= 0; } // a vertex at zero counts as above

    /// The edge through which the contour leaves the face, which must be cut: it runs from above to below.
    [[nodiscard]] int exit_edge() const { return above(0) ? (above(1) ? (above(2) ? 0 : 1) : 0) : (above(2) ? 2 : 1); }
    [[nodiscard]] int entry_edge() const { return above(0) ? (above(2) ? 1 : 2) : (above(1) ? 0 : 1); }
};

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

    [[nodiscard]] FaceHeights<Scalar> at(int f) const {
        FaceHeights<Scalar> out{f, {mesh_.faces(f, 0), mesh_.faces(f, 1), mesh_.faces(f, 2)}, {}};
        for (std::size_t k = 0; k < 3; ++k) out.heights[k] = height_(out.corners[k]);
        return out;
    }

    [[nodiscard]] Scalar height(int v) const { return height_(v); }
    [[nodiscard]] const TriangleMesh<Scalar>& mesh() const { return mesh_; }

    /// Where the contour crosses the edge between two vertices of those heights.
    [[nodiscard]] Vector3<Scalar> crossing(int a, Scalar at_a, int b, Scalar at_b) const {
        if (a > b) { // the same point, to the last bit, from both sides
            std::swap(a, b);
            std::swap(at_a, at_b);
        }
        const Scalar t = at_a / (at_a - at_b);
        return (1 - t) * core::point(mesh_.vertices, a) + t * core::point(mesh_.vertices, b);
    }

private:
    const TriangleMesh<Scalar>& mesh_;
    Height height_;
};

/// A walk along a contour from face to face, each of which has one corner that the last one had not. With what is above
/// on the left where faces turn counter-clockwise, or the other way.
template <typename Scalar, typename Height>
class ContourWalk {
public:
    /// Begins in a face that is cut.
    ContourWalk(const FaceCutter<Scalar, Height>& cutter, const Triangles& adjacency, int start, bool backwards)
        : cutter_(cutter), adjacency_(adjacency), face_(start) {
        const FaceHeights<Scalar> at = cutter.at(start);
        const int entry = backwards ? at.exit_edge() : at.entry_edge();
        const auto from = static_cast<std::size_t>(entry), to = (from + 1) % 3;
        above_ = {at.corners[from], at.heights[from]};
        below_ = {at.corners[to], at.heights[to]};
        if (!at.above(from)) std::swap(above_, below_);
    }

    [[nodiscard]] int face() const { return face_; }

    /// Where the contour enters the face.
    [[nodiscard]] Vector3<Scalar> entry() const {
        return cutter_.crossing(above_.vertex, above_.height, below_.vertex, below_.height);
    }

    /// On to the next face, -1 at a hole.
    void go_on() {
        const int* corners = &cutter_.mesh().faces(face_, 0);
        Corner added{corners[0] + corners[1] + corners[2] - above_.vertex - below_.vertex, 0};
        added.height = cutter_.height(added.vertex);
        Corner& left = added.height >= 0 ? above_ : below_;
        const int opposite = left.vertex; // the edge ahead
        left = added;
        face_ = adjacency_(face_, corners[0] == opposite ? 1 : corners[1] == opposite ? 2 : 0);
    }

private:
    struct Corner {
        int vertex = 0;
        Scalar height = 0;
    };
    const FaceCutter<Scalar, Height>& cutter_;
    const Triangles& adjacency_;
    int face_;
    Corner above_, below_; ///< of the edge through which the contour comes into the face
};

/// A contour as far as it was followed.
template <typename Scalar>
struct FollowedContour {
    Contour<Scalar> contour;
    bool is_closed = false;
};

/// The contour from a face that is cut on, around to it again or, with a point more than faces, to a hole.
template <typename Scalar, typename Height>
FollowedContour<Scalar> followed_from(const FaceCutter<Scalar, Height>& cutter, const Triangles& adjacency, int start) {
    constexpr std::size_t usual = 64; // points of a limb's section
    FollowedContour<Scalar> out;
    auto& [points, faces] = out.contour;
    faces.reserve(usual);
    points.reserve(usual);
    ContourWalk<Scalar, Height> walk(cutter, adjacency, start, false);
    do {
        faces.push_back(walk.face());
        points.push_back(walk.entry());
        walk.go_on();
    } while (walk.face() >= 0 && walk.face() != start);
    out.is_closed = walk.face() >= 0;
    if (!out.is_closed) points.push_back(walk.entry());
    return out;
}

/// All of the contour through a face that is cut, from there on or, where it is broken by a hole, from the hole on.
template <typename Scalar, typename Height>
FollowedContour<Scalar> contour_through(const FaceCutter<Scalar, Height>& cutter, const Triangles& adjacency,
                                        int start) {
    FollowedContour<Scalar> out = followed_from(cutter, adjacency, start);
    if (out.is_closed) return out;
    int first = start;
    ContourWalk<Scalar, Height> back(cutter, adjacency, start, true);
    for (back.go_on(); back.face() >= 0; back.go_on()) first = back.face();
    if (first != start) out = followed_from(cutter, adjacency, first);
    std::vector<int>& faces = out.contour.faces;
    faces.push_back(faces.back()); // the straight closure borrows its neighbour's normal
    return out;
}

/// The contour, if closed, from the face on that follows after this one.
template <typename Scalar>
Contour<Scalar> from_behind(int face, FollowedContour<Scalar> given) {
    auto& [points, faces] = given.contour;
    if (given.is_closed) {
        const auto next = std::find(faces.begin(), faces.end(), face) - faces.begin() + 1;
        std::rotate(faces.begin(), faces.begin() + next, faces.end());
        std::rotate(points.begin(), points.begin() + next, points.end());
    }
    return std::move(given.contour);
}

/// Those of all contours that cut one of these faces, which are cut, in ascending order; by their lowest face.
template <typename Scalar, typename Height>
std::vector<Contour<Scalar>> contours_through(const FaceCutter<Scalar, Height>& cutter, const Triangles& adjacency,
                                              const std::vector<int>& cut) {
    std::vector<std::pair<int, Contour<Scalar>>> found; // by the lowest face
    std::vector<bool> visited(cut.size(), false);
    for (std::size_t i = 0; i < cut.size(); ++i) {
        if (visited[i]) continue;
        FollowedContour<Scalar> whole = contour_through(cutter, adjacency, cut[i]);
        const std::vector<int>& faces = whole.contour.faces;
        for (const int f : faces)
            if (const auto place = std::lower_bound(cut.begin(), cut.end(), f); place != cut.end() && *place == f)
                visited[static_cast<std::size_t>(place - cut.begin())] = true;
        const int lowest = *std::min_element(faces.begin(), faces.end());
        found.emplace_back(lowest, from_behind(lowest, std::move(whole)));
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Contour<Scalar>> out;
    for (auto& [lowest, contour] : found) out.push_back(std::move(contour));
    return out;
}

/// Those of some faces that are cut, in ascending order, each once.
template <typename Scalar, typename Height>
std::vector<int> cut_faces(const FaceCutter<Scalar, Height>& cutter, std::vector<int> faces) {
    std::erase_if(faces, [&](int f) { return !cutter.is_cut(f); });
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

/// Whether the segment from a to b crosses the positive first axis: upwards 1, downwards -1.
template <typename Scalar>
int crossing_of_axis(const std::array<Scalar, 2>& a, const std::array<Scalar, 2>& b) {
    const bool a_below = a[1] < 0, b_below = b[1] < 0;
    if (a_below == b_below) return 0;
    const Scalar twice = a[0] * b[1] - a[1] * b[0];
    if (a_below) return twice > 0 ? 1 : 0;
    return twice < 0 ? -1 : 0;
}

} // namespace detail

template <typename Scalar>
LevelSets<Scalar>::LevelSets(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency, Eigen::VectorX<Scalar> field)
    : mesh_(mesh), adjacency_(adjacency), field_(std::move(field)) {
    struct Varying {
        int face;
        Scalar low;
    };
    std::vector<Varying> varying; // faces on which the field is not constant
    Scalar highest = lowest_ = field_.size() > 0 ? field_[0] : Scalar(0);
    for (int f = 0; f < static_cast<int>(mesh.faces.rows()); ++f) {
        const Scalar a = field_[mesh.faces(f, 0)], b = field_[mesh.faces(f, 1)], c = field_[mesh.faces(f, 2)];
        const Scalar low = std::min(std::min(a, b), c), high = std::max(std::max(a, b), c);
        lowest_ = std::min(lowest_, low);
        if (!(low < high)) continue;
        varying.push_back({f, low});
        highest = std::max(highest, low);
        steepest_ = std::max(steepest_, high - low);
    }
    if (!(steepest_ > 0)) return;
    begin_.assign(bin_of(highest) + 2, 0);
    for (const Varying& each : varying) ++begin_[bin_of(each.low) + 1];
    for (std::size_t bin = 1; bin < begin_.size(); ++bin) begin_[bin] += begin_[bin - 1];
    faces_.resize(begin_.back());
    std::vector<std::size_t> next = begin_;
    for (const Varying& each : varying) faces_[next[bin_of(each.low)]++] = each.face;
}

template <typename Scalar>
std::vector<Contour<Scalar>> LevelSets<Scalar>::contours(Scalar level) const {
    if (begin_.empty() || level < lowest_) return {};
    const auto height = [&](int v) { return field_[v] - level; };
    const detail::FaceCutter<Scalar, decltype(height)> cutter(mesh_, height);
    constexpr std::size_t bins = 3; // with two, rounding might leave a face out
    const std::size_t bin_count = begin_.size() - 1;
    const std::size_t end =
        (level - lowest_) / steepest_ < static_cast<Scalar>(bin_count) ? bin_of(level) + 1 : bin_count;
    std::vector<int> cut;
    for (std::size_t i = begin_[end > bins ? end - bins : 0]; i < begin_[end]; ++i)
        if (cutter.is_cut(faces_[i])) cut.push_back(faces_[i]);
    std::sort(cut.begin(), cut.end());
    return detail::contours_through(cutter, adjacency_, cut);
}

template <typename Scalar>
PlanarRelation<Scalar> relate(const Contour<Scalar>& contour, const Vector3<Scalar>& point,
                              const Vector3<Scalar>& normal) {
    const Vector3<Scalar> u = normal.unitOrthogonal(), v = normal.cross(u);
    const auto planar = [&](const Vector3<Scalar>& p) {
        const Scalar x = p[0] - point[0], y = p[1] - point[1], z = p[2] - point[2];
        return std::array<Scalar, 2>{u[0] * x + (u[1] * y + u[2] * z), v[0] * x + (v[1] * y + v[2] * z)};
    };
    PlanarRelation<Scalar> out;
    int windings = 0;
    Scalar squared = std::numeric_limits<Scalar>::infinity();
    std::array<Scalar, 2> a = planar(contour.points.back());
    for (const Vector3<Scalar>& p : contour.points) {
        const std::array<Scalar, 2> b = planar(p);
        out.area += (a[0] * b[1] - a[1] * b[0]) / 2;
        windings += detail::crossing_of_axis<Scalar>(a, b);
        squared = std::min(squared, b[0] * b[0] + b[1] * b[1]);
        a = b;
    }
    out.distance = std::sqrt(squared);
    out.encloses = windings != 0;
    return out;
}

template <typename Scalar>
std::optional<ContourAround<Scalar>> contour_around(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency,
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
        if (auto found = detail::followed_from(cutter, adjacency, seen);
            found.is_closed && found.contour.points.size() >= 3)
            if (const auto relation = relate(found.contour, point, normal); relation.encloses)
                return ContourAround<Scalar>{std::move(found.contour), relation};

    std::optional<ContourAround<Scalar>> chosen;
    Scalar least = std::numeric_limits<Scalar>::infinity();
    const auto choose = [&](Contour<Scalar>& contour, const PlanarRelation<Scalar>& relation, Scalar size) {
        if (!(size < least)) return;
        chosen = {std::move(contour), relation};
        least = size;
    };
    // What encloses the point is seen in any direction, though perhaps behind others, but for one that has a hole
    // there.
    std::vector<int> around = tree.faces_along(mesh, point, direction);
    const std::vector<int> behind = tree.faces_along(mesh, point, -direction);
    around.insert(around.end(), behind.begin(), behind.end());
    for (Contour<Scalar>& contour :
         detail::contours_through(cutter, adjacency, detail::cut_faces(cutter, std::move(around))))
        if (contour.points.size() >= 3)
            if (const auto relation = relate(contour, point, normal); relation.encloses)
                choose(contour, relation, std::abs(relation.area));
    if (chosen) return chosen;
    for (Contour<Scalar>& contour : detail::contours_through(
             cutter, adjacency, detail::cut_faces(cutter, tree.faces_across(mesh, normal, offset, point, reach))))
        if (contour.points.size() >= 3)
            if (const auto relation = relate(contour, point, normal); relation.distance <= reach)
                choose(contour, relation, relation.distance);
    return chosen;
}

} // namespace skelgen::surface
