#pragma once

#include <skelgen/refinement/trunk_joints.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace skelgen::refinement {
namespace detail {

/// Hips are crossed, thigh lines having met before them, where the line from one to the other goes along that from one
/// thigh's attachment to the other's by less than this part of their rest-pose distance. A working value.
template <typename Scalar>
inline constexpr Scalar least_hip_distance = Scalar(0.3);

/// How far from its place a waist's section may be that does not enclose it, as a part of the distance from hips to
/// neck: 10 cm in an adult.
template <typename Scalar>
inline constexpr Scalar waist_section_reach = Scalar(0.16);

/// Cosine of the angle from which on the lower trunk's line runs too much across the way from hips to neck to tell a
/// height on it. A working value: 60 degrees.
template <typename Scalar>
inline constexpr Scalar least_trunk_rise = Scalar(0.5);

/// A section up to this part of the largest one that a trunk of its own has is the waist's alone: the smallest one's
/// part of it.
template <typename Scalar>
inline constexpr Scalar waist_alone = Scalar(1) / Scalar(1.6);

/// The crotch is raised in so many steps up to this part of the bone from it to the waist or chest: any higher, it
/// would no longer be between the hips.
inline constexpr int crotch_steps = 10;
template <typename Scalar>
inline constexpr Scalar highest_crotch = Scalar(0.5);

/// Does the limb begin with a hip and a thigh?
template <typename Scalar>
bool has_thigh(const Placement<Scalar>& placement, const Limb<Scalar>& limb) {
    return placement.role(limb.joints.front()) == JointRole::hip && limb.joints.size() >= 2;
}

/// Centre of the limb's last own section, for the limb that begins with joint `j`.
template <typename Scalar>
Vector3<Scalar> attachment_point(const Placement<Scalar>& placement, const std::vector<Limb<Scalar>>& limbs, int j) {
    for (const Limb<Scalar>& limb : limbs)
        if (limb.joints.front() == j) return point_on(limb, std::max(limb.attachment, arc_of(limb, 0)));
    return placement.at(j);
}

/// Mean thickness of the thighs where they are on their own; 0 when nowhere.
template <typename Scalar>
Scalar thigh_thickness(const Placement<Scalar>& placement, const std::vector<Limb<Scalar>>& limbs) {
    Scalar sum = 0, count = 0;
    for (const Limb<Scalar>& limb : limbs) {
        if (!has_thigh(placement, limb)) continue;
        for (Eigen::Index i = 0; i < limb.line.arc.size(); ++i) {
            if (limb.line.arc[i] < limb.attachment || limb.line.arc[i] > arc_of(limb, 1)) continue;
            sum += limb.line.thickness[i];
            count += 1;
        }
    }
    return count > 0 ? sum / count : 0;
}

/// Mean angle in radians by which the thighs are raised from the prolonged trunk; 0 without legs.
template <typename Scalar>
Scalar hip_flexion(const Placement<Scalar>& placement, const std::vector<Limb<Scalar>>& limbs,
                   const Vector3<Scalar>& trunk) {
    Scalar sum = 0, count = 0;
    for (const Limb<Scalar>& limb : limbs) {
        if (!has_thigh(placement, limb)) continue;
        const Vector3<Scalar> thigh = placement.at(limb.joints[1]) - placement.at(limb.joints[0]);
        sum += std::acos(std::clamp(-thigh.normalized().dot(trunk.normalized()), Scalar(-1), Scalar(1)));
        count += 1;
    }
    return count > 0 ? sum / count : 0;
}

/// The place on the trunk's axis at the height of `place` on the way from hips to neck, along the unit vector `up`.
template <typename Scalar>
Vector3<Scalar> beside(const Vector3<Scalar>& place, const Vector3<Scalar>& up, const TrunkAxis<Scalar>& trunk) {
    const Scalar rise = trunk.up.dot(up);
    if (!(rise > least_trunk_rise<Scalar>)) return place;
    return trunk.place + (place - trunk.place).dot(up) / rise * trunk.up;
}

/// The waist, whose place on the way from hips to neck, along the vector `trunk`, is `place`: the centre of its
/// section, but the more of a raised thigh that holds, the nearer to the lower trunk's axis.
template <typename Scalar>
Vector3<Scalar> waist_near(const Vector3<Scalar>& place, const Vector3<Scalar>& trunk, const Slicer<Scalar>& slicer,
                           const std::optional<TrunkAxis<Scalar>>& lower_trunk) {
    const Vector3<Scalar> up = trunk.normalized();
    const auto section = slicer.around(place, up, waist_section_reach<Scalar> * trunk.norm());
    if (!section) return place;
    const bool is_own = (section->centroid - place).norm() < section->thickness;
    const Vector3<Scalar> centre = is_own ? section->centroid : place;
    if (!lower_trunk) return centre;
    const Scalar part = section->area / lower_trunk->largest_section;
    const Scalar thigh = std::clamp((part - waist_alone<Scalar>) / (1 - waist_alone<Scalar>), Scalar(0), Scalar(1));
    return centre + thigh * (beside(place, up, *lower_trunk) - centre);
}

} // namespace detail

