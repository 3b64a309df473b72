// The bones of fingers compiled once, for float and double.

#include <skelgen/applications/impl/finger_bones.hpp>

namespace skelgen::applications {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template Rig<Scalar> with_finger_bones(Rig<Scalar>, const TriangleMesh<Scalar>&, const KinematicSkeleton<Scalar>&, \
                                           const SkeletonTemplate&, const std::vector<hands::Hand<Scalar>>&);          \
    template Rig<Scalar> without_finger_bones(Rig<Scalar>, std::size_t);                                               \
    template Animation<Scalar> with_held_fingers(Animation<Scalar>, const Rig<Scalar>&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::applications
