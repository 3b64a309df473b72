#pragma once

#include <skelgen/surface/face_tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <skelgen/core/geometry.hpp>

namespace skelgen::surface {
namespace detail {

template <typename Scalar>
using Box = Eigen::AlignedBox<Scalar, 3>;

/// The faces that a plane cuts.
template <typename Scalar>
struct PlaneQuery {
    const TriangleMesh<Scalar>& mesh;
    Vector3<Scalar> normal;
    Scalar offset;
    std::vector<int> found;

    [[nodiscard]] bool intersectVolume(const Box<Scalar>& box) const {
        Scalar middle = -offset, reach = 0;
        for (int k = 0; k < 3; ++k) {
            middle += normal[k] * (box.min()[k] + box.max()[k]) / 2;
            reach += std::abs(normal[k]) * (box.max()[k] - box.min()[k]) / 2;
        }
        // What rounding may add: a face that is cut must not be missed.
        constexpr Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon();
        return std::abs(middle) <= reach + rounding * (reach + std::abs(offset));
    }

    bool intersectObject(int face) {
        int above = 0;
        for (int k = 0; k < 3; ++k) above += normal.dot(core::point(mesh.vertices, mesh.faces(face, k))) >= offset;
        if (above == 1 || above == 2) found.push_back(face);
        return false;
    }
};

/// The faces that a plane cuts near a place.
template <typename Scalar>
struct NearPlaneQuery {
    PlaneQuery<Scalar> across;
    Vector3<Scalar> place;
    Scalar reach;

    [[nodiscard]] bool intersectVolume(const Box<Scalar>& box) const {
        constexpr Scalar rounded_up = 1 + 64 * std::numeric_limits<Scalar>::epsilon();
        return box.squaredExteriorDistance(place) <= reach * reach * rounded_up && across.intersectVolume(box);
    }
    bool intersectObject(int face) { return across.intersectObject(face); }
};

/// What a ray meets.
template <typename Scalar>
struct Ray {
    const TriangleMesh<Scalar>& mesh;
    Vector3<Scalar> place, direction;

    [[nodiscard]] bool meets(const Box<Scalar>& box, Scalar farthest) const {
        Scalar enter = 0, leave = farthest;
        for (int k = 0; k < 3; ++k) {
            if (direction[k] == 0) {
                if (place[k] < box.min()[k] || place[k] > box.max()[k]) return false;
                continue;
            }
            const Scalar a = (box.min()[k] - place[k]) / direction[k], b = (box.max()[k] - place[k]) / direction[k];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return enter <= leave * (1 + 64 * std::numeric_limits<Scalar>::epsilon());
    }

    /// How the ray's line passes a face.
    struct Passage {
        bool meets;      ///< inside of it or, as far as rounding tells, at its border
        bool is_certain; ///< whether rounding leaves no doubt of that
        bool leaves;     ///< from its inner side to its outer one
        Scalar distance; ///< from the place, along the ray; -1 where it does not meet
    };
    [[nodiscard]] Passage past(int face) const {
        const auto corner = [&](int k) { return core::point(mesh.vertices, mesh.faces(face, k)); };
        const Vector3<Scalar> a = corner(0) - place, b = corner(1) - place, c = corner(2) - place;
        // Volumes of the tetrahedra over the triangle's edges: of one sign where the ray's line passes it inside.
        const Scalar u = direction.dot(b.cross(c)), v = direction.dot(c.cross(a)), w = direction.dot(a.cross(b));
        // Through a corner, the signs are rounding's: no ray must slip between the faces there.
        const Scalar la = a.norm(), lb = b.norm(), lc = c.norm();
        const Scalar none = 32 * std::numeric_limits<Scalar>::epsilon() * (la * lb + lb * lc + lc * la);
        const Scalar least = std::min({u, v, w}), most = std::max({u, v, w}), sum = u + v + w;
        const bool is_certain = least > none || most < -none || (least < -none && most > none);
        if ((least < -none && most > none) || sum == 0) return {false, is_certain, false, -1};
        return {true, is_certain, sum > 0, direction.dot(u * a + v * b + w * c) / sum};
    }
};

/// The first face on a ray.
template <typename Scalar>
struct FirstAlong {
    Ray<Scalar> ray;
    typename FaceTree<Scalar>::Hit first;

    [[nodiscard]] bool intersectVolume(const Box<Scalar>& box) const { return ray.meets(box, first.distance); }
    bool intersectObject(int face) {
        const Scalar distance = ray.past(face).distance;
        if (distance >= 0 && distance < first.distance) first = {face, distance};
        return false;
    }
};

/// All faces on a ray.
template <typename Scalar>
struct AllAlong {
    Ray<Scalar> ray;
    std::vector<int> found;

    [[nodiscard]] bool intersectVolume(const Box<Scalar>& box) const {
        return ray.meets(box, std::numeric_limits<Scalar>::max());
    }
    bool intersectObject(int face) {
        if (ray.past(face).distance >= 0) found.push_back(face);
        return false;
    }
};

/// Counts how often a ray leaves a surface, and comes in.
template <typename Scalar>
struct WindingsAlong {
    Ray<Scalar> ray;
    int windings = 0;
    bool is_certain = true;

    [[nodiscard]] bool intersectVolume(const Box<Scalar>& box) const {
        return ray.meets(box, std::numeric_limits<Scalar>::max());
    }
    bool intersectObject(int face) {
        const auto passage = ray.past(face);
        is_certain = is_certain && passage.is_certain;
        if (passage.distance >= 0) windings += passage.leaves ? 1 : -1;
        return !is_certain; // then nothing more is to be counted
    }
};

/// Finds the distance from a place to the nearest face. Eigen::BVMinimize keeps a queue of boxes, nearest first; going
/// down into the nearer box first and leaving out what is farther than the nearest face so far takes a third of its
/// time.
template <typename Scalar>
class NearestFace {
public:
    using Tree = Eigen::KdBVH<Scalar, 3, int>;

