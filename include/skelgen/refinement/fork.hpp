#pragma once

#include <optional>

#include <skelgen/core/mesh.hpp>
#include <skelgen/refinement/end_points.hpp>

namespace skelgen::refinement {

/// Where two limbs part: of all places on the surface that are equally far from both limbs' ends, the nearest. Between
/// the feet it lies between the legs, wherever those are. None when no path joins the ends. O(m).
template <typename Scalar>
[[nodiscard]] std::optional<Vector3<Scalar>> fork_between(const TriangleMesh<Scalar>& mesh, const EndPoint<Scalar>& a,
                                                          const EndPoint<Scalar>& b);

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/fork.hpp>
#endif
