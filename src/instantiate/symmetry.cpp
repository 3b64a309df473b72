// The symmetry compiled once, for float and double.

#include <skelgen/symmetry/impl/exact_mirror.hpp>
#include <skelgen/symmetry/impl/front_of_surface.hpp>
#include <skelgen/symmetry/impl/sides.hpp>

namespace skelgen::symmetry {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template Outcome<SidesDecision<Scalar>> decide_sides(const refinement::RefinedJoints<Scalar>&,                     \
                                                         const SkeletonTemplate&, const SurfaceFront<Scalar>&);        \
    template SurfaceFront<Scalar> front_of_surface(const Body<Scalar>&, const refinement::RefinedJoints<Scalar>&,      \
                                                   const SkeletonTemplate&, const Points<Scalar>*);                    \
    template KinematicSkeleton<Scalar> assemble(const refinement::RefinedJoints<Scalar>&, const SkeletonTemplate&,     \
                                                const SidesDecision<Scalar>&);                                         \
    template std::optional<ExactMirror<Scalar>> exact_mirror(const TriangleMesh<Scalar>&);                             \
    template bool is_mirrored(const KinematicSkeleton<Scalar>&, const SkeletonTemplate&, const ExactMirror<Scalar>&,   \
                              Scalar);                                                                                 \
    template KinematicSkeleton<Scalar> mirrored_evenly(KinematicSkeleton<Scalar>, const SkeletonTemplate&,             \
                                                       const ExactMirror<Scalar>&, Scalar);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::symmetry
