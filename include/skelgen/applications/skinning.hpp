#pragma once

#include <vector>

#include <Eigen/Geometry>

#include <skelgen/applications/canonical_frame.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::applications {

/// How much each joint moves each vertex of a mesh: at most four of them do, the strongest first.
template <typename Scalar = double>
struct Skin {
    static constexpr int influences = 4;
    Eigen::Matrix<int, Eigen::Dynamic, influences, Eigen::RowMajor> joints;     ///< n x 4; 0 where the weight is 0
    Eigen::Matrix<Scalar, Eigen::Dynamic, influences, Eigen::RowMajor> weights; ///< n x 4; rows fall, and sum to 1
};

/// The skin with the four strongest of any number of weights each. What the fifth strongest has is taken from all, so
/// that the weights stay as smooth as they were. What a float beside the strongest one would lose counts as nothing, as
/// files hold floats. `weights`: n x joints, not negative, of a positive sum in each row.
/// O(n joints).
template <typename Scalar>
[[nodiscard]] Skin<Scalar> strongest_influences(const Eigen::MatrixX<Scalar>& weights);

/// Dual quaternion skinning (KCZO07): points moved by the mean of their joints' rigid motions, which is rigid itself,
/// so that limbs keep their volume where they bend and twist. As many points as `skin` has rows. O(n).
template <typename Scalar>
[[nodiscard]] Points<Scalar> skinned(const Points<Scalar>& points, const Skin<Scalar>& skin,
                                     const std::vector<RigidMotion<Scalar>>& motions);

/// How each vertex of a mesh has been turned, from one pose to another.
template <typename Scalar = double>
using VertexTurns = std::vector<Eigen::Quaternion<Scalar>>;

/// How `skinned` turns what is at each point, as the surface's normals. O(n).
template <typename Scalar>
[[nodiscard]] VertexTurns<Scalar> skin_turns(const Skin<Scalar>& skin, const std::vector<RigidMotion<Scalar>>& motions);

/// Linear blend skinning: points moved to the mean of where their joints move them, as viewers of glTF do it. O(n).
template <typename Scalar>
[[nodiscard]] Points<Scalar> skinned_linearly(const Points<Scalar>& points, const Skin<Scalar>& skin,
                                              const std::vector<RigidMotion<Scalar>>& motions);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/skinning.hpp>
#endif
