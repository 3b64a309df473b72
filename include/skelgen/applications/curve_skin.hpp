#pragma once

#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/curve_skeleton.hpp>

namespace skelgen::applications {

/// How much each joint moves each node of a curve skeleton: the mean of the weights of the node's region, so that the
/// curve bends with the body; a node without one has those of the nearest node with one. `skin` is of the mesh whose
/// vertices the regions index, `joints` how many joints it knows. \throws Error usage when the curve has not one region
/// a node, one names no vertex of the skin, all are empty, or the skin knows more joints. O(n joints + k^2), n vertices
/// and k nodes.
template <typename Scalar>
[[nodiscard]] Skin<Scalar> curve_skin(const CurveSkeleton<Scalar>& curve, const Skin<Scalar>& skin, int joints);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/curve_skin.hpp>
#endif
