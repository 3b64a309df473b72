// The anatomy compiled once, for float and double.

#include <skelgen/anatomy/impl/complete.hpp>
#include <skelgen/anatomy/impl/confidence.hpp>
#include <skelgen/anatomy/impl/equal_bones.hpp>
#include <skelgen/anatomy/impl/inside.hpp>
#include <skelgen/anatomy/impl/joint_offsets.hpp>
#include <skelgen/anatomy/impl/radii.hpp>

namespace skelgen::anatomy {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template KinematicSkeleton<Scalar> apply_joint_offsets(KinematicSkeleton<Scalar>, const SkeletonTemplate&);        \
    template std::vector<Scalar> bone_lengths(const KinematicSkeleton<Scalar>&);                                       \
    template EqualBones<Scalar> equalise_bones(KinematicSkeleton<Scalar>, const SkeletonTemplate&);                    \
    template MovedInside<Scalar> move_inside(KinematicSkeleton<Scalar>, const Body<Scalar>&,                           \
                                             const CurveSkeleton<Scalar>&);                                            \
    template KinematicSkeleton<Scalar> measure_radii(KinematicSkeleton<Scalar>, const Body<Scalar>&);                  \
    template std::vector<double> joint_doubts(const KinematicSkeleton<Scalar>&, const SkeletonTemplate&,               \
                                              const std::vector<Scalar>&);                                             \
    template CompletedSkeleton<Scalar> complete_skeleton(KinematicSkeleton<Scalar>, const Body<Scalar>&,               \
                                                         const CurveSkeleton<Scalar>&, const SkeletonTemplate&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::anatomy
