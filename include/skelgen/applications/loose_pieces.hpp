#pragma once

#include <vector>

#include <skelgen/applications/joint_weights.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// The weights of an input with those of its loose pieces found anew: of clothes, hair, weapons and bags that are no
/// part of the body, whose vertices have them from the nearest place on it. A piece follows what it touches, and what
/// hangs free moves with the rest of the piece: its own surface, and pieces of this kind that touch, conduct; the body
/// warms each vertex by its weights there, the less the farther it is (as bones do, BP07). So a skirt's middle, far
/// from both legs, is shared by them, by way of the trunk. Of an arm and all else, a piece does not follow what gives
/// it less than a twentieth of its heat, unless it surrounds the shoulder: a bow goes with the hand that holds it,
/// though it passes a thigh, and a quiver with the hip, though an elbow is near. `weights`, one row a vertex of the
/// mesh that the body was made of, and `gaps`, how far each vertex is from the place that gave it its row; these and
/// `skeleton` in the coordinates of the body. O(n^1.5) in the vertices of loose pieces.
template <typename Scalar>
[[nodiscard]] JointWeights with_loose_pieces(JointWeights weights, const TriangleMesh<Scalar>& mesh,
                                             const Body<Scalar>& body, const std::vector<Scalar>& gaps,
                                             const KinematicSkeleton<Scalar>& skeleton,
                                             const SkeletonTemplate& skeleton_template);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/loose_pieces.hpp>
#endif
