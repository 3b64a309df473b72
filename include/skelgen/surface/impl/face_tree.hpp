#pragma once

#include <skelgen/surface/face_tree.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <skelgen/core/geometry.hpp>

namespace skelgen::surface {
namespace detail {

template <typename Scalar>
using Box = Eigen::AlignedBox<Scalar, 3>;

/// The faces that a plane cuts near a place.
template <typename Scalar>
struct PlaneQuery {
    const TriangleMesh<Scalar>& mesh;
    Vector3<Scalar> normal;
    Scalar offset;
    Vector3<Scalar> place;
    Scalar reach_of_place;
    std::vector<int> found = {};

    [[nodiscard]] bool wants(const Box<Scalar>& box) const {
        constexpr Scalar rounded_up = 1 + 64 * std::numeric_limits<Scalar>::epsilon();
        if (squared_distance_to_box<Scalar>(place, box) > reach_of_place * reach_of_place * rounded_up) return false;
        Scalar middle = -offset, reach = 0;
        for (int k = 0; k < 3; ++k) {
            middle += normal[k] * (box.min()[k] + box.max()[k]) / 2;
            reach += std::abs(normal[k]) * (box.max()[k] - box.min()[k]) / 2;
        }
        // What rounding may add: a face that is cut must not be missed.
        constexpr Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon();
        return std::abs(middle) <= reach + rounding * (reach + std::abs(offset));
    }

    bool ends_with(int face) {
        int above = 0;
        for (int k = 0; k < 3; ++k) above += normal.dot(core::point(mesh.vertices, mesh.faces(face, k))) >= offset;
        if (above == 1 || above == 2) found.push_back(face);
        return false;
    }
};

/// What a ray meets.
template <typename Scalar>
struct Ray {
    const TriangleMesh<Scalar>& mesh;
    Vector3<Scalar> place, direction;
    Vector3<Scalar> inverse = direction.cwiseInverse(); ///< infinite along axes that the ray is normal to