    NearestFace(const TriangleMesh<Scalar>& mesh, const Tree& tree, const Vector3<Scalar>& place)
        : mesh_(mesh), tree_(tree), place_(place) {}

    Scalar distance() {
        go_down(tree_.getRootIndex());
        return least_;
    }

private:
    void go_down(int box) {
        typename Tree::VolumeIterator boxes = nullptr, boxes_end = nullptr;
        typename Tree::ObjectIterator faces = nullptr, faces_end = nullptr;
        tree_.getChildren(box, boxes, boxes_end, faces, faces_end);
        for (; faces != faces_end; ++faces) {
            const auto corner = [&](int k) { return core::point(mesh_.vertices, mesh_.faces(*faces, k)); };
            least_ = std::min(least_, distance_to_triangle<Scalar>(place_, corner(0), corner(1), corner(2)));
        }
        std::array<std::pair<Scalar, int>, 2> children; // a box has no more
        std::size_t count = 0;
        for (; boxes != boxes_end; ++boxes)
            children[count++] = {tree_.getVolume(*boxes).squaredExteriorDistance(place_), *boxes};
        if (count == 2 && children[1] < children[0]) std::swap(children[0], children[1]);
        for (std::size_t i = 0; i < count; ++i)
            if (children[i].first < least_ * least_) go_down(children[i].second);
    }

    const TriangleMesh<Scalar>& mesh_;
    const Tree& tree_;
    Vector3<Scalar> place_;
    Scalar least_ = std::numeric_limits<Scalar>::infinity();
};

} // namespace detail

template <typename Scalar>
Scalar distance_to_triangle(const Vector3<Scalar>& place, const Vector3<Scalar>& a, const Vector3<Scalar>& b,
                            const Vector3<Scalar>& c) {
    const Vector3<Scalar> normal = (b - a).cross(c - a);
    const Scalar area = normal.norm();
    // Beside the triangle, or above it where its plane is not known, an edge is nearest.
    const bool over_ab = normal.dot((b - a).cross(place - a)) >= 0, over_bc = normal.dot((c - b).cross(place - b)) >= 0,
               over_ca = normal.dot((a - c).cross(place - c)) >= 0;
    if (area > 0 && over_ab && over_bc && over_ca) return std::abs(normal.dot(place - a)) / area;
    return std::min({core::nearest_on_segment(place, a, b).distance, core::nearest_on_segment(place, b, c).distance,
                     core::nearest_on_segment(place, c, a).distance});
}

template <typename Scalar>
FaceTree<Scalar>::FaceTree(const TriangleMesh<Scalar>& mesh) {
    std::vector<int> faces(static_cast<std::size_t>(mesh.faces.rows()));
    std::iota(faces.begin(), faces.end(), 0);
    std::vector<detail::Box<Scalar>> boxes(faces.size());
    for (const int f : faces)
        for (int k = 0; k < 3; ++k)
            boxes[static_cast<std::size_t>(f)].extend(core::point(mesh.vertices, mesh.faces(f, k)));
    tree_.init(faces.begin(), faces.end(), boxes.begin(), boxes.end());
}

template <typename Scalar>
std::vector<int> FaceTree<Scalar>::faces_across(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& normal,
                                                Scalar offset) const {
    detail::PlaneQuery<Scalar> query{mesh, normal, offset, {}};
    Eigen::BVIntersect(tree_, query);
    std::sort(query.found.begin(), query.found.end());
    return std::move(query.found);
}

template <typename Scalar>
std::vector<int> FaceTree<Scalar>::faces_across(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& normal,
                                                Scalar offset, const Vector3<Scalar>& place, Scalar reach) const {
    detail::NearPlaneQuery<Scalar> query{{mesh, normal, offset, {}}, place, reach};
    Eigen::BVIntersect(tree_, query);
    std::sort(query.across.found.begin(), query.across.found.end());
    return std::move(query.across.found);
}

template <typename Scalar>
Scalar FaceTree<Scalar>::distance(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place) const {
    return mesh.faces.rows() == 0 ? std::numeric_limits<Scalar>::infinity()
                                  : detail::NearestFace<Scalar>(mesh, tree_, place).distance();
}

template <typename Scalar>
typename FaceTree<Scalar>::Hit FaceTree<Scalar>::first_along(const TriangleMesh<Scalar>& mesh,
                                                             const Vector3<Scalar>& place,
                                                             const Vector3<Scalar>& direction) const {
    detail::FirstAlong<Scalar> query{{mesh, place, direction}, {}};
    Eigen::BVIntersect(tree_, query);
    return query.first;
}

template <typename Scalar>
std::vector<int> FaceTree<Scalar>::faces_along(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place,
                                               const Vector3<Scalar>& direction) const {
    detail::AllAlong<Scalar> query{{mesh, place, direction}, {}};
    Eigen::BVIntersect(tree_, query);
    std::sort(query.found.begin(), query.found.end());
    return std::move(query.found);
}

template <typename Scalar>
std::optional<int> FaceTree<Scalar>::windings_along(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place,
                                                    const Vector3<Scalar>& direction) const {
    detail::WindingsAlong<Scalar> query{{mesh, place, direction}};
    Eigen::BVIntersect(tree_, query);
    return query.is_certain ? std::optional<int>(query.windings) : std::nullopt;
}

} // namespace skelgen::surface
