// What is read off one body, compiled once, for float and double.

#include <skelgen/applications/impl/alignment.hpp>
#include <skelgen/applications/impl/body_coordinates.hpp>
#include <skelgen/applications/impl/measurement.hpp>
#include <skelgen/applications/impl/own_part.hpp>
#include <skelgen/applications/impl/part_axes.hpp>
#include <skelgen/applications/impl/segmentation.hpp>

namespace skelgen::applications {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template std::vector<int> standing_for(const Body<Scalar>&, const Points<Scalar>&);                                \
    template std::vector<int> vertices_of_input(const Body<Scalar>&, const TriangleMesh<Scalar>&);                     \
    template const SkeletonTemplate& own_template(const KinematicSkeleton<Scalar>&);                                   \
    template Vector3<Scalar> joint_place(const KinematicSkeleton<Scalar>&, JointRole, Side);                           \
    template Vector3<Scalar> joint_place(const KinematicSkeleton<Scalar>&, const std::string&);                        \
    template Vector3<Scalar> end_place(const KinematicSkeleton<Scalar>&, const std::string&, const std::string&);      \
    template std::vector<PartAxis<Scalar>> part_axes(const KinematicSkeleton<Scalar>&);                                \
    template Scalar distance_to_axis(const Vector3<Scalar>&, const PartAxis<Scalar>&);                                 \
    template PelvisDirections<Scalar> pelvis_directions(const KinematicSkeleton<Scalar>&);                             \
    template PelvisDirections<Scalar> pelvis_directions(const Body<Scalar>&, const KinematicSkeleton<Scalar>&);        \
    template Eigen::Matrix<Scalar, 4, 4> alignment(const KinematicSkeleton<Scalar>&, const Points<Scalar>&,            \
                                                   const AlignmentOptions&);                                           \
    template Eigen::Matrix<Scalar, 4, 4> alignment(const Body<Scalar>&, const KinematicSkeleton<Scalar>&,              \
                                                   const Points<Scalar>&, const AlignmentOptions&);                    \
    template Points<Scalar> transformed(const Points<Scalar>&, const Eigen::Matrix<Scalar, 4, 4>&);                    \
    template Segmentation segment(const Body<Scalar>&, const KinematicSkeleton<Scalar>&, PartSet,                      \
                                  const SegmentationOptions&);                                                         \
    template Segmentation to_input(const Segmentation&, const Body<Scalar>&, const TriangleMesh<Scalar>&);             \
    template OwnBody<Scalar> own_body(TriangleMesh<Scalar>, Body<Scalar>);                                             \
    template double standing_height(const Body<Scalar>&, const KinematicSkeleton<Scalar>&);                            \
    template Scalar tape_length(const std::vector<Vector3<Scalar>>&, const Vector3<Scalar>&);                          \
    template Measurements measure(const Body<Scalar>&, const KinematicSkeleton<Scalar>&, const Segmentation&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::applications
