#pragma once

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/quadruped/limbs.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::quadruped {

/// The joints of an animal in its curve, which is in the body's coordinates: each at a share of the way along its limb,
/// trunk, neck or tail, and off that by a weighted sum of directions that turn and grow with the animal
/// (joint_table.hpp). A tail that is not there has no joints. Confidences are 1. The template's plan must be quadruped
/// and its rules kept (core/template_rules.hpp). O(joints * (nodes + log faces)).
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> place_joints(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                                                     const Limbs<Scalar>& limbs,
                                                     const SkeletonTemplate& skeleton_template);

} // namespace skelgen::quadruped

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/quadruped/impl/place_joints.hpp>
#endif
