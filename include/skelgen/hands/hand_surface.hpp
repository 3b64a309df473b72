#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/winding_tree.hpp>

namespace skelgen::hands {

/// Where a hand is, as the skeleton has it.
template <typename Scalar = double>
struct HandPlace {
    Vector3<Scalar> elbow, wrist, knuckles, tip;

    /// From the wrist to the fingertip: the unit of all that is said about a hand.
    [[nodiscard]] Scalar length() const { return (tip - wrist).norm(); }

    /// How long it is when it is stretched: a fist's tip is near the wrist, but its digits are as long as others'.
    [[nodiscard]] Scalar stretched() const {
        constexpr Scalar of_forearm = Scalar(0.74); // people's: .108 and .146 of the body's height (Win09)
        return std::max(length(), of_forearm * (wrist - elbow).norm());
    }
};

/// That of a finished skeleton's hand; none where the arm ends before it, or where its joints lie in one place.
template <typename Scalar>
[[nodiscard]] std::optional<HandPlace<Scalar>> hand_place(const KinematicSkeleton<Scalar>& skeleton, Side side);

/// That of the front of a foot, whose digits are its toes: the instep for the wrist, the ball for the knuckles; none
/// where the leg ends before the foot.
template <typename Scalar>
[[nodiscard]] std::optional<HandPlace<Scalar>> toes_place(const KinematicSkeleton<Scalar>& skeleton, Side side);

/// The surface of a hand, and how far its places are from the forearm along it.
template <typename Scalar = double>
struct HandSurface {
    TriangleMesh<Scalar> mesh;
    Triangles adjacency; ///< as from core::face_adjacency
    core::SurfaceGraph<Scalar> graph;
    std::vector<int> source;         ///< per vertex that of the surface it was taken from
    std::vector<bool> is_at_rim;     ///< per vertex: the surface goes on beyond it
    Eigen::VectorX<Scalar> distance; ///< per vertex, from a plane across the forearm
};

/// What of a surface is beyond a plane across the forearm and near the hand: of the parts that hang together the one
/// nearest to the knuckles. None where there is none, or too little of it to have digits. `mesh` must be edge-manifold
/// and in the unit of `place`. O(faces + k log k) for the k vertices there.
template <typename Scalar>
[[nodiscard]] std::optional<HandSurface<Scalar>> hand_surface(const TriangleMesh<Scalar>& mesh,
                                                              const HandPlace<Scalar>& place);

/// A mesh without the pieces that leave a hand's surroundings, but do not wind around the forearm: what the hand holds,
/// clothes and the body behind it. None where all are the arm's, or none is. `mesh` must have no seams and be in the
/// unit of `place`. O(n log n), and O(faces) for each piece that comes near.
template <typename Scalar>
[[nodiscard]] std::optional<TriangleMesh<Scalar>> arm_pieces(const TriangleMesh<Scalar>& mesh,
                                                             const HandPlace<Scalar>& place);

/// As hand_surface, of any mesh without seams: cut where it is not manifold, and where its faces are few made rounder.
/// Digits that touch each other, or what they hold, stay apart on it, as they do in no envelope. O(n log n).
template <typename Scalar>
[[nodiscard]] std::optional<HandSurface<Scalar>> own_hand_surface(const TriangleMesh<Scalar>& mesh,
                                                                  const HandPlace<Scalar>& place);

/// One closed surface around all that encloses something near a hand, of cells as fine as digits need: where the
/// winding number is one half (JKS13). For hands of many pieces, of few triangles, or that an envelope of the whole
/// body has no room for. `tree` of `mesh`, whose faces must look outwards. O(faces + cells log faces).
template <typename Scalar>
[[nodiscard]] TriangleMesh<Scalar> hand_envelope(const TriangleMesh<Scalar>& mesh,
                                                 const surface::WindingTree<Scalar>& tree,
                                                 const HandPlace<Scalar>& place);

} // namespace skelgen::hands

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/hands/impl/hand_surface.hpp>
#endif
