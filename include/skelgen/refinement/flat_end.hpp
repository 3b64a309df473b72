#pragma once

#include <skelgen/core/mesh.hpp>
#include <skelgen/refinement/end_points.hpp>
#include <skelgen/refinement/limbs.hpp>

namespace skelgen::refinement {

/// How much of the limb's cross-section the largest flat piece of its end that faces outwards along it covers: about 1
/// where the limb is cut off and closed by a lid, a tenth where it is round; fingers and toes have less. `length`: how
/// far from the end the limb's thickness and direction are taken, in the body's unit. `end` is the limb's. 0 where the
/// limb has no sections there, and where the mesh's edges are as long as it is thick: any end is flat then. O(n).
template <typename Scalar>
[[nodiscard]] Scalar flat_end(const TriangleMesh<Scalar>& mesh, const Limb<Scalar>& limb, const EndPoint<Scalar>& end,
                              Scalar length);

/// How much of the limb's cross-section a hole that was closed around its end encloses, seen along the limb: 1 where
/// that is half or more, the limb being cut off and left open, and 0.6 at most where the hole faces aside, as that of a
/// missing sole does. Parameters as above. 0 without such a hole and where the mesh is too coarse. O(n) for n sections
/// and faces.
template <typename Scalar>
[[nodiscard]] Scalar open_end(const TriangleMesh<Scalar>& mesh, const Limb<Scalar>& limb, const EndPoint<Scalar>& end,
                              Scalar length);

/// How much a limb's surface, over `length` from its end, looks to four sides at right angles: 0 where it is round, 0.2
/// where it is twice as wide as thick, 1 on a box, as the arms of block figures are: their ends are flat, and no
/// thinner than the rest. `end` is the limb's. O(n).
template <typename Scalar>
[[nodiscard]] Scalar four_sidedness(const TriangleMesh<Scalar>& mesh, const Limb<Scalar>& limb,
                                    const EndPoint<Scalar>& end, Scalar length);

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/flat_end.hpp>
#endif
