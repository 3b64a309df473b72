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
    template Outcome<MovedInside<Scalar>> move_inside(KinematicSkeleton<Scalar>, const Body<Scalar>&,                  \
                                                      const CurveSkeleton<Scalar>&);                                   \
    template KinematicSkeleton<Scalar> measure_radii(KinematicSkeleton<Scalar>, const Body<Scalar>&);                  \
    template KinematicSkeleton<Scalar> no_surer_than_the_whole(KinematicSkeleton<Scalar>);                             \
    template JudgedSkeleton<Scalar> estimate_confidence(KinematicSkeleton<Scalar>, const SkeletonTemplate&,            \
                                                        const std::vector<Scalar>&, const std::vector<int>&);          \
    template Outcome<JudgedSkeleton<Scalar>> complete_skeleton(KinematicSkeleton<Scalar>, const Body<Scalar>&,         \
                                                               const CurveSkeleton<Scalar>&, const SkeletonTemplate&);

SKELGEN_INSTANTIATE(float)
SKELGEN_INSTANTIATE(double)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::anatomy
