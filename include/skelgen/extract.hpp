#pragma once

#include <vector>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/outcome.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/core/stage_timings.hpp>
#include <skelgen/curve/find_curve.hpp>
#include <skelgen/embedding/spectral_matching.hpp>
#include <skelgen/refinement/refine.hpp>
#include <skelgen/surface/prepare.hpp>
#include <skelgen/symmetry/sides.hpp>

namespace skelgen {

using curve::find_curve;
using surface::prepare;

/// What `extract_skeleton` looks for and how; the defaults of each stage are documented with it.
struct ExtractOptions {
    SkeletonTemplate skeleton_template; ///< empty: the built-in `human21`
    surface::PrepareOptions prepare;
    curve::CurveOptions curve;
    embedding::MatchingOptions matching;
    refinement::RefinementOptions refinement;
    symmetry::SidesOptions sides;
};

/// \throws Error usage when an option is out of its range, bad_input when the template breaks a rule
/// (core/template_rules.hpp).
void validate(const ExtractOptions& options);

/// A template fitted to a body, in the input's coordinates and indices.
template <typename Scalar = double>
struct Fit {
    KinematicSkeleton<Scalar> skeleton;
    CurveSkeleton<Scalar> curve;  ///< that the skeleton was fitted to: the given one, or one that serves better
    Scalar geodesic_diameter = 0; ///< largest geodesic distance on the body, estimated, in the input's unit
    StageTimings timings;         ///< of `curve`: what it took to look for curves that serve better
};

/// Fits a template to a body and its curve skeleton (LF20): lays it into the curve, places the joints by
/// cross-sections and anatomy, tells the sides, completes the skeleton. Where that fails or looks wrong, a limb has
/// been lost or a junction shifted on the way to the curve: curves of finer proxies are tried. Where the curve has
/// loops the body touches itself: its surface is cut there and the curve found again. Another template on the same body
/// and curve takes another call. `options.prepare` and `options.skeleton_template` do not count. \returns the failure
/// where no such skeleton is in the body. \throws Error usage when an option is out of its range, bad_input when the
/// template breaks a rule.
template <typename Scalar>
[[nodiscard]] Outcome<Fit<Scalar>> fit(const Body<Scalar>& body, const curve::CurveResult<Scalar>& curve,
                                       const SkeletonTemplate& skeleton_template, const ExtractOptions& options = {});

/// Everything `extract_skeleton` finds out on its way: `Fit`, with the times of all stages.
template <typename Scalar = double>
using Extraction = Fit<Scalar>;

/// Finds the kinematic skeleton of one human body: any pose, orientation and unit: `prepare`, `find_curve`, `fit`.
/// Floating pieces, holes and noise are survived; the largest piece is used, and cut where it touches itself.
/// \throws Error usage when an option is out of its range, bad_input when `mesh` is no usable surface, no_skeleton when
/// no body can be found in it.
template <typename Scalar>
[[nodiscard]] Extraction<Scalar> extract_skeleton(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options = {});

/// What the applications stand on: a skeleton, and the surface in which it was found.
template <typename Scalar = double>
struct FittedBody {
    Extraction<Scalar> extraction; ///< in the input's coordinates
    Body<Scalar> body;             ///< one closed surface, not cut where it touches itself
};

/// As `extract_skeleton`, which drops the surface.
template <typename Scalar>
[[nodiscard]] FittedBody<Scalar> extract_body(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options = {});

/// The curve skeletons alone, of bodies or anything else: one for each connected piece of the surface that has a
/// thousandth of the largest one's area or more, the largest first, in the input's coordinates; regions index the
/// input's vertices. Nodes are spaced relative to the bounding box of all. Of `options`, `prepare` and `curve` count.
/// \returns one result or more. \throws Error usage when an option is out of its range, bad_input when `mesh` is no
/// usable surface or all of its pieces have fewer than four faces.
template <typename Scalar>
[[nodiscard]] std::vector<curve::CurveResult<Scalar>> find_curves(const TriangleMesh<Scalar>& mesh,
                                                                  const ExtractOptions& options = {});

/// The curve skeleton of the largest piece alone: `prepare` and `find_curve`, in the input's coordinates. The
/// regions hold every vertex of the largest piece exactly once. Of `options`, `prepare` and `curve` count.
/// \throws Error usage when an option is out of its range, bad_input when `mesh` is no usable surface.
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> find_curve_skeleton(const TriangleMesh<Scalar>& mesh,
                                                        const ExtractOptions& options = {});

} // namespace skelgen

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/impl/extract.hpp>
#endif
