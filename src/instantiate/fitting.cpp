// The fitting compiled once, for float and double.

#include <skelgen/fitting/impl/attempt.hpp>
#include <skelgen/fitting/impl/best_surface.hpp>
#include <skelgen/fitting/impl/extract_options.hpp>
#include <skelgen/fitting/impl/finer_curves.hpp>
#include <skelgen/fitting/impl/fit.hpp>
#include <skelgen/fitting/impl/held_things.hpp>
#include <skelgen/fitting/impl/partial_body.hpp>
#include <skelgen/fitting/impl/shape_gates.hpp>
#include <skelgen/fitting/impl/touching_body.hpp>

namespace skelgen::fitting {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template std::optional<Failure> not_slender(Scalar, double);                                                       \
    template std::optional<Failure> too_compact(const Body<Scalar>&);                                                  \
    template bool is_folded_body(const CurveSkeleton<Scalar>&, const embedding::Embedding&, Scalar);                   \
    template std::optional<Failure> not_single(const CurveSkeleton<Scalar>&, const embedding::Embedding&);             \
    template std::optional<Failure> not_all_matched(Scalar);                                                           \
    template std::optional<Failure> not_apart(const KinematicSkeleton<Scalar>&, const SkeletonTemplate&);              \
    template Attempt<Scalar> fit_to_curve(const Body<Scalar>&, const curve::CurveResult<Scalar>&,                      \
                                          const SkeletonTemplate&, const ExtractOptions&);                             \
    template Outcome<Fit<Scalar>> to_fit(const Body<Scalar>&, Attempt<Scalar>, const ExtractOptions&);                 \
    template Attempt<Scalar> fit_to_finer_curves(const Body<Scalar>&, const curve::CurveResult<Scalar>&,               \
                                                 const SkeletonTemplate&, const ExtractOptions&, int);                 \
    template Outcome<Fit<Scalar>> fit_touching_body(const Body<Scalar>&, const curve::CurveResult<Scalar>&,            \
                                                    const SkeletonTemplate&, const ExtractOptions&, int);              \
    template std::vector<Body<Scalar>> without_held_things(const Body<Scalar>&, const CurveSkeleton<Scalar>&,          \
                                                           const SkeletonTemplate&,                                    \
                                                           const embedding::MatchingOptions&);                         \
    template Outcome<Fit<Scalar>> fit(const Body<Scalar>&, const curve::CurveResult<Scalar>&, const SkeletonTemplate&, \
                                      const ExtractOptions&, int);                                                     \
    template Outcome<Fit<Scalar>> fit_partial(const Body<Scalar>&, const SkeletonTemplate&, const ExtractOptions&);    \
    template Outcome<FittedBody<Scalar>> fit_to_best_surface(const TriangleMesh<Scalar>&, const SkeletonTemplate&,     \
                                                             const ExtractOptions&);

SKELGEN_INSTANTIATE(float)
SKELGEN_INSTANTIATE(double)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::fitting