template <typename Scalar>
Placement<Scalar> narrow_hips(Placement<Scalar> placement, const std::vector<Limb<Scalar>>& limbs) {
    const std::vector<int> hips = placement.all(JointRole::hip);
    if (hips.size() != 2) return placement;
    const Vector3<Scalar> centre = Scalar(0.5) * (placement.at(hips[0]) + placement.at(hips[1]));
    Vector3<Scalar> across = placement.at(hips[0]) - placement.at(hips[1]);
    const Scalar rest = placement.rest_distance(hips[0], hips[1]);
    const Vector3<Scalar> thighs =
        detail::attachment_point(placement, limbs, hips[0]) - detail::attachment_point(placement, limbs, hips[1]);
    const bool crossed = across.dot(thighs) < detail::least_hip_distance<Scalar> * rest * thighs.norm();
    if (crossed) across = thighs;
    if (!crossed && across.norm() <= rest) return placement;
    placement.put(hips[0], centre + Scalar(0.5) * rest * across.normalized());
    placement.put(hips[1], centre - Scalar(0.5) * rest * across.normalized());
    return placement;
}

template <typename Scalar>
Placement<Scalar> place_trunk(Placement<Scalar> placement, const std::vector<Limb<Scalar>>& limbs,
                              const Slicer<Scalar>& slicer, const Vector3<Scalar>& junction,
                              const std::optional<TrunkAxis<Scalar>>& lower_trunk, const TrunkOptions& options) {
    using enum JointRole;
    const std::vector<TemplateJoint>& joints = placement.skeleton_template().joints;
    const Vector3<Scalar> low = *placement.middle(hip);
    const bool has_neck = placement.find(neck) >= 0;
    const int top = has_neck ? placement.find(neck) : placement.find(chest);
    if (!has_neck) placement.put(top, placement.middle(shoulder).value_or(junction));
    const Vector3<Scalar> axis = placement.at(top) - low;
    const Scalar flexion = detail::hip_flexion(placement, limbs, axis);
    const double rest_low = placement.rest_height(hip);
    const double rest_high = placement.skeleton_template().joint(top).position.y();
    for (int j = 0; j < static_cast<int>(joints.size()); ++j) {
        const JointRole role = placement.role(j);
        if (j == top || (role != pelvis && role != waist && role != chest) || (role == pelvis && lower_trunk)) continue;
        const double rest = placement.skeleton_template().joint(j).position.y();
        auto height = static_cast<Scalar>((rest - rest_low) / (rest_high - rest_low));
        if (role == waist) height -= static_cast<Scalar>(options.waist_lowering) * flexion;
        const Vector3<Scalar> p = low + height * axis;
        placement.put(j, role == waist ? detail::waist_near(p, axis, slicer, lower_trunk) : p);
    }
    return placement;
}

template <typename Scalar>
Placement<Scalar> raise_crotch(Placement<Scalar> placement, const std::vector<Limb<Scalar>>& limbs,
                               const TriangleMesh<Scalar>& mesh, const CrotchOptions& options) {
    const int low = placement.find(JointRole::pelvis), waist = placement.find(JointRole::waist);
    const int above = waist >= 0 ? waist : placement.find(JointRole::chest);
    const Scalar enough = static_cast<Scalar>(options.depth) * detail::thigh_thickness(placement, limbs);
    const Vector3<Scalar> start = placement.at(low), end = placement.at(above);
    for (int step = 0; step <= detail::crotch_steps; ++step) {
        const Scalar part = static_cast<Scalar>(step) * detail::highest_crotch<Scalar> / detail::crotch_steps;
        const Vector3<Scalar> p = start + part * (end - start);
        placement.put(low, p);
        if ((mesh.vertices.rowwise() - p.transpose()).rowwise().norm().minCoeff() >= enough) break;
    }
    return placement;
}

} // namespace skelgen::refinement
