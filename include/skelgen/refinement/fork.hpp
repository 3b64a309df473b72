#pragma once

#include <optional>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/refinement/end_points.hpp>

namespace skelgen::refinement {

/// Where two limbs part: of all places on the surface that are equally far from both limbs' ends, the nearest. Between
/// the feet it lies between the legs, wherever those are. None when no path joins the ends. O(m).
template <typename Scalar>
[[nodiscard]] std::optional<Vector3<Scalar>> fork_between(const TriangleMesh<Scalar>& mesh, const EndPoint<Scalar>& a,
                                                          const EndPoint<Scalar>& b);

/// A place on the surface where a way from one limb's end to another's may pass from the one limb to the other.
template <typename Scalar>
struct Crossing {
    int level = 0;         ///< by how many steps it is farther from the first end than from the second
    Scalar way = 0;        ///< distance from the first end
    Vector3<Scalar> place; ///< on an edge
};

/// All crossings of edges between two limbs' ends, where the distances from these differ by a multiple of `step`, up to
/// `reach` of either sense. None when no path joins the ends. O(m reach / step) at worst, O(m) when `step` is no
/// shorter than edges are.
template <typename Scalar>
[[nodiscard]] std::vector<Crossing<Scalar>> crossings_between(const TriangleMesh<Scalar>& mesh,
                                                              const EndPoint<Scalar>& a, const EndPoint<Scalar>& b,
                                                              Scalar reach, Scalar step);

/// Where two legs part below a trunk whose axis runs through `place` along the unit vector `up`. On each level the one
/// that is lowest along the axis, if the way there is not the longer by more: legs that are raised meet at the front
/// of the pelvis sooner than below it. Of the levels' places the highest, since one leg may be bent, so that the way to
/// its foot is shorter; a place on a raised thigh is off the axis, which counts as lying down as far. `crossings` may
/// not be empty. O(k).
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> fork_along(const std::vector<Crossing<Scalar>>& crossings, const Vector3<Scalar>& place,
                                         const Vector3<Scalar>& up);

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/fork.hpp>
#endif
