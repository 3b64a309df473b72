// Four-legged animals compiled for one scalar.

#include <skelgen/quadruped/impl/limbs.hpp>
#include <skelgen/quadruped/impl/place_joints.hpp>

namespace skelgen::quadruped {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template std::vector<Limbs<Scalar>> find_limbs(const CurveSkeleton<Scalar>&, std::size_t);                         \
    template KinematicSkeleton<Scalar> place_joints(const Body<Scalar>&, const CurveSkeleton<Scalar>&,                 \
                                                    const Limbs<Scalar>&, const SkeletonTemplate&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::quadruped
