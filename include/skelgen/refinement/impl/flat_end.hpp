#pragma once

#include <skelgen/refinement/flat_end.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <skelgen/core/geometry.hpp>

namespace skelgen::refinement {
namespace detail {

/// Cosine of the angle up to which normals are those of one flat piece: 15 degrees, as a scan's or a coarse lid's
/// waviness has it. A working value, as are the next three.
template <typename Scalar>
inline constexpr Scalar flat = Scalar(0.966);

/// Cosine of the angle up to which a lid may face away from the limb's direction: people do not cut at right angles.
template <typename Scalar>
inline constexpr Scalar outwards = Scalar(0.64);

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

} // namespace detail

template <typename Scalar>
Scalar flat_end(const TriangleMesh<Scalar>& mesh, const Limb<Scalar>& limb, const EndPoint<Scalar>& end,
                Scalar length) {
    std::vector<Scalar> thickness;
    const Scalar all = limb.line.arc[limb.line.arc.size() - 1];
    for (Eigen::Index i = 0; i < limb.line.arc.size(); ++i)
        if (all - limb.line.arc[i] <= length && limb.line.thickness[i] > 0) thickness.push_back(limb.line.thickness[i]);
    if (thickness.empty()) return 0;
    const auto middle = thickness.begin() + static_cast<std::ptrdiff_t>(thickness.size() / 2);
    std::nth_element(thickness.begin(), middle, thickness.end());
    if (detail::typical_edge(mesh) > detail::coarse<Scalar> * *middle) return 0;
    const Vector3<Scalar> along =
        (point_on(limb, all - *middle) - point_on(limb, all - std::max(length, 3 * *middle))).normalized();
    const auto faces = detail::end_faces(mesh, end, detail::end_size<Scalar> * *middle, along);
    return detail::flat_area(faces, along) / (std::numbers::pi_v<Scalar> * *middle * *middle);
}

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
