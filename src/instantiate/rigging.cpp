// The applications that move a body, compiled once for each scalar.

#include <skelgen/applications/impl/balanced_bends.hpp>
#include <skelgen/applications/impl/bind.hpp>
#include <skelgen/applications/impl/bone_orientations.hpp>
#include <skelgen/applications/impl/bone_sections.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/bounded_stretch.hpp>
#include <skelgen/applications/impl/curve_skin.hpp>
#include <skelgen/applications/impl/deep_shoulders.hpp>
#include <skelgen/applications/impl/floor.hpp>
#include <skelgen/applications/impl/heat_weights.hpp>
#include <skelgen/applications/impl/kept_volumes.hpp>
#include <skelgen/applications/impl/limb_regions.hpp>
#include <skelgen/applications/impl/limb_volume.hpp>
#include <skelgen/applications/impl/loose_pieces.hpp>
#include <skelgen/applications/impl/outward_faces.hpp>
#include <skelgen/applications/impl/pose_transfer.hpp>
#include <skelgen/applications/impl/posing.hpp>
#include <skelgen/applications/impl/rest_posture.hpp>
#include <skelgen/applications/impl/resting_surface.hpp>
#include <skelgen/applications/impl/rig.hpp>
#include <skelgen/applications/impl/skinning.hpp>

namespace skelgen::applications {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template std::vector<Bone<Scalar>> bones_of(const KinematicSkeleton<Scalar>&, const SkeletonTemplate&);            \
    template Vector3<Scalar> bone_end(const KinematicSkeleton<Scalar>&, const SkeletonTemplate&, int);                 \
    template std::vector<BoneSection<Scalar>> bone_sections(const Body<Scalar>&, const KinematicSkeleton<Scalar>&,     \
                                                            const SkeletonTemplate&, int);                             \
    template Skin<Scalar> curve_skin(const CurveSkeleton<Scalar>&, const Skin<Scalar>&, int);                          \
    template KinematicSkeleton<Scalar> rest_skeleton(const SkeletonTemplate&);                                         \
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
    template Heat heat_in(const Body<Scalar>&, const std::vector<Bone<Scalar>>&, int, const LimbRegions&);             \
    template Points<Scalar> at_rest(const RestingSurface<Scalar>&, const JointWeights&, const std::vector<int>&);      \
    template Points<Scalar> at_rest(const RestingSurface<Scalar>&, const JointWeights&);                               \
    template JointWeights with_bounded_stretch(JointWeights, const RestingSurface<Scalar>&, const Triangles&,          \
                                               const SkeletonTemplate&, const std::vector<int>&);                      \
    template JointWeights with_loose_pieces(JointWeights, const TriangleMesh<Scalar>&, const Body<Scalar>&,            \
                                            const std::vector<Scalar>&, const KinematicSkeleton<Scalar>&,              \
                                            const SkeletonTemplate&);                                                  \
    template JointWeights with_deep_shoulders(JointWeights, const Points<Scalar>&, const KinematicSkeleton<Scalar>&,   \
                                              const SkeletonTemplate&);                                                \
    template core::Accumulator largest_bend_change(const JointWeights&, const RestingSurface<Scalar>&,                 \
                                                   const Triangles&, const SkeletonTemplate&);                         \
    template JointWeights with_balanced_bends(JointWeights, const RestingSurface<Scalar>&, const Triangles&,           \
                                              const SkeletonTemplate&, core::Accumulator);                             \
    template JointWeights with_kept_volumes(JointWeights, const RestingSurface<Scalar>&, const Triangles&,             \
                                            const SkeletonTemplate&,                                                   \
                                            const std::function<JointWeights(JointWeights)>&);                         \
    template LimbRegions limb_regions(const Body<Scalar>&, const KinematicSkeleton<Scalar>&, const SkeletonTemplate&); \
    template std::vector<SurfacePlace<Scalar>> places_on(const Body<Scalar>&, const TriangleMesh<Scalar>&);            \
    template Skin<Scalar> bind(const TriangleMesh<Scalar>&, const Body<Scalar>&, const KinematicSkeleton<Scalar>&,     \
                               const SkeletonTemplate&, StartOfBends<Scalar>);                                         \
    template Triangles outward_faces(const TriangleMesh<Scalar>&, const Body<Scalar>&);                                \
    template Scalar height_by_bones(const KinematicSkeleton<Scalar>&, const SkeletonTemplate&);                        \
    template Rig<Scalar> make_rig(const TriangleMesh<Scalar>&, const Body<Scalar>&, const KinematicSkeleton<Scalar>&,  \
                                  const SkeletonTemplate&, const RigOptions&);                                         \
    template Orientations<Scalar> posture(const KinematicSkeleton<Scalar>&, const SkeletonTemplate&,                   \
                                          const Eigen::Quaternion<Scalar>&);                                           \
    template std::vector<RigidMotion<Scalar>> posture_motions(RestPose, const KinematicSkeleton<Scalar>&,              \
                                                              const SkeletonTemplate&, const Orientations<Scalar>&,    \
                                                              const Eigen::Quaternion<Scalar>&);                       \
    template std::optional<Eigen::Quaternion<Scalar>> along_axes(const Eigen::Quaternion<Scalar>&);                    \
    template Eigen::Quaternion<Scalar> about_vertical(const Eigen::Quaternion<Scalar>&);                               \
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
