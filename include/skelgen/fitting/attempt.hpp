#pragma once

#include <string>

#include <skelgen/core/outcome.hpp>
#include <skelgen/core/stage_timings.hpp>
#include <skelgen/curve/find_curve.hpp>
#include <skelgen/fitting/extract_options.hpp>
#include <skelgen/fitting/fitted_body.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::fitting {

/// A skeleton in the body's coordinates, and how good it is.
template <typename Scalar>
struct Candidate {
    KinematicSkeleton<Scalar> skeleton;
    curve::CurveResult<Scalar> curve;
    Scalar geodesic_diameter = 0;
    int misplaced = 0; ///< joints whose bones have unlikely lengths
};

/// One attempt, with one curve.
template <typename Scalar>
struct Attempt {
    Outcome<Candidate<Scalar>> outcome;
    StageTimings timings;
};

/// So many misplaced joints make a skeleton doubtful.
inline constexpr int suspicious = 3;

/// What a body lacks that lacks the limb which ends in such a joint.
[[nodiscard]] std::string part_name(JointRole end);

/// What LF20's Fig. 1 shows from the embedding on, with one curve: the template laid into it, joints placed, sides told
/// apart, the skeleton completed. What cannot be a body's is refused on the way (shape_gates.hpp).
template <typename Scalar>
[[nodiscard]] Attempt<Scalar> fit_to_curve(const Body<Scalar>& body, const curve::CurveResult<Scalar>& found,
                                           const SkeletonTemplate& given, const ExtractOptions& options);

/// The result in the input's coordinates, or why there is none.
template <typename Scalar>
[[nodiscard]] Outcome<Fit<Scalar>> to_fit(const Body<Scalar>& body, Attempt<Scalar> attempt,
                                          const ExtractOptions& options);

} // namespace skelgen::fitting

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/fitting/impl/attempt.hpp>
#endif
