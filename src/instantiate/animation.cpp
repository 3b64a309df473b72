// The applications that have a rig move, compiled once for each scalar.

#include <skelgen/applications/impl/animation.hpp>
#include <skelgen/applications/impl/clip_body.hpp>
#include <skelgen/applications/impl/motion_clip.hpp>
#include <skelgen/applications/impl/retarget.hpp>

namespace skelgen::applications {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template std::vector<RigidMotion<Scalar>> motions(const std::vector<RigJoint<Scalar>>&, const RigPose<Scalar>&);   \
    template TriangleMesh<Scalar> posed(const Rig<Scalar>&, const RigPose<Scalar>&);                                   \
    template Animation<Scalar> on_floor(const Rig<Scalar>&, Animation<Scalar>);                                        \
    template Outcome<Animation<Scalar>> retarget(const MotionClip&, const Rig<Scalar>&, const SkeletonTemplate&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::applications
