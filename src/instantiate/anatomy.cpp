// The anatomy compiled once, for float and double.

#include <skelgen/anatomy/impl/complete.hpp>
#include <skelgen/anatomy/impl/confidence.hpp>

namespace skelgen::anatomy {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template std::vector<double> joint_doubts(const KinematicSkeleton<Scalar>&, const SkeletonTemplate&,               \
                                              const std::vector<Scalar>&);                                             \
    template CompletedSkeleton<Scalar> complete_skeleton(KinematicSkeleton<Scalar>, const Body<Scalar>&,               \
                                                         const CurveSkeleton<Scalar>&, const SkeletonTemplate&);       \
    template KinematicSkeleton<Scalar> with_joints_at(const Points<Scalar>&, KinematicSkeleton<Scalar>,                \
                                                      const Body<Scalar>&, const CurveSkeleton<Scalar>&,               \
                                                      const SkeletonTemplate&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::anatomy
