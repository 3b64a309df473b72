#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/refinement/bone_line.hpp>
#include <skelgen/refinement/centreline.hpp>
#include <skelgen/refinement/end_points.hpp>
#include <skelgen/refinement/head.hpp>
#include <skelgen/refinement/limb_joints.hpp>
#include <skelgen/refinement/pelvis.hpp>
#include <skelgen/refinement/thickness_profile.hpp>
#include <skelgen/refinement/trunk_joints.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::refinement {

/// Constants of every step of the refinement (LF20 section 3.2).
struct RefinementOptions {
    CentrelineOptions centreline;
    BoneLineOptions bone_line;
    ThicknessProfileOptions thickness_profile;
    HeadOptions head;
    double larger_head = 1.2; ///< in adult heads: a head from this size on is a child's
    NeckOptions neck;
    WristOptions wrist;
    BendOptions bend;
    GirdleOptions girdle;
    PelvisOptions pelvis;
    TrunkOptions trunk;
    CrotchOptions crotch;
    bool limbs_may_be_cut = true; ///< false: an end that is flat or open is that of a whole limb
};

/// \throws Error usage when an option, of whatever step, is out of its range.
inline void validate(const RefinementOptions& options) {
    validate(options.centreline);
    validate(options.bone_line);
    validate(options.thickness_profile);
    validate(options.head);
    core::require_in_range("refinement.larger_head", options.larger_head, 0.0, 100.0);
    validate(options.neck);
    validate(options.wrist);
    validate(options.bend);
    validate(options.girdle);
    validate(options.pelvis);
    validate(options.trunk);
    validate(options.crotch);
}

/// Joints in template order, and the limbs' ends on the surface, in the body's coordinates. Left and right are still
/// those of the embedding.
template <typename Scalar = double>
struct RefinedJoints {
    Points<Scalar> positions;     ///< per template joint; of those beyond the end of a limb that is cut off, that end
    std::vector<bool> is_present; ///< per template joint; empty: all are
    std::vector<std::pair<int, Vector3<Scalar>>> tips; ///< end joint and the end of its limb, where that is whole
    std::optional<HeadShape<Scalar>> head;             ///< none when the template has no neck, or no head is seen
};

/// Places all joints of an embedded template by cross-sections of the body's surface and prior knowledge. `ends` as
/// from find_end_points. O(sections (n + m)). \throws Error usage when an option is out of its range.
template <typename Scalar>
[[nodiscard]] RefinedJoints<Scalar> refine(const Body<Scalar>& body, const std::vector<EndPoint<Scalar>>& ends,
                                           const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding,
                                           const SkeletonTemplate& skeleton_template,
                                           const RefinementOptions& options = {});

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/refine.hpp>
#endif
