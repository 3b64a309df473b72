#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/bone_line.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/trunk_axis.hpp>

namespace skelgen::refinement {

namespace detail {

/// Height of the hips above the fork of the legs along the trunk's line, which leans forward from the pelvis's own up
/// (`PelvisOptions`), as a part of the rest-pose thigh. Calibrated: mean over 50 registered bodies, its standard
/// deviation between and within people a seventh of it.
template <typename Scalar>
inline constexpr Scalar hips_above_fork = Scalar(0.16);

/// Standard deviation of that height for a thigh that prolongs the trunk, as a part of the thigh. Calibrated on the
/// same bodies.
template <typename Scalar>
inline constexpr Scalar least_top_deviation = Scalar(0.03);

/// How much more it is for a thigh at right angles to the trunk, whose skin takes the fork along. Calibrated on the
/// same bodies.
template <typename Scalar>
inline constexpr Scalar flexed_top_deviation = Scalar(0.15);

/// Tops that make a leg more unlike the template's than this (logarithm of length) are those of clothes. A working
/// value, as is the next one.
template <typename Scalar>
inline constexpr Scalar unlike_template = Scalar(0.22);

/// Tops that make the legs more unlike each other than this are, too.
template <typename Scalar>
inline constexpr Scalar unlike_other = Scalar(0.15);

/// The limb with its top where its first bone, as a straight line, comes nearest to `place`.
template <typename Scalar>
Limb<Scalar> with_top(Limb<Scalar> limb, const Vector3<Scalar>& place, const Vector3<Scalar>& up,
                      const BoneLineOptions& options) {
    const auto line = fit_first_bone(limb, options);
    if (!line) return limb;
    Eigen::Index nearest = 0;
    (limb.line.points.rowwise() - line->point.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    const Scalar outwards = (place - core::point(limb.line.points, nearest)).dot(line->direction);
    const Scalar from_tip = limb.line.arc[limb.line.arc.size() - 1] - limb.line.arc[nearest] - outwards;
    if (!(from_tip > 0) || std::abs(std::log(from_tip / limb.from_tip.front())) > unlike_template<Scalar>) return limb;
    limb.top_by_trunk = from_tip;
    const Scalar flexed = 1 + line->direction.dot(up), thigh = arc_of(limb, 1) - arc_of(limb, 0);
    limb.top_deviation = (least_top_deviation<Scalar> + flexed_top_deviation<Scalar> * flexed) * thigh;
    return limb;
}

} // namespace detail

/// The limbs with `top_by_trunk` and `top_deviation` of the two legs set: the pelvis is one bone, and its hips lie at
/// the same height above where the legs part in everybody, however the legs are held. `axis`: the lower trunk's;
/// `scale`: rest-pose length to body length. Left unset where there are no two legs, or a leg shows too little of its
/// thigh. O(limbs).
template <typename Scalar>
std::vector<Limb<Scalar>> anchor_hips(std::vector<Limb<Scalar>> limbs, const TrunkAxis<Scalar>& axis,
                                      const SkeletonTemplate& skeleton_template, Scalar scale,
                                      const BoneLineOptions& options = {}) {
    const std::vector<std::size_t> legs = find_legs(limbs, skeleton_template);
    if (legs.empty()) return limbs;
    const Scalar thigh = scale * rest_length_of_first_bone(limbs[legs[0]], skeleton_template);
    const Scalar below = (axis.place - axis.fork).dot(axis.up) - detail::hips_above_fork<Scalar> * thigh;
    const Vector3<Scalar> hips = axis.place - below * axis.up;
    for (const std::size_t leg : legs) limbs[leg] = detail::with_top(std::move(limbs[leg]), hips, axis.up, options);
    std::optional<Scalar>&one = limbs[legs[0]].top_by_trunk, &other = limbs[legs[1]].top_by_trunk;
    if (one && other && std::abs(std::log(*one / *other)) > detail::unlike_other<Scalar>) one = other = std::nullopt;
    return limbs;
}

} // namespace skelgen::refinement
