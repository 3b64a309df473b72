#pragma once

#include <vector>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/curve/find_curve.hpp>
#include <skelgen/fitting/extract_options.hpp>
#include <skelgen/fitting/fit.hpp>
#include <skelgen/fitting/fitted_body.hpp>
#include <skelgen/surface/prepare.hpp>

namespace skelgen {

using curve::find_curve;
using fitting::ExtractOptions;
using fitting::Fit;
using fitting::fit;
using fitting::FittedBody;
using fitting::for_first_try;
using fitting::validate;
using surface::prepare;

/// Everything `extract_skeleton` finds out on its way: `Fit`, with the times of all stages.
template <typename Scalar = double>
using Extraction = Fit<Scalar>;

/// Finds the kinematic skeleton of one human body: any pose, orientation and unit: `prepare`, `find_curve`, `fit`.
/// Floating pieces, holes and noise are survived; the largest piece is used, and cut where it touches itself.
/// \throws Error usage when an option is out of its range, bad_input when `mesh` is no usable surface, no_skeleton when
/// no body can be found in it.
template <typename Scalar>
[[nodiscard]] Extraction<Scalar> extract_skeleton(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options = {});

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
