// The curve stage, compiled once for each scalar.

#include <skelgen/curve/impl/branch_centring.hpp>
#include <skelgen/curve/impl/branch_sections.hpp>
#include <skelgen/curve/impl/branched_curve.hpp>
#include <skelgen/curve/impl/contraction.hpp>
#include <skelgen/curve/impl/find_curve.hpp>
#include <skelgen/curve/impl/laplacian.hpp>
#include <skelgen/curve/impl/leaf_extension.hpp>
#include <skelgen/curve/impl/medial_balls.hpp>
#include <skelgen/curve/impl/proxy.hpp>
#include <skelgen/curve/impl/pruning.hpp>
#include <skelgen/curve/impl/surgery.hpp>

namespace skelgen::curve {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template Proxy<Scalar> build_proxy(const TriangleMesh<Scalar>&, const ProxyOptions&);                              \
    template const Eigen::SparseMatrix<core::Accumulator>& CotangentLaplacian::of(const Points<Scalar>&, double);      \
    template Eigen::SparseMatrix<core::Accumulator> cotangent_laplacian(const Points<Scalar>&, const Triangles&,       \
                                                                        double);                                       \
    template MedialBalls<Scalar> medial_balls(const TriangleMesh<Scalar>&, Scalar);                                    \
    template MedialBalls<Scalar> contraction_balls(const TriangleMesh<Scalar>&, const ContractionOptions&);            \
    template Contraction<Scalar> contract(const TriangleMesh<Scalar>&, const MedialBalls<Scalar>&,                     \
                                          const ContractionOptions&);                                                  \
    template Contraction<Scalar> contract(const TriangleMesh<Scalar>&, const ContractionOptions&);                     \
    template SplitCurve<Scalar> split_branches(const CurveSkeleton<Scalar>&);                                          \
    template BranchedCurve<Scalar> resampled(BranchedCurve<Scalar>, Scalar);                                           \
    template Branch<Scalar> turned(Branch<Scalar>);                                                                    \
    template BranchedCurve<Scalar> without_knot(BranchedCurve<Scalar>, int);                                           \
    template JoinedCurve<Scalar> join_branches(const BranchedCurve<Scalar>&);                                          \
    template BranchSection<Scalar> section_across(const Body<Scalar>&, const Points<Scalar>&, Eigen::Index, Scalar);   \
    template BranchedCurve<Scalar> prune_twigs(BranchedCurve<Scalar>, const Body<Scalar>&, double);                    \
    template CentredBranches<Scalar> centre_branches(BranchedCurve<Scalar>, const Body<Scalar>&,                       \
                                                     const BranchCentringOptions&);                                    \
    template BranchedCurve<Scalar> centre_roughly(BranchedCurve<Scalar>, const Body<Scalar>&,                          \
                                                  const BranchCentringOptions&);                                       \
    template CurveSkeleton<Scalar> connectivity_surgery(const Points<Scalar>&, const Triangles&,                       \
                                                        const SurgeryOptions&);                                        \
    template CurveSkeleton<Scalar> extend_leaves(const CurveSkeleton<Scalar>&, const Body<Scalar>&,                    \
                                                 const LeafExtensionOptions&);                                         \
    template CurveSkeleton<Scalar> prune(const CurveSkeleton<Scalar>&, const PruningOptions&);                         \
    template CurveResult<Scalar> find_curve(const Body<Scalar>&, const CurveOptions&);                                 \
    template CurveResult<Scalar> finished(CurveResult<Scalar>, const Body<Scalar>&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::curve
