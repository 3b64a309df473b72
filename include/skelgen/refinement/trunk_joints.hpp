#pragma once

#include <optional>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/refinement/cross_section.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/placement.hpp>
#include <skelgen/refinement/trunk_axis.hpp>

namespace skelgen::refinement {

/// How the trunk bends.
struct TrunkOptions {
    double waist_lowering = 0.05; ///< per radian of hip flexion, of the distance from hips to neck: the pelvis tilts
                                  ///< with the thighs; calibrated
};

/// How deep in the body the crotch lies.
struct CrotchOptions {
    double depth = 0.75; ///< in mean thigh thicknesses: a root nearer to the surface is raised (LF20 section 3.2.2: 1)
};

/// \throws Error usage when an option is out of its range.
inline void validate(const TrunkOptions& options) {
    core::require_in_range("refinement.trunk.waist_lowering", options.waist_lowering, -1.0, 1.0);
}

/// \throws Error usage when an option is out of its range.
inline void validate(const CrotchOptions& options) {
    core::require_in_range("refinement.crotch.depth", options.depth, 0.0, 100.0);
}

/// Hips: on the line between them (LF20 section 3.2.2), at their rest-pose distance. The line of a thigh passes its hip
/// on the outside, since a thigh bone runs inwards from the hip's neck.
template <typename Scalar>
[[nodiscard]] Placement<Scalar> narrow_hips(Placement<Scalar> placement, const std::vector<Limb<Scalar>>& limbs);

/// Trunk: from the middle of the hips to the neck (or else to the middle of the shoulders, or else to `junction`, where
/// the curve's arms branch off), joints at their rest-pose heights; the waist in the centre of its section, and the
/// nearer to the hips the more they are flexed. Hips must have been placed, and neck and shoulders if there are any.
/// With `lower_trunk` the root must have been placed, too, and stays where it is; and the larger the waist's section
/// is, since it holds of a raised thigh, the nearer the waist is to that axis: on it from `largest_section` on.
template <typename Scalar>
[[nodiscard]] Placement<Scalar> place_trunk(Placement<Scalar> placement, const std::vector<Limb<Scalar>>& limbs,
                                            const Slicer<Scalar>& slicer, const Vector3<Scalar>& junction,
                                            const std::optional<TrunkAxis<Scalar>>& lower_trunk = std::nullopt,
                                            const TrunkOptions& options = {});

/// Crotch: nearer to the surface than a thigh is thick, it lies too low and moves towards the waist (LF20 section
/// 3.2.2), no farther than to the middle of that bone. O(n).
template <typename Scalar>
[[nodiscard]] Placement<Scalar> raise_crotch(Placement<Scalar> placement, const std::vector<Limb<Scalar>>& limbs,
                                             const TriangleMesh<Scalar>& mesh, const CrotchOptions& options = {});

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/trunk_joints.hpp>
#endif
