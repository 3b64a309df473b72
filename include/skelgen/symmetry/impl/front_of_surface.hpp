#pragma once

#include <skelgen/symmetry/front_of_surface.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/symmetry/joints_by_role.hpp>
#include <skelgen/symmetry/standing_pose.hpp>

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

/// A bone of a limb, and places beside it.
template <typename Scalar>
struct FrontBone {
    Vector3<Scalar> from, along; ///< `along` has unit length
    Scalar length;
    MeanPlace<Scalar> beside, beyond; ///< off its line

    FrontBone(const Vector3<Scalar>& start, const Vector3<Scalar>& end)
        : from(start), along((end - start).normalized()), length((end - start).norm()) {}
    [[nodiscard]] Vector3<Scalar> off_line(const Vector3<Scalar>& place) const {
        return without_component(Vector3<Scalar>(place - from), along);
    }
    /// In lengths from its start.
    [[nodiscard]] Scalar along_it(const Vector3<Scalar>& place) const { return (place - from).dot(along) / length; }
};

template <typename Scalar>
std::vector<FrontBone<Scalar>> find_shins(const JointsByRole<Scalar>& joints) {
    std::vector<FrontBone<Scalar>> out;
    for (const Side side : {Side::left, Side::right}) {
        const auto start = joints.find(JointRole::knee, side), end = joints.find(JointRole::ankle, side);
        if (start && end && (*end - *start).norm() > 0) out.emplace_back(*start, *end);
    }
    return out;
}

/// A place on a shin, above the ankle, or on the foot below it.
template <typename Scalar>
void add_to_leg(std::vector<FrontBone<Scalar>>& shins, const Vector3<Scalar>& place, Scalar weight) {
    constexpr Scalar shin_from = Scalar(0.4), shin_to = Scalar(0.8), foot_from = Scalar(0.95), thick = Scalar(0.6);
    const auto from_ankle = [&](const FrontBone<Scalar>& shin) {
        return (place - shin.from - shin.length * shin.along).norm();
    };
    FrontBone<Scalar>* nearest = nullptr;
    for (FrontBone<Scalar>& shin : shins)
        if (!nearest || from_ankle(shin) < from_ankle(*nearest)) nearest = &shin;
    if (!nearest) return;
    const Scalar at = nearest->along_it(place);
    const Vector3<Scalar> off = nearest->off_line(place);
    if (at > shin_from && at < shin_to && off.norm() < thick * nearest->length) nearest->beside.add(off, weight);
    if (at > foot_from && from_ankle(*nearest) < nearest->length) nearest->beyond.add(off, weight);
}

/// Is a place in the head, hair and ears included? `neck`: the bone from the neck to the head.
template <typename Scalar>
bool is_in_head(const FrontBone<Scalar>& neck, const Vector3<Scalar>& place) {
    constexpr Scalar from = Scalar(0.2), far = Scalar(3);
    return neck.along_it(place) > from && (place - neck.from - neck.length * neck.along).norm() < far * neck.length;
}

} // namespace detail

template <typename Scalar>
SurfaceFront<Scalar> front_of_surface(const Body<Scalar>& body, const refinement::RefinedJoints<Scalar>& joints,
                                      const SkeletonTemplate& skeleton_template, const Points<Scalar>* vertices) {
    using enum JointRole;
    const detail::JointsByRole<Scalar> by_role(joints, skeleton_template);
    auto shins = detail::find_shins(by_role);
    const auto neck_at = by_role.find(neck), head_at = by_role.find(head);
    std::optional<detail::FrontBone<Scalar>> skull;
    if (neck_at && head_at && (*head_at - *neck_at).norm() > 0) skull.emplace(*neck_at, *head_at);

    detail::MeanPlace<Scalar> head_surface, head_vertices;
    for (Eigen::Index f = 0; f < body.mesh.faces.rows(); ++f) {
        const auto corner = [&](int k) -> Vector3<Scalar> {
            return core::point(body.mesh.vertices, body.mesh.faces(f, k));
        };
        const Vector3<Scalar> place = (corner(0) + corner(1) + corner(2)) / Scalar(3);
        const Scalar area = core::face_area_vector(body.mesh, f).norm();
        detail::add_to_leg(shins, place, area);
        if (skull && detail::is_in_head(*skull, place)) head_surface.add(place, area);
    }
    SurfaceFront<Scalar> out;
    for (const auto& shin : shins) {
        if (!(shin.beyond.weight > 0)) continue;
        const Vector3<Scalar> axis = shin.beside.weight > 0 ? shin.beside.get() : Vector3<Scalar>::Zero();
        const Scalar spread = shin.beyond.spread_from(axis);
        if (spread > 0) out.sole += (shin.beyond.get() - axis) / spread;
    }
    if (!skull) return out;
    const Points<Scalar>& places = vertices ? *vertices : body.mesh.vertices;
    for (Eigen::Index v = 0; v < places.rows(); ++v) {
        const Vector3<Scalar> given = core::point(places, v);
        const Vector3<Scalar> place = vertices ? body.similarity.to_canonical(given) : given;
        if (detail::is_in_head(*skull, place)) head_vertices.add(place, Scalar(1));
    }
    if (head_surface.weight > 0 && head_vertices.weight > 0)
        out.face = (head_vertices.get() - head_surface.get()) / core::bounding_diagonal(body.mesh.vertices);
    return out;
}

} // namespace skelgen::symmetry
