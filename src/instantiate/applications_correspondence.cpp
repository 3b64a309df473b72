// Which place of one body is which of another, compiled once, for float and double.

#include <skelgen/applications/impl/correspondence.hpp>
#include <skelgen/applications/impl/laplace_basis.hpp>

namespace skelgen::applications {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template LaplaceBasis laplace_basis(const TriangleMesh<Scalar>&, int);                                             \
    template ComparableBody<Scalar> comparable(const Body<Scalar>&, const KinematicSkeleton<Scalar>&,                  \
                                               const CorrespondenceOptions&);                                          \
    template Correspondence correspond(const ComparableBody<Scalar>&, const ComparableBody<Scalar>&,                   \
                                       const CorrespondenceOptions&);                                                  \
    template std::vector<TrianglePlace> triangle_places(const TriangleMesh<Scalar>&, const Body<Scalar>&,              \
                                                        const ComparableBody<Scalar>&, const Correspondence&);         \
    template std::vector<Landmark> landmarks(const ComparableBody<Scalar>&, const Correspondence&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::applications
