#pragma once

#include <skelgen/extract.hpp>

namespace skelgen {

/// As `extract`, with the skeleton already known, as one that has been put right by hand: nothing is searched for. The
/// body is the surface that has the most of the joints inside. `skeleton`: in the mesh's coordinates, of a built-in
/// template. \throws Error usage when an option is out of its range; bad_input when `mesh` is no usable surface, the
/// skeleton is of no built-in template, or fewer than half of its joints lie in the body; NoSkeleton when there are
/// several bodies and none is chosen. O(n log n).
template <typename Scalar>
[[nodiscard]] Extraction<Scalar> fit_skeleton(TriangleMesh<Scalar> mesh, KinematicSkeleton<Scalar> skeleton,
                                              const ExtractOptions& options = {});

} // namespace skelgen

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/impl/fit_skeleton.hpp>
#endif
