#pragma once

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/quadruped/limbs.hpp>

namespace skelgen::quadruped {

/// The joints of an animal in the curve's coordinates: each at its share of the way along its limb, trunk, neck or tail
/// and off that by its part of the animal's size, both as they go with the way's shape and the animal's build
/// (joint_table.hpp). A tail that is not there has no joints. Confidences
/// are 1. The template's plan must be quadruped and its rules kept (core/template_rules.hpp). O(joints * nodes).
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> place_joints(const CurveSkeleton<Scalar>& curve, const Limbs<Scalar>& limbs,
                                                     const SkeletonTemplate& skeleton_template);

} // namespace skelgen::quadruped

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/quadruped/impl/place_joints.hpp>
#endif
