#pragma once

#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// Where a joint's bone is in an arm or a leg, by ways along the bones from the limb's end.
struct BoneOfLimb {
    core::Accumulator limb = 0;           ///< the way to the limb's first joint; 0 where the joint is of no arm or leg
    core::Accumulator begin = 0, end = 0; ///< the same for a hand and a foot: ways on these go around thumbs and heels
};

/// Where the limbs of a body are on its surface: arms, legs, and neck and head.
struct LimbRegions {
    std::vector<int> of_joint;  ///< per joint the limb that it moves; -1 for the trunk, and for a limb without length
    std::vector<int> of_vertex; ///< per vertex of the body the limb that it may belong to; -1 where no path leads
    std::vector<core::Accumulator> from_end = {}; ///< per vertex the way to it along the surface from that limb's end
    std::vector<BoneOfLimb> bones = {};           ///< per joint
};

/// The limb that each vertex may belong to: the one whose end is nearest along the surface, each in its own length from
/// the end to its first joint; a head, which may be as wide as it is high, in that over its surface. So hands that hold
/// each other, or lie on a thigh, are told apart, as they are far from each other along the surface; where regions meet
/// lies in the trunk. A limb that is cut ends where its last joint is. `skeleton` in the coordinates of the body. One
/// search along the surface per limb, O(n). \throws Error usage when the skeleton's joints are not the template's.
template <typename Scalar>
[[nodiscard]] LimbRegions limb_regions(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                                       const SkeletonTemplate& skeleton_template);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/limb_regions.hpp>
#endif