    /// How far along the ray a box begins; infinite where the ray does not meet it before `farthest`.
    [[nodiscard]] Scalar way_to(const Box<Scalar>& box, Scalar farthest) const {
        constexpr Scalar none = std::numeric_limits<Scalar>::infinity();
        Scalar enter = 0, leave = farthest;
        for (int k = 0; k < 3; ++k) {
            if (direction[k] == 0) {
                if (place[k] < box.min()[k] || place[k] > box.max()[k]) return none;
                continue;
            }
            const Scalar a = (box.min()[k] - place[k]) * inverse[k], b = (box.max()[k] - place[k]) * inverse[k];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return enter <= leave * (1 + 64 * std::numeric_limits<Scalar>::epsilon()) ? enter : none;
    }
    [[nodiscard]] bool meets(const Box<Scalar>& box) const {
        return way_to(box, std::numeric_limits<Scalar>::max()) < std::numeric_limits<Scalar>::infinity();
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
        constexpr Scalar rounding = 32 * std::numeric_limits<Scalar>::epsilon();
        const Scalar least = std::min(std::min(u, v), w), most = std::max(std::max(u, v), w), sum = u + v + w;
        const Scalar aa = a.squaredNorm(), bb = b.squaredNorm(), cc = c.squaredNorm();
        if (const Scalar more = rounding * (aa + bb + cc); least < -more && most > more)
            return {false, true, false, -1};
        const Scalar la = std::sqrt(aa), lb = std::sqrt(bb), lc = std::sqrt(cc);
        const Scalar none = rounding * (la * lb + lb * lc + lc * la);
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

    [[nodiscard]] Scalar way_to(const Box<Scalar>& box) const { return ray.way_to(box, first.distance); }
    [[nodiscard]] bool may_be_nearer(Scalar way) const { return way <= first.distance && std::isfinite(way); }
    void look_at(int face) {
        const Scalar distance = ray.past(face).distance;
        if (distance >= 0 && distance < first.distance) first = {face, distance};
    }
};

/// All faces on a ray.
template <typename Scalar>
struct AllAlong {
    Ray<Scalar> ray;
    std::vector<int> found;

    [[nodiscard]] bool wants(const Box<Scalar>& box) const { return ray.meets(box); }
    bool ends_with(int face) {
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

    [[nodiscard]] bool wants(const Box<Scalar>& box) const { return ray.meets(box); }
    bool ends_with(int face) {
        const auto passage = ray.past(face);
        is_certain = is_certain && passage.is_certain;
        if (passage.distance >= 0) windings += passage.leaves ? 1 : -1;
        return !is_certain; // then nothing more is to be counted
    }
};

/// The distance from a place to the nearest face.
template <typename Scalar>
struct NearestFace {
    const TriangleMesh<Scalar>& mesh;
    Vector3<Scalar> place;
    Scalar least;
    int nearest = -1; ///< the first of those that are nearest

    [[nodiscard]] Scalar way_to(const Box<Scalar>& box) const { return squared_distance_to_box<Scalar>(place, box); }
    [[nodiscard]] bool may_be_nearer(Scalar squared) const { return squared < least * least; }
    void look_at(int face) {
        const auto corner = [&](int k) { return core::point(mesh.vertices, mesh.faces(face, k)); };
        const Vector3<Scalar> a = corner(0), b = corner(1), c = corner(2);
        if (is_beyond_plane(b - a, c - a, place - a)) return;
        const Scalar distance = distance_to_triangle<Scalar>(place, a, b, c);
        if (!(distance < least)) return;
        least = distance;
        nearest = face;
    }

    /// Is all of the plane of two edges farther? Not that of a needle's, which rounding would turn.
    [[nodiscard]] bool is_beyond_plane(const Vector3<Scalar>& ab, const Vector3<Scalar>& ac,
                                       const Vector3<Scalar>& from_a) const {
        constexpr Scalar rounded_down = 1 - (1 << 16) * std::numeric_limits<Scalar>::epsilon();
        constexpr Scalar needle = Scalar(1e-4); // squared sine of its angle
        const Vector3<Scalar> normal = ab.cross(ac);
        const Scalar square = normal.squaredNorm(), above = normal.dot(from_a);
        return rounded_down * (above * above) > least * least * square &&
               square > needle * (ab.squaredNorm() * ac.squaredNorm());
    }
};

/// The vertex nearest to a place.
template <typename Scalar>
struct NearestVertex {
    const TriangleMesh<Scalar>& mesh;
    Vector3<Scalar> place;
    int vertex = -1;
    Scalar least = std::numeric_limits<Scalar>::infinity(); ///< squared distance

    [[nodiscard]] Scalar way_to(const Box<Scalar>& box) const { return squared_distance_to_box<Scalar>(place, box); }
    [[nodiscard]] bool may_be_nearer(Scalar squared) const {
        return squared * (1 - 64 * std::numeric_limits<Scalar>::epsilon()) <= least;
    }
    void look_at(int face) {
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.faces(face, k);
            const Scalar squared = (core::point(mesh.vertices, v) - place).squaredNorm();
            if (squared > least || (squared == least && vertex <= v)) continue;
            vertex = v;
            least = squared;
        }
    }
};

/// The bits of a number of 21 bits, two zeros between each and the next.
inline std::uint64_t spread_bits(std::uint64_t x) {
    x = (x | (x << 32)) & 0x001f00000000ffff;
    x = (x | (x << 16)) & 0x001f0000ff0000ff;
    x = (x | (x << 8)) & 0x100f00f00f00f00f;
    x = (x | (x << 4)) & 0x10c30c30c30c30c3;
    x = (x | (x << 2)) & 0x1249249249249249;
    return x;
}

/// Where a box lies on a curve that fills space, and which one it is.
using PlaceOnCurve = std::pair<std::uint64_t, int>;

/// Boxes in the order of their middles along such a curve (Mor66): those that follow each other are near each other.
template <typename Scalar>
std::vector<PlaceOnCurve> along_filling_curve(const std::vector<Box<Scalar>>& boxes) {
    constexpr std::uint64_t cells = (std::uint64_t(1) << 21) - 1;
    Box<Scalar> all;
    for (const Box<Scalar>& box : boxes) all.extend(box);
    const Scalar size = all.isEmpty() ? Scalar(0) : all.sizes().maxCoeff();
    const Scalar scale = size > 0 ? static_cast<Scalar>(cells) / size : Scalar(0);
    std::vector<PlaceOnCurve> order(boxes.size());
    for (std::size_t f = 0; f < boxes.size(); ++f) {
        std::uint64_t code = 0;
        for (int k = 0; k < 3; ++k) {
            const Scalar middle = (boxes[f].min()[k] + boxes[f].max()[k]) / 2 - all.min()[k];
            code |= spread_bits(std::min(cells, static_cast<std::uint64_t>(middle * scale))) << k;
        }
        order[f] = {code, static_cast<int>(f)};
    }
    std::sort(order.begin(), order.end());
    return order;
}

/// Where a run of places on the curve is parted: where it leaves the half of the smallest cell that holds it all.
inline std::size_t parting(const std::vector<PlaceOnCurve>& order, std::size_t first, std::size_t last) {
    const std::uint64_t differing = order[first].first ^ order[last - 1].first;
    if (differing == 0) return first + (last - first) / 2;
    const std::uint64_t half = std::bit_floor(differing);
    const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
    return static_cast<std::size_t>(
        std::partition_point(begin, order.begin() + static_cast<std::ptrdiff_t>(last),
                             [&](const PlaceOnCurve& place) { return (place.first & half) == 0; }) -
        order.begin());
}

} // namespace detail

template <typename Scalar>
Scalar distance_to_triangle(const Vector3<Scalar>& place, const Vector3<Scalar>& a, const Vector3<Scalar>& b,
                            const Vector3<Scalar>& c) {
    const Vector3<Scalar> ab = b - a, bc = c - b, ca = a - c, from_a = place - a, from_b = place - b,
                          from_c = place - c;
    const Vector3<Scalar> normal = bc.cross(ab); // inwards
    const Scalar area = normal.norm();
    // Beside the triangle, or above it where its plane is not known, an edge is nearest.
    const bool over_ab = normal.dot(from_a.cross(ab)) >= 0, over_bc = normal.dot(from_b.cross(bc)) >= 0,
               over_ca = normal.dot(from_c.cross(ca)) >= 0;
    if (area > 0 && over_ab && over_bc && over_ca) return std::abs(normal.dot(from_a)) / area;
    const auto squared_distance = [](const Vector3<Scalar>& from_start, const Vector3<Scalar>& edge) {
        const Scalar length2 = edge.squaredNorm();
        const Scalar along = length2 > 0 ? std::clamp(from_start.dot(edge) / length2, Scalar(0), Scalar(1)) : Scalar(0);
        return (from_start - along * edge).squaredNorm();
    };
    return std::sqrt(
        std::min({squared_distance(from_a, ab), squared_distance(from_b, bc), squared_distance(from_c, ca)}));
}

template <typename Scalar>
FaceTree<Scalar>::FaceTree(const TriangleMesh<Scalar>& mesh) {
    std::vector<detail::Box<Scalar>> of_faces(static_cast<std::size_t>(mesh.faces.rows()));
    for (std::size_t f = 0; f < of_faces.size(); ++f)
        for (int k = 0; k < 3; ++k)
            of_faces[f].extend(core::point(mesh.vertices, mesh.faces(static_cast<Eigen::Index>(f), k)));
    constexpr std::size_t most_in_leaf = 4;
    const std::vector<detail::PlaceOnCurve> order = detail::along_filling_curve(of_faces);
    const auto boxes = std::make_shared<Boxes>();
    for (const auto& [code, face] : order) boxes->faces.push_back(face);
    boxes->nodes.reserve(order.size());
    const auto add = [&](const auto& add_part, std::size_t first, std::size_t last) -> int {
        const std::size_t node = boxes->nodes.size();
        boxes->nodes.push_back({{}, -1, static_cast<int>(first), static_cast<int>(last - first)});
        detail::Box<Scalar> box;
        if (last - first <= most_in_leaf) {
            for (std::size_t i = first; i < last; ++i) box.extend(of_faces[static_cast<std::size_t>(order[i].second)]);
        } else {
            const std::size_t middle = detail::parting(order, first, last);
            const auto one = static_cast<std::size_t>(add_part(add_part, first, middle));
            const int other = add_part(add_part, middle, last);
            boxes->nodes[node].rest = other;
            box = boxes->nodes[one].box.merged(boxes->nodes[static_cast<std::size_t>(other)].box);
        }
        boxes->nodes[node].box = box;
        return static_cast<int>(node);
    };
    if (!order.empty()) add(add, 0, order.size());
    boxes_ = boxes;
}

template <typename Scalar>
template <typename Query>
bool FaceTree<Scalar>::ask_below(Query& query, int index) const {
    const Node& node = boxes_->nodes[static_cast<std::size_t>(index)];
    if (!query.wants(node.box)) return false;
    if (node.rest >= 0) return ask_below(query, index + 1) || ask_below(query, node.rest);
    for (int i = node.first; i < node.first + node.count; ++i)
        if (query.ends_with(boxes_->faces[static_cast<std::size_t>(i)])) return true;
    return false;
}

template <typename Scalar>
template <typename Query>
void FaceTree<Scalar>::ask(Query& query) const {
    if (boxes_ && !boxes_->nodes.empty()) ask_below(query, 0);
}

template <typename Scalar>
template <typename Query>
void FaceTree<Scalar>::ask_nearest_first(Query& query, int index) const {
    const Node& node = boxes_->nodes[static_cast<std::size_t>(index)];
    if (node.rest < 0) {
        for (int i = node.first; i < node.first + node.count; ++i)
            query.look_at(boxes_->faces[static_cast<std::size_t>(i)]);
        return;
    }
    int near = index + 1, far = node.rest;
    Scalar to_near = query.way_to(boxes_->nodes[static_cast<std::size_t>(near)].box);
    Scalar to_far = query.way_to(boxes_->nodes[static_cast<std::size_t>(far)].box);
    if (to_far < to_near) {
        std::swap(near, far);
        std::swap(to_near, to_far);
    }
    if (query.may_be_nearer(to_near)) ask_nearest_first(query, near);
    if (query.may_be_nearer(to_far)) ask_nearest_first(query, far);
}

template <typename Scalar>
template <typename Query>
void FaceTree<Scalar>::ask_nearest_first(Query& query) const {
    if (boxes_ && !boxes_->nodes.empty()) ask_nearest_first(query, 0);
}

template <typename Scalar>
std::vector<int> FaceTree<Scalar>::faces_across(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& normal,
                                                Scalar offset, const Vector3<Scalar>& place, Scalar reach) const {
    detail::PlaneQuery<Scalar> query{mesh, normal, offset, place, reach};
    ask(query);
    std::sort(query.found.begin(), query.found.end());
    return std::move(query.found);
}

template <typename Scalar>
Scalar FaceTree<Scalar>::distance(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place, Scalar most) const {
    detail::NearestFace<Scalar> query{mesh, place, most};
    ask_nearest_first(query);
    return query.least;
}

template <typename Scalar>
int FaceTree<Scalar>::nearest_vertex(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place) const {
    detail::NearestVertex<Scalar> query{mesh, place};
    ask_nearest_first(query);
    return query.vertex;
}

template <typename Scalar>
int FaceTree<Scalar>::nearest_corner(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place) const {
    if (mesh.faces.rows() == 0) return -1;
    detail::NearestFace<Scalar> query{mesh, place, std::numeric_limits<Scalar>::infinity(), 0};
    ask_nearest_first(query);
    const auto squared = [&](int v) { return (core::point(mesh.vertices, v) - place).squaredNorm(); };
    const auto corners = mesh.faces.row(query.nearest);
    return *std::min_element(corners.begin(), corners.end(), [&](int a, int b) { return squared(a) < squared(b); });
}

template <typename Scalar>
typename FaceTree<Scalar>::Hit FaceTree<Scalar>::first_along(const TriangleMesh<Scalar>& mesh,
                                                             const Vector3<Scalar>& place,
                                                             const Vector3<Scalar>& direction, Scalar reach) const {
    detail::FirstAlong<Scalar> query{{mesh, place, direction}, {-1, reach}};
    ask_nearest_first(query);
    return query.first.face >= 0 ? query.first : Hit{};
}

template <typename Scalar>
std::vector<int> FaceTree<Scalar>::faces_along(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place,
                                               const Vector3<Scalar>& direction) const {
    detail::AllAlong<Scalar> query{{mesh, place, direction}, {}};
    ask(query);
    std::sort(query.found.begin(), query.found.end());
    return std::move(query.found);
}

template <typename Scalar>
std::optional<int> FaceTree<Scalar>::windings_along(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place,
                                                    const Vector3<Scalar>& direction) const {
    detail::WindingsAlong<Scalar> query{{mesh, place, direction}};
    ask(query);
    return query.is_certain ? std::optional<int>(query.windings) : std::nullopt;
}

} // namespace skelgen::surface
