#pragma once

#include <skelgen/surface/winding_tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/part_at.hpp>

namespace skelgen::surface {
namespace detail {

inline constexpr int faces_in_winding_leaf = 4;

/// The angle of the direction (x, y), from -pi to pi, by what all machines round alike. C libraries differ in a sixth
/// of what `std::atan2` gives; where pieces lie on each other a surface that is laid by it then goes another way.
template <typename Scalar>
Scalar angle_of(Scalar x, Scalar y) {
    constexpr Scalar pi = std::numbers::pi_v<Scalar>;
    if (x < 0) return std::copysign(pi, y) + angle_of(-x, -y);
    if (std::abs(y) > x) return std::copysign(pi / 2, y) - angle_of(std::abs(y), y < 0 ? -x : x);
    if (!(x > 0)) return 0;
    Scalar tangent = y / x;
    for (int i = 0; i < 3; ++i) tangent /= 1 + std::sqrt(1 + tangent * tangent); // of half the angle; below 0.1 at last
    const Scalar square = tangent * tangent;
    Scalar series = 0;
    for (int power = 17; power > 0; power -= 2) series = 1 / static_cast<Scalar>(power) - square * series;
    return 8 * tangent * series;
}

/// A sum of angles, kept as the direction of a product of complex numbers and the whole turns that it has made: the
/// inverse tangent is taken once in all.
template <typename Scalar>
class AngleSum {
public:
    /// Adds the angle, from -pi to pi, of the direction (x, y); none where both are 0.
    void add(Scalar x, Scalar y) {
        const Scalar size = std::abs(x) + std::abs(y);
        if (!(size > 0)) return;
        const Scalar re = (x_ * x - y_ * y) / size, im = (x_ * y + y_ * x) / size;
        if (y_ >= 0 && y >= 0 && im < 0) ++turns_;
        if (y_ < 0 && y < 0 && (im > 0 || (im == 0 && re < 0))) --turns_;
        x_ = re;
        y_ = im;
    }
    [[nodiscard]] Scalar sum() const {
        return angle_of(x_, y_) + 2 * std::numbers::pi_v<Scalar> * static_cast<Scalar>(turns_);
    }

private:
    Scalar x_ = 1, y_ = 0;
    int turns_ = 0;
};

/// Adds half the solid angle under which a place sees a face (OS83).
template <typename Scalar>
void add_half_solid_angle(const TriangleMesh<Scalar>& mesh, int f, const Vector3<Scalar>& place,
                          AngleSum<Scalar>& sum) {
    const Vector3<Scalar> a = core::point(mesh.vertices, mesh.faces(f, 0)) - place;
    const Vector3<Scalar> b = core::point(mesh.vertices, mesh.faces(f, 1)) - place;
    const Vector3<Scalar> c = core::point(mesh.vertices, mesh.faces(f, 2)) - place;
    const Scalar la = a.norm(), lb = b.norm(), lc = c.norm();
    sum.add(la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb, a.dot(b.cross(c)));
}

} // namespace detail

template <typename Scalar>
WindingTree<Scalar>::WindingTree(const TriangleMesh<Scalar>& mesh) {
    const auto faces = static_cast<std::size_t>(mesh.faces.rows());
    if (faces == 0) return;
    order_.resize(faces);
    std::iota(order_.begin(), order_.end(), 0);
    std::vector<Vector3<Scalar>> centres(faces);
    for (std::size_t f = 0; f < faces; ++f) {
        Vector3<Scalar> sum = Vector3<Scalar>::Zero();
        for (int k = 0; k < 3; ++k) sum += core::point(mesh.vertices, mesh.faces(static_cast<Eigen::Index>(f), k));
        centres[f] = sum / 3;
    }
    nodes_.reserve(2 * faces / detail::faces_in_winding_leaf + 1);
    build(mesh, centres, 0, static_cast<int>(faces));
}

template <typename Scalar>
int WindingTree<Scalar>::build(const TriangleMesh<Scalar>& mesh, const std::vector<Vector3<Scalar>>& centres, int first,
                               int last) {
    const auto centre_of = [&](int f) -> const Vector3<Scalar>& { return centres[static_cast<std::size_t>(f)]; };
    const auto number = nodes_.size();
    nodes_.emplace_back();
    Node node;
    node.first = first;
    node.last = last;
    Scalar weight = 0;
    Vector3<Scalar> low = centre_of(order_[static_cast<std::size_t>(first)]), high = low;
    for (int i = first; i < last; ++i) {
        const int f = order_[static_cast<std::size_t>(i)];
        const Vector3<Scalar> area = core::face_area_vector(mesh, f);
        node.area += area;
        node.centre += area.norm() * centre_of(f);
        weight += area.norm();
        low = low.cwiseMin(centre_of(f));
        high = high.cwiseMax(centre_of(f));
    }
    node.centre = weight > 0 ? Vector3<Scalar>(node.centre / weight) : Vector3<Scalar>((low + high) / 2);
    for (int i = first; i < last; ++i) {
        const int f = order_[static_cast<std::size_t>(i)];
        node.moment += (centre_of(f) - node.centre) * core::face_area_vector(mesh, f).transpose();
        for (int k = 0; k < 3; ++k)
            node.radius = std::max(node.radius, (core::point(mesh.vertices, mesh.faces(f, k)) - node.centre).norm());
    }
    if (last - first > detail::faces_in_winding_leaf) {
        int axis = 0;
        (high - low).maxCoeff(&axis);
        const int middle = (first + last) / 2;
        core::part_at(order_.begin() + first, order_.begin() + middle, order_.begin() + last, [&](int a, int b) {
            return centre_of(a)[axis] != centre_of(b)[axis] ? centre_of(a)[axis] < centre_of(b)[axis] : a < b;
        });
        node.left = build(mesh, centres, first, middle);
        node.right = build(mesh, centres, middle, last);
    }
    nodes_[number] = node;
    return static_cast<int>(number);
}

template <typename Scalar>
Scalar WindingTree<Scalar>::winding_number(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place) const {
    constexpr Scalar far = 2; // radii (BDSLJ18)
    if (nodes_.empty()) return 0;
    Scalar far_angle = 0; // half of what the expansions give
    detail::AngleSum<Scalar> near_angle;
    std::array<int, 64> stack{};
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const Node& node = nodes_[static_cast<std::size_t>(stack[--depth])];
        const Vector3<Scalar> r = node.centre - place;
        const Scalar squared = r.squaredNorm();
        if (squared > far * far * node.radius * node.radius) {
            const Scalar distance = std::sqrt(squared), cubed = distance * squared;
            const Scalar first_order = node.moment.trace() - 3 * r.dot(node.moment * r) / squared;
            far_angle += (node.area.dot(r) + first_order) / (2 * cubed);
        } else if (node.left >= 0) {
            stack[depth++] = node.left;
            stack[depth++] = node.right;
        } else {
            for (int i = node.first; i < node.last; ++i)
                detail::add_half_solid_angle(mesh, order_[static_cast<std::size_t>(i)], place, near_angle);
        }
    }
    return (far_angle + near_angle.sum()) / (2 * std::numbers::pi_v<Scalar>);
}

} // namespace skelgen::surface
