// The way of a mesh through all stages, compiled once for each scalar.

#include <skelgen/impl/extract.hpp>
#include <skelgen/impl/fit_skeleton.hpp>

namespace skelgen {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template Extraction<Scalar> detail::extraction_of(search::Climb<Scalar>, const search::Found<Scalar>&,             \
                                                      KinematicSkeleton<Scalar>, SkeletonTemplate,                     \
                                                      const ExtractOptions&);                                          \
    template Extraction<Scalar> extract_in(const TriangleMesh<Scalar>&, const ExtractOptions&);                        \
    template Extraction<Scalar> extract(TriangleMesh<Scalar>, const ExtractOptions&);                                  \
    template Extraction<Scalar> fit_skeleton(TriangleMesh<Scalar>, KinematicSkeleton<Scalar>, const ExtractOptions&);  \
    template std::vector<curve::CurveResult<Scalar>> find_curves(const TriangleMesh<Scalar>&, const ExtractOptions&);  \
    template CurveSkeleton<Scalar> find_curve_skeleton(const TriangleMesh<Scalar>&, const ExtractOptions&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen
