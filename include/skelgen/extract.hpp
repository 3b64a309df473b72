#pragma once

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/denoise.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/curve/extract_curve.hpp>
#include <skelgen/curve/proxy.hpp>
#include <skelgen/embedding/spectral_matching.hpp>
#include <skelgen/refinement/refine.hpp>
#include <skelgen/symmetry/sides.hpp>

namespace skelgen {

/// Wall-clock milliseconds of each stage.
struct StageTimings {
    double curve = 0;
    double embed = 0;
    double refine = 0;
    double sides = 0;
    double total = 0;
};

/// Everything `extract_skeleton` finds out on its way.
template <typename Scalar = double>
struct Extraction {
    KinematicSkeleton<Scalar> skeleton;
    CurveSkeleton<Scalar> curve;  ///< pruned, in the input's coordinates; regions index the input's vertices
    double geodesic_diameter = 0; ///< largest geodesic distance on the mesh, estimated, in the input's unit
    StageTimings timings;
};

/// What `extract_skeleton` looks for and how; the defaults of each stage are documented with it.
struct ExtractOptions {
    SkeletonTemplate skeleton_template; ///< empty: the built-in `human21`
    int threads = 1;                    ///< the result does not depend on it
    DenoiseOptions denoise;
    ProxyOptions proxy;
    CurveOptions curve;
    MatchingOptions matching;
    RefinementOptions refinement;
    SidesOptions sides;
};

/// Finds the kinematic skeleton of one human body: any pose, orientation and unit. Computes in double precision
/// whatever the scalar. Floating pieces, holes and noise are survived; the largest piece is used, and cut where it
/// touches itself. \throws Error bad_input when `mesh` is no usable surface, no_skeleton when no body can be found in
/// it.
template <typename Scalar>
[[nodiscard]] Extraction<Scalar> extract_skeleton(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options = {});

/// The curve skeleton alone, of a body or anything else: the first half of `extract_skeleton`, in the input's
/// coordinates. The regions hold every vertex of the largest piece exactly once. Of `options`, `denoise`, `proxy` and
/// `curve` count. \throws Error bad_input when `mesh` is no usable surface.
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> find_curve_skeleton(const TriangleMesh<Scalar>& mesh,
                                                        const ExtractOptions& options = {});

} // namespace skelgen
