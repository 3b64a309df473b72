// The applications that move a body, compiled once for each scalar.

#include <skelgen/applications/impl/bone_orientations.hpp>
#include <skelgen/applications/impl/bone_sections.hpp>
#include <skelgen/applications/impl/curve_skin.hpp>
#include <skelgen/applications/impl/floor.hpp>
#include <skelgen/applications/impl/pose_transfer.hpp>
#include <skelgen/applications/impl/posing.hpp>
#include <skelgen/applications/impl/rig.hpp>
#include <skelgen/applications/impl/skinning.hpp>

namespace skelgen::applications {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template std::vector<BoneSection<Scalar>> bone_sections(const Body<Scalar>&, const KinematicSkeleton<Scalar>&,     \
                                                            const SkeletonTemplate&, int);                             \
    template Skin<Scalar> curve_skin(const CurveSkeleton<Scalar>&, const Skin<Scalar>&, int);                          \
    template Orientations<Scalar> rest_axes(const SkeletonTemplate&);                                                  \
    template Orientations<Scalar> bone_orientations(const KinematicSkeleton<Scalar>&, const SkeletonTemplate&);        \
    template Orientations<Scalar> bone_axes(const KinematicSkeleton<Scalar>&, const SkeletonTemplate&,                 \
                                            const Orientations<Scalar>&);                                              \
    template Orientations<Scalar> orientations_in(RestPose, const SkeletonTemplate&, const Orientations<Scalar>&,      \
                                                  const Eigen::Quaternion<Scalar>&);                                   \
    template std::vector<Vector3<Scalar>> girdle_lines(const KinematicSkeleton<Scalar>&, const Orientations<Scalar>&,  \
                                                       const KinematicSkeleton<Scalar>&, const Orientations<Scalar>&,  \
                                                       const SkeletonTemplate&);                                       \
    template std::vector<RigidMotion<Scalar>> motions(const KinematicSkeleton<Scalar>&, const Orientations<Scalar>&,   \
                                                      const Orientations<Scalar>&, const Vector3<Scalar>&,             \
                                                      const std::vector<Vector3<Scalar>>&);                            \
    template std::vector<RigidMotion<Scalar>> rest_motions(RestPose, const KinematicSkeleton<Scalar>&,                 \
                                                           const SkeletonTemplate&, const Orientations<Scalar>&,       \
                                                           const Eigen::Quaternion<Scalar>&);                          \
    template KinematicSkeleton<Scalar> moved(const KinematicSkeleton<Scalar>&, const SkeletonTemplate&,                \
                                             const std::vector<RigidMotion<Scalar>>&);                                 \
    template Skin<Scalar> strongest_influences(const Eigen::MatrixX<Scalar>&);                                         \
    template Points<Scalar> skinned(const Points<Scalar>&, const Skin<Scalar>&,                                        \
                                    const std::vector<RigidMotion<Scalar>>&);                                          \
    template VertexTurns<Scalar> skin_turns(const Skin<Scalar>&, const std::vector<RigidMotion<Scalar>>&);             \
    template Points<Scalar> skinned_linearly(const Points<Scalar>&, const Skin<Scalar>&,                               \
                                             const std::vector<RigidMotion<Scalar>>&);                                 \
    template Scalar height_by_bones(const KinematicSkeleton<Scalar>&, const SkeletonTemplate&);                        \
    template Rig<Scalar> make_rig(const TriangleMesh<Scalar>&, const Body<Scalar>&, const KinematicSkeleton<Scalar>&,  \
                                  const SkeletonTemplate&, const RigOptions&);                                         \
    template PosedBody<Scalar> pose_like(const TriangleMesh<Scalar>&, const Body<Scalar>&,                             \
                                         const KinematicSkeleton<Scalar>&, const KinematicSkeleton<Scalar>&,           \
                                         const SkeletonTemplate&);                                                     \
    template Floor<Scalar> floor_of(const TriangleMesh<Scalar>&, const KinematicSkeleton<Scalar>&,                     \
                                    const SkeletonTemplate&);                                                          \
    template Vector3<Scalar> upright(const TriangleMesh<Scalar>&, const KinematicSkeleton<Scalar>&,                    \
                                     const SkeletonTemplate&);                                                         \
    template PosedBody<Scalar> put_on(PosedBody<Scalar>, const Floor<Scalar>&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::applications
