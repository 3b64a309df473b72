#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/refinement/end_points.hpp>
#include <skelgen/refinement/limbs.hpp>

namespace skelgen::refinement {

namespace detail {

/// Cosine of the angle up to which normals are those of one flat piece: 15 degrees, as a scan's or a coarse lid's
/// waviness has it. A working value, as are the next six.
template <typename Scalar>
inline constexpr Scalar flat = Scalar(0.966);

/// Cosine of the angle up to which a lid may face away from the limb's direction: people do not cut at right angles.
template <typename Scalar>
inline constexpr Scalar outwards = Scalar(0.64);

/// The same of the rim of a hole, which no noise turns: 60 degrees.
template <typename Scalar>
inline constexpr Scalar across = Scalar(0.5);

/// Most that a hole shows which faces further away, as that of a missing sole does: as much as whole feet and cut
/// calves have in common.
template <typename Scalar>
inline constexpr Scalar aside = Scalar(0.6);

/// A hole of this part of a limb's section is all of it: limbs thin towards wrist and ankle.
template <typename Scalar>
inline constexpr Scalar whole_hole = Scalar(0.5);

/// The end's surface reaches so many times the limb's thickness over the surface: across a lid.
template <typename Scalar>
inline constexpr Scalar end_size = Scalar(3);

/// Edges that are so many times as long as a limb is thick leave each end flat.
template <typename Scalar>
inline constexpr Scalar coarse = Scalar(1.2);

/// Length of the edges of equilateral triangles as large as the mesh's are on average.
template <typename Scalar>
Scalar typical_edge(const TriangleMesh<Scalar>& mesh) {
    return std::sqrt(4 / std::numbers::sqrt3_v<Scalar> * core::surface_area(mesh) /
                     static_cast<Scalar>(mesh.faces.rows()));
}

template <typename Scalar>
struct EndFace {
    Vector3<Scalar> normal; ///< unit
    Scalar area;
};

/// The faces around a limb's end that look outwards, roughly.
template <typename Scalar>
std::vector<EndFace<Scalar>> end_faces(const TriangleMesh<Scalar>& mesh, const EndPoint<Scalar>& end, Scalar reach,
                                       const Vector3<Scalar>& along) {
    std::vector<EndFace<Scalar>> faces;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const int a = mesh.faces(f, 0), b = mesh.faces(f, 1), c = mesh.faces(f, 2);
        if (std::min({end.distance[a], end.distance[b], end.distance[c]}) > reach) continue;
        const Vector3<Scalar> origin = core::point(mesh.vertices, a);
        const Vector3<Scalar> across =
            (core::point(mesh.vertices, b) - origin).cross(core::point(mesh.vertices, c) - origin);
        const Scalar length = across.norm();
        if (length > 0 && across.dot(along) > outwards<Scalar> * length) faces.push_back({across / length, length / 2});
    }
    return faces;
}

/// Area of the faces whose normals lie together, and with most others.
template <typename Scalar>
Scalar flat_area(const std::vector<EndFace<Scalar>>& faces, const Vector3<Scalar>& along) {
    Vector3<Scalar> normal = along;
    Scalar area = 0;
    for (const Scalar least : {outwards<Scalar>, Scalar(0.9), flat<Scalar>, flat<Scalar>}) {
        Vector3<Scalar> sum = Vector3<Scalar>::Zero();
        area = 0;
        for (const EndFace<Scalar>& face : faces)
            if (face.normal.dot(normal) > least) {
                sum += face.area * face.normal;
                area += face.area;
            }
        if (!(sum.norm() > 0)) return 0;
        normal = sum.normalized();
    }
    return area;
}

/// How thick a limb is near its end, and where it goes there.
template <typename Scalar>
struct LimbEnd {
    Scalar thickness;
    Vector3<Scalar> along; ///< unit, outwards
};

/// None without sections within `length` of the end, or with edges too long to tell anything.
template <typename Scalar>
std::optional<LimbEnd<Scalar>> limb_end(const TriangleMesh<Scalar>& mesh, const Limb<Scalar>& limb, Scalar length) {
    std::vector<Scalar> thickness;
    const Scalar all = limb.line.arc[limb.line.arc.size() - 1];
    for (Eigen::Index i = 0; i < limb.line.arc.size(); ++i)
        if (all - limb.line.arc[i] <= length && limb.line.thickness[i] > 0) thickness.push_back(limb.line.thickness[i]);
    if (thickness.empty()) return std::nullopt;
    const auto middle = thickness.begin() + static_cast<std::ptrdiff_t>(thickness.size() / 2);
    std::nth_element(thickness.begin(), middle, thickness.end());
    if (typical_edge(mesh) > coarse<Scalar> * *middle) return std::nullopt;
    const Vector3<Scalar> along =
        (point_on(limb, all - *middle) - point_on(limb, all - std::max(length, 3 * *middle))).normalized();
    return LimbEnd<Scalar>{*middle, along};
}

/// Area of the limb's cross-section near its end, half its thickness to twice that away: the median; 0 without
/// sections.
template <typename Scalar>
Scalar section_area(const Limb<Scalar>& limb, Scalar thickness) {
    std::vector<Scalar> areas;
    const Scalar all = limb.line.arc[limb.line.arc.size() - 1];
    for (Eigen::Index i = 0; i < limb.line.arc.size(); ++i)
        if (const Scalar from_end = all - limb.line.arc[i];
            limb.line.area[i] > 0 && from_end >= thickness / 2 && from_end <= 2 * thickness)
            areas.push_back(limb.line.area[i]);
    if (areas.empty()) return 0;
    const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
    std::nth_element(areas.begin(), middle, areas.end());
    return *middle;
}

/// Mean distance of a rim's vertices from the end.
template <typename Scalar>
Scalar distance_to_rim(const EndPoint<Scalar>& end) {
    Scalar sum = 0;
    for (const int v : end.rim) sum += end.distance[v];
    return sum / static_cast<Scalar>(end.rim.size());
}

/// The area that a closed polygon of vertices encloses, times its normal.
template <typename Scalar>
Vector3<Scalar> area_within(const Points<Scalar>& vertices, const std::vector<int>& rim) {
    const Vector3<Scalar> origin = core::point(vertices, rim.front());
    Vector3<Scalar> twice = Vector3<Scalar>::Zero();
    for (std::size_t i = 0; i < rim.size(); ++i)
        twice +=
            (core::point(vertices, rim[i]) - origin).cross(core::point(vertices, rim[(i + 1) % rim.size()]) - origin);
    return twice / 2;
}

} // namespace detail

