// The way of a mesh with hints, compiled once for each scalar.

#include <skelgen/impl/extract_hinted.hpp>

namespace skelgen {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template KinematicSkeleton<Scalar> bent_to(KinematicSkeleton<Scalar>, const SkeletonTemplate&,                     \
                                               const std::vector<Hint>&, Scalar);                                      \
    template Extraction<Scalar> extract_hinted(TriangleMesh<Scalar>, const std::vector<Hint>&, const ExtractOptions&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen
