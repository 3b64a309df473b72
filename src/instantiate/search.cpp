// The search compiled for one scalar.

#include <skelgen/search/impl/evidence.hpp>
#include <skelgen/search/impl/extract_options.hpp>
#include <skelgen/search/impl/hypothesis.hpp>
#include <skelgen/search/impl/ladder.hpp>
#include <skelgen/search/impl/line.hpp>
#include <skelgen/search/impl/posed_fit.hpp>
#include <skelgen/search/impl/rest_fit.hpp>
#include <skelgen/search/impl/trust.hpp>

namespace skelgen::search {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template Evidence evidence_of(const Body<Scalar>&, const CurveSkeleton<Scalar>&, const embedding::Embedding*,      \
                                  const anatomy::CompletedSkeleton<Scalar>&, const SkeletonTemplate&, Scalar);         \
    template KinematicSkeleton<Scalar> with_confidence(KinematicSkeleton<Scalar>, double, const std::vector<double>&); \
    template Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>&, const curve::CurveResult<Scalar>&,            \
                                                    const embedding::LaidTemplate&, const ExtractOptions&);            \
    template Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>&, const curve::CurveResult<Scalar>&,            \
                                                    const SkeletonTemplate&, const ExtractOptions&);                   \
    template std::vector<MirrorPlane> mirror_planes(const Body<Scalar>&);                                              \
    template std::optional<RestFit<Scalar>> fit_at_rest(const Body<Scalar>&, const SkeletonTemplate&,                  \
                                                        const std::vector<KnownPlace>&);                               \
    template std::vector<Points<double>> standing_starts(const Body<Scalar>&, const SkeletonTemplate&);                \
    template std::vector<PosedFit> fit_posed(const Body<Scalar>&, const SkeletonTemplate&,                             \
                                             const std::vector<Points<double>>&, const std::vector<KnownPlace>&);      \
    template Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>&, const curve::CurveResult<Scalar>&,            \
                                                    const PlacedJoints<Scalar>&);                                      \
    template PlacedJoints<Scalar> place_joints(                                                                        \
        const Body<Scalar>&, const curve::CurveResult<Scalar>&, const embedding::LaidTemplate&,                        \
        const std::vector<refinement::EndPoint<Scalar>>&, const ExtractOptions&);                                      \
    template PlacedJoints<Scalar> place_joints(const Body<Scalar>&, const RestFit<Scalar>&, const ExtractOptions&);    \
    template PlacedJoints<Scalar> place_joints(const Body<Scalar>&, const PosedFit&, Scalar);                          \
    template KinematicSkeleton<Scalar> skeleton_in_input(const Found<Scalar>&);                                        \
    template std::vector<std::string> warnings_of(const Found<Scalar>&, const SkeletonTemplate&);                      \
    template Climb<Scalar> climb(const TriangleMesh<Scalar>&, const SkeletonTemplate&, const ExtractOptions&,          \
                                 Thoroughness, std::vector<KnownPlace>);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::search
