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

/// The shortest way over the surface from one limb's end to the other's, `reach` to both sides of the fork between
/// them: a place (k x 3, in order) for each `step` by which the distances from the ends differ more. No rows when no
/// path joins the ends. O(m reach / step) at worst, O(m) when `step` is no shorter than edges are.
template <typename Scalar>
[[nodiscard]] Points<Scalar> way_between(const TriangleMesh<Scalar>& mesh, const EndPoint<Scalar>& a,
                                         const EndPoint<Scalar>& b, Scalar reach, Scalar step);

/// Of the places on the way between two legs, the one highest along the trunk, whose axis runs through `place` along
/// the unit vector `up`: there the legs part, even where one is bent, so that the way to its foot is shorter. A way
/// along a raised thigh leads away from the axis as it rises: that counts as going down as far. `way` may not be
/// empty. O(k).
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> highest_on(const Points<Scalar>& way, const Vector3<Scalar>& place,
                                         const Vector3<Scalar>& up);

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/fork.hpp>
#endif
