#pragma once

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/extract.hpp>

#include "body_curve.hpp"

namespace skelgen::detail {

/// The second half of the pipeline: the template laid into the curve, and the joints that follow from it.
struct SkeletonFit {
    KinematicSkeleton<double> skeleton;
    double geodesic_diameter = 0;
    int misplaced = 0; ///< joints whose bones have unlikely lengths
};

/// Fits the skeleton to the curve of `found`. Where that fails or looks wrong, a limb has been lost or a junction
/// shifted on the way to the curve: finer proxies are tried, and `found.curve` becomes the one that serves best. Adds
/// to `timings`. \throws Error no_skeleton when none does, or the shape is no body's.
[[nodiscard]] SkeletonFit fit_skeleton(BodyCurve& found, const SkeletonTemplate& wanted, const ExtractOptions& options,
                                       StageTimings& timings);

/// \throws Error no_skeleton when the template can be laid into the curve, but what is left over goes on as far as an
/// arm: another body's. Cutting where they touch would hide that.
void refuse_company(const CurveSkeleton<double>& curve, const SkeletonTemplate& wanted, const MatchingOptions& options);

} // namespace skelgen::detail