/// How much of the limb's cross-section the largest flat piece of its end that faces outwards along it covers: about 1
/// where the limb is cut off and closed by a lid, a tenth where it is round; fingers and toes have less. `length`: how
/// far from the end the limb's thickness and direction are taken, in the body's unit. `end` is the limb's. 0 where the
/// limb has no sections there, and where the mesh's edges are as long as it is thick: any end is flat then. O(n).
template <typename Scalar>
Scalar flat_end(const TriangleMesh<Scalar>& mesh, const Limb<Scalar>& limb, const EndPoint<Scalar>& end,
                Scalar length) {
    const auto own = detail::limb_end(mesh, limb, length);
    if (!own) return 0;
    const auto faces = detail::end_faces(mesh, end, detail::end_size<Scalar> * own->thickness, own->along);
    return detail::flat_area(faces, own->along) / (std::numbers::pi_v<Scalar> * own->thickness * own->thickness);
}

/// How much of the limb's cross-section a hole that was closed around its end encloses, seen along the limb: 1 where
/// that is half or more, the limb being cut off and left open, and 0.6 at most where the hole faces aside, as that of a
/// missing sole does. Parameters as above. 0 without such a hole and where the mesh is too coarse. O(n) for n sections
/// and faces.
template <typename Scalar>
Scalar open_end(const TriangleMesh<Scalar>& mesh, const Limb<Scalar>& limb, const EndPoint<Scalar>& end,
                Scalar length) {
    if (end.rim.empty()) return 0;
    const auto own = detail::limb_end(mesh, limb, length);
    if (!own) return 0;
    if (detail::distance_to_rim(end) > detail::end_size<Scalar> * own->thickness) return 0;
    const Vector3<Scalar> area = detail::area_within(mesh.vertices, end.rim);
    const Scalar seen = std::abs(area.dot(own->along));
    const Scalar section = detail::section_area(limb, own->thickness);
    if (!(section > 0)) return 0;
    const Scalar share = std::min(seen / (detail::whole_hole<Scalar> * section), Scalar(1));
    return seen > detail::across<Scalar> * area.norm() ? share : std::min(share, detail::aside<Scalar>);
}

/// How much a limb's surface, over `length` from its end, looks to four sides at right angles: 0 where it is round, 0.2
/// where it is twice as wide as thick, 1 on a box, as the arms of block figures are: their ends are flat, and no
/// thinner than the rest. `end` is the limb's. O(n).
template <typename Scalar>
Scalar four_sidedness(const TriangleMesh<Scalar>& mesh, const Limb<Scalar>& limb, const EndPoint<Scalar>& end,
                      Scalar length) {
    constexpr Scalar sideways = Scalar(0.5); // cosine, against the limb's direction
    const Scalar all = limb.line.arc[limb.line.arc.size() - 1];
    const Vector3<Scalar> along = (point_on(limb, all) - point_on(limb, all - length)).normalized();
    const Vector3<Scalar> u = along.unitOrthogonal(), v = along.cross(u);
    Scalar area = 0;
    std::complex<Scalar> sum = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        if (end.distance[mesh.faces(f, 0)] > length) continue;
        const Vector3<Scalar> normal = core::face_area_vector(mesh, f);
        const Scalar size = normal.norm();
        if (!(std::abs(normal.dot(along)) < sideways * size)) continue;
        area += size;
        sum += std::polar(size, 4 * std::atan2(normal.dot(v), normal.dot(u)));
    }
    return area > 0 ? std::abs(sum) / area : Scalar(0);
}

} // namespace skelgen::refinement
