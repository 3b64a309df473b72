#pragma once

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
};

/// That of a finished skeleton's hand; none where the arm ends before it, or where its joints lie in one place.
template <typename Scalar>
[[nodiscard]] std::optional<HandPlace<Scalar>> hand_place(const KinematicSkeleton<Scalar>& skeleton, Side side);

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
