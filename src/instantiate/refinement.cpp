// The refinement's templates, compiled once for float and double.

#include <skelgen/refinement/impl/bend.hpp>
#include <skelgen/refinement/impl/bone_line.hpp>
#include <skelgen/refinement/impl/centreline.hpp>
#include <skelgen/refinement/impl/cross_section.hpp>
#include <skelgen/refinement/impl/end_points.hpp>
#include <skelgen/refinement/impl/fork.hpp>
#include <skelgen/refinement/impl/head.hpp>
#include <skelgen/refinement/impl/limb_joints.hpp>
#include <skelgen/refinement/impl/limbs.hpp>
#include <skelgen/refinement/impl/pelvis.hpp>
#include <skelgen/refinement/impl/placement.hpp>
#include <skelgen/refinement/impl/profile_matcher.hpp>
#include <skelgen/refinement/impl/refine.hpp>
#include <skelgen/refinement/impl/thickness_profile.hpp>
#include <skelgen/refinement/impl/trunk_axis.hpp>
#include <skelgen/refinement/impl/trunk_joints.hpp>

namespace skelgen::refinement {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template class Slicer<Scalar>;                                                                                     \
    template std::optional<Vector3<Scalar>> level_set_centre(const surface::LevelSets<Scalar>&, Scalar,                \
                                                             const Vector3<Scalar>&, Scalar);                          \
    template Scalar gauss_map_flatness(const CrossSection<Scalar>&);                                                   \
    template Vector3<Scalar> widest_direction(const CrossSection<Scalar>&);                                            \
    template Scalar egg_shape(const CrossSection<Scalar>&, const Vector3<Scalar>&);                                    \
    template Centreline<Scalar> draw_centreline(const Slicer<Scalar>&, const Points<Scalar>&,                          \
                                                const CentrelineOptions&);                                             \
    template std::vector<EndPoint<Scalar>> find_end_points(const Body<Scalar>&, const CurveSkeleton<Scalar>&,          \
                                                           const embedding::Embedding&, const SkeletonTemplate&);      \
    template Scalar geodesic_diameter(const std::vector<EndPoint<Scalar>>&);                                           \
    template std::optional<Vector3<Scalar>> fork_between(const TriangleMesh<Scalar>&, const EndPoint<Scalar>&,         \
                                                         const EndPoint<Scalar>&);                                     \
    template std::vector<Crossing<Scalar>> crossings_between(const TriangleMesh<Scalar>&, const EndPoint<Scalar>&,     \
                                                             const EndPoint<Scalar>&, Scalar, Scalar);                 \
    template Vector3<Scalar> fork_along(const std::vector<Crossing<Scalar>>&, const Vector3<Scalar>&,                  \
                                        const Vector3<Scalar>&);                                                       \
    template Scalar template_scale(const SkeletonTemplate&, Scalar);                                                   \
    template Limb<Scalar> shorten_line(Limb<Scalar>);                                                                  \
    template Points<Scalar> ring_centres(const Slicer<Scalar>&, const EndPoint<Scalar>&, Scalar, Scalar);              \
    template Limb<Scalar> draw_limb(Limb<Scalar>, const Slicer<Scalar>&, const EndPoint<Scalar>&,                      \
                                    const CentrelineOptions&);                                                         \
    template std::vector<Limb<Scalar>> trace_limbs(const Slicer<Scalar>&, const std::vector<EndPoint<Scalar>>&,        \
                                                   const SkeletonTemplate&, Scalar, const CentrelineOptions&);         \
    template std::optional<Line<Scalar>> fit_bone(const Centreline<Scalar>&, Scalar, Scalar, const BoneLineOptions&);  \
    template std::optional<Line<Scalar>> fit_first_bone(const Limb<Scalar>&, const BoneLineOptions&);                  \
    template std::optional<Vector3<Scalar>> meeting_point(const Line<Scalar>&, const Line<Scalar>&);                   \
    template std::optional<BonesAtBend<Scalar>> bones_at_bend(const Limb<Scalar>&, Scalar, Scalar, Scalar,             \
                                                              const BendOptions&, const BoneLineOptions&);             \
    template Fold<Scalar> find_fold(const Limb<Scalar>&, const Stretch<Scalar>&, const BendOptions&,                   \
                                    const BoneLineOptions&);                                                           \
    template std::optional<HeadShape<Scalar>> measure_head(const Slicer<Scalar>&, const Vector3<Scalar>&,              \
                                                           const Vector3<Scalar>&, const HeadOptions&);                \
    template std::optional<Scalar> value_at(const Profile&, Scalar);                                                   \
    template ProfileFit<Scalar> fit_profile(const std::vector<Sample<Scalar>>&, const Profile&,                        \
                                            const Stretch<Scalar>&, Scalar);                                           \
    template Scalar deviation_of(const Top<Scalar>&, Scalar, const Stretch<Scalar>&);                                  \
    template std::vector<Stretch<Scalar>> best_stretches(const std::vector<MatchedLimb<Scalar>>&, const Profile&,      \
                                                         const ThicknessProfileOptions&);                              \
    template ThicknessMatch<Scalar> match_thickness_profiles(std::vector<Limb<Scalar>>, const SkeletonTemplate&,       \
                                                             const ThicknessProfileOptions&, const BendOptions&,       \
                                                             const BoneLineOptions&);                                  \
    template Scalar least_cost(const MatchedLimb<Scalar>&, const Profile&, const ThicknessProfileOptions&);            \
    template std::vector<Limb<Scalar>> shorten_cut_limbs(                                                              \
        std::vector<Limb<Scalar>>, const Slicer<Scalar>&, const std::vector<EndPoint<Scalar>>&,                        \
        const SkeletonTemplate&, const ThicknessProfileOptions&, const CentrelineOptions&);                            \
    template class Placement<Scalar>;                                                                                  \
    template Placement<Scalar> place_by_ratio(Placement<Scalar>, const Limb<Scalar>&);                                 \
    template Placement<Scalar> place_neck(Placement<Scalar>, const Limb<Scalar>&, const HeadShape<Scalar>&,            \
                                          const NeckOptions&);                                                         \
    template Placement<Scalar> place_wrist(Placement<Scalar>, const Limb<Scalar>&, const WristOptions&);               \
    template Placement<Scalar> place_bend(Placement<Scalar>, const Limb<Scalar>&, const BendOptions&,                  \
                                          const BoneLineOptions&);                                                     \
    template Placement<Scalar> place_girdle(Placement<Scalar>, const Limb<Scalar>&, const GirdleOptions&,              \
                                            const BoneLineOptions&);                                                   \
    template Placement<Scalar> place_shoulder_by_height(Placement<Scalar>, const Limb<Scalar>&, const GirdleOptions&); \
    template Placement<Scalar> place_shoulder_by_trunk(Placement<Scalar>, const Limb<Scalar>&, const Vector3<Scalar>&, \
                                                       const BendOptions&, const BoneLineOptions&);                    \
    template Placement<Scalar> narrow_hips(Placement<Scalar>, const std::vector<Limb<Scalar>>&);                       \
    template std::optional<TrunkAxis<Scalar>> find_trunk_axis(const Slicer<Scalar>&, const Points<Scalar>&, Scalar);   \
    template std::optional<Placement<Scalar>> place_pelvis(Placement<Scalar>, const std::vector<Limb<Scalar>>&,        \
                                                           const TrunkAxis<Scalar>&, const PelvisOptions&);            \
    template Placement<Scalar> place_trunk(Placement<Scalar>, const std::vector<Limb<Scalar>>&, const Slicer<Scalar>&, \
                                           const Vector3<Scalar>&, const std::optional<TrunkAxis<Scalar>>&,            \
                                           const TrunkOptions&);                                                       \
    template Placement<Scalar> raise_crotch(Placement<Scalar>, const std::vector<Limb<Scalar>>&,                       \
                                            const TriangleMesh<Scalar>&, const CrotchOptions&);                        \
    template RefinedJoints<Scalar> refine(const Body<Scalar>&, const std::vector<EndPoint<Scalar>>&,                   \
                                          const CurveSkeleton<Scalar>&, const embedding::Embedding&,                   \
                                          const SkeletonTemplate&, const RefinementOptions&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::refinement
