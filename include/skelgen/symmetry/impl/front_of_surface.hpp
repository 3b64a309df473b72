#pragma once

#include <skelgen/symmetry/front_of_surface.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/symmetry/impl/standing_pose.hpp>
#include <skelgen/symmetry/joints_by_role.hpp>

namespace skelgen::symmetry {
namespace detail {

/// A weighted mean of places.
template <typename Scalar>
struct MeanPlace {
    Vector3<core::Accumulator> sum = Vector3<core::Accumulator>::Zero();
    core::Accumulator weight = 0, squares = 0;

    void add(const Vector3<Scalar>& place, Scalar of_weight) {
        const Vector3<core::Accumulator> at = place.template cast<core::Accumulator>();
        const auto w = static_cast<core::Accumulator>(of_weight);
        sum += w * at;
        squares += w * at.squaredNorm();
        weight += w;
    }
    [[nodiscard]] Vector3<Scalar> get() const { return (sum / weight).template cast<Scalar>(); }
    /// Root mean square of the distances from a place.
    [[nodiscard]] Scalar spread_from(const Vector3<Scalar>& place) const {
        const Vector3<core::Accumulator> at = place.template cast<core::Accumulator>();
        const core::Accumulator mean = squares / weight - 2 * at.dot(sum / weight) + at.squaredNorm();
        return static_cast<Scalar>(std::sqrt(std::max(mean, core::Accumulator(0))));
    }
};

template <typename Scalar, typename Use>
void each_face(const TriangleMesh<Scalar>& mesh, Use use) {
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const auto corner = [&](int k) -> Vector3<Scalar> { return core::point(mesh.vertices, mesh.faces(f, k)); };
        use(Vector3<Scalar>((corner(0) + corner(1) + corner(2)) / Scalar(3)), core::face_area_vector(mesh, f).norm());
    }
}

/// From the shin's axis to the middle of the foot's surface, over its spread. Nearer to `other` is the other leg's.
template <typename Scalar>
Vector3<Scalar> before_shin(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& knee, const Vector3<Scalar>& ankle,
                            const std::optional<Vector3<Scalar>>& other) {
    // In lengths of the calf, from the knee on; and how far from the ankle a foot reaches, and from its axis a shin.
    constexpr Scalar shin_from = Scalar(0.4), shin_to = Scalar(0.8), foot_from = Scalar(0.95), far = 1,
                     thick = Scalar(0.6);
    const Scalar length = (ankle - knee).norm();
    if (!(length > 0)) return Vector3<Scalar>::Zero();
    const Vector3<Scalar> down = (ankle - knee) / length;
    MeanPlace<Scalar> shin, foot; // off the line through the calf
    each_face(mesh, [&](const Vector3<Scalar>& place, Scalar area) {
        const Scalar from_ankle = (place - ankle).norm(), along = (place - knee).dot(down) / length;
        if (other && (place - *other).norm() < from_ankle) return;
        const Vector3<Scalar> off = without_component(Vector3<Scalar>(place - knee), down);
        if (along > shin_from && along < shin_to && off.norm() < thick * length) shin.add(off, area);
        if (along > foot_from && from_ankle < far * length) foot.add(off, area);
    });
    if (!(foot.weight > 0)) return Vector3<Scalar>::Zero();
    const Vector3<Scalar> axis = shin.weight > 0 ? shin.get() : Vector3<Scalar>::Zero();
    const Scalar spread = foot.spread_from(axis);
    return spread > 0 ? Vector3<Scalar>((foot.get() - axis) / spread) : Vector3<Scalar>::Zero();
}

} // namespace detail

template <typename Scalar>
SurfaceFront<Scalar> front_of_surface(const Body<Scalar>& body, const refinement::RefinedJoints<Scalar>& joints,
                                      const SkeletonTemplate& skeleton_template, const Points<Scalar>* vertices) {
    using enum JointRole;
    const detail::JointsByRole<Scalar> by_role(joints, skeleton_template);
    SurfaceFront<Scalar> out;
    for (const auto& [side, other] : {std::pair(Side::left, Side::right), std::pair(Side::right, Side::left)})
        if (const auto knee_at = by_role.find(knee, side), ankle_at = by_role.find(ankle, side); knee_at && ankle_at)
            out.sole += detail::before_shin(body.mesh, *knee_at, *ankle_at, by_role.find(ankle, other));

    const auto neck_at = by_role.find(neck), head_at = by_role.find(head);
    if (!neck_at || !head_at || !((*head_at - *neck_at).norm() > 0)) return out;
    const Vector3<Scalar> to_head = *head_at - *neck_at;
    const auto is_in_head = [&](const Vector3<Scalar>& place) { // hair and ears included
        constexpr Scalar from = Scalar(0.2), far = Scalar(3);   // in lengths from neck to head
        return (place - *neck_at).dot(to_head) > from * to_head.squaredNorm() &&
               (place - *head_at).norm() < far * to_head.norm();
    };
    detail::MeanPlace<Scalar> surface, points;
    detail::each_face(body.mesh, [&](const Vector3<Scalar>& place, Scalar area) {
        if (is_in_head(place)) surface.add(place, area);
    });
    const Points<Scalar>& places = vertices ? *vertices : body.mesh.vertices;
    for (Eigen::Index v = 0; v < places.rows(); ++v) {
        const Vector3<Scalar> given = core::point(places, v);
        const Vector3<Scalar> place = vertices ? body.similarity.to_canonical(given) : given;
        if (is_in_head(place)) points.add(place, Scalar(1));
    }
    if (surface.weight > 0 && points.weight > 0)
        out.face = (points.get() - surface.get()) / core::bounding_diagonal(body.mesh.vertices);
    return out;
}

} // namespace skelgen::symmetry
