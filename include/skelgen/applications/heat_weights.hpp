#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <skelgen/applications/bones.hpp>
#include <skelgen/applications/joint_weights.hpp>
#include <skelgen/applications/limb_regions.hpp>
#include <skelgen/core/outcome.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// What warms a surface, in one pose or in several.
struct Heat {
    Eigen::SparseMatrix<core::Accumulator> conduction; ///< n x n, positive semi-definite: `surface_laplacian`
    Eigen::VectorX<core::Accumulator> supply;   ///< per vertex its area over the squared distance of what heats it
    Eigen::MatrixX<core::Accumulator> of_joint; ///< n x joints: of that what comes from each joint
};

/// That of a body (BP07 section 4): each vertex is heated by the bone that is nearest to it, as seen through the body,
/// the stronger the nearer. A trunk's bone is nearer than a limb's at the same distance: distances count relative to
/// how thick the body is around the bone. `bones` in the body's coordinates. A limb's bones heat no vertex of another
/// limb's region, and none that is much farther from the limb's end along the surface than they are, as the flank is
/// that an arm lies against; without `regions` every bone heats any. `joints`: more than any bone's. O(n joints) looks
/// through the body.
template <typename Scalar>
[[nodiscard]] Heat heat_in(const Body<Scalar>& body, const std::vector<Bone<Scalar>>& bones, int joints,
                           const LimbRegions& regions = {});

/// That of one surface in several poses, same faces and other places: for weights that are smooth, and near to the
/// bones, in all of them together. O(n joints).
[[nodiscard]] Heat operator+(Heat heat, const Heat& other);

/// Weights as temperatures on a body: the heat spreads over the surface until it rests (BP07). One factorisation of a
/// sparse matrix, O(n^1.5). \returns a failure where no vertex sees a bone.
[[nodiscard]] Outcome<JointWeights> heat_weights(const Heat& heat);

/// The weights with narrower bends: cubed, with rows that sum to 1 again. Where vertices follow two joints alike,
/// linear skinning draws them towards the joint: the narrower that is, the less volume a bent limb loses, and the more
/// its edges stretch (`with_bounded_stretch`). With cubes a forearm or calf bent by 90 degrees loses 2 to 5 % instead
/// of 13 % (24 registered bodies). O(n joints).
[[nodiscard]] JointWeights concentrated(const JointWeights& weights);

/// The weights with narrower bends at elbows and knees: there the odds of following what is below the joint are
/// squared. What is above a hinge and what is below it is rigid, and the wider a bend, the more a limb that comes bent
/// bulges once it is straight, since skin that lay in the crease keeps its distance from the joint (`skinned`); what
/// bulges is lost when it bends again. Weights stay smooth, vertices follow the same joint most on each side of a
/// hinge, and rows sum to what they did. `weights` of concentrated heat. O(n joints).
[[nodiscard]] JointWeights with_narrow_hinges(JointWeights weights, const SkeletonTemplate& skeleton_template);

/// The weights with no vertex that follows two limbs: of the limbs that move a vertex the strongest does, by as much as
/// it is stronger than the next; what the others lose goes to the trunk where both limbs begin, as in the crotch and at
/// the neck, and to the strongest where surfaces of limbs have grown together. As smooth as they were but for the
/// latter. `least_to_trunk`: the part of it that goes to the trunk everywhere, 1 where a surface spans limbs, as a
/// skirt does. O(n joints).
[[nodiscard]] JointWeights following_one_limb(JointWeights weights, const SkeletonTemplate& skeleton_template,
                                              core::Accumulator least_to_trunk = 0);

/// The weights with no vertex that follows most a joint which none of its neighbours follows most, as may be left where
/// the realms of several bones meet: it gets the mean of those of its neighbours that follow most what most of them do.
/// `faces` name the weights' rows. O(faces + n joints).
[[nodiscard]] JointWeights without_islands(JointWeights weights, const Triangles& faces);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/heat_weights.hpp>
#endif
