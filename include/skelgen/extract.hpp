#pragma once

#include <utility>
#include <vector>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/stage_timings.hpp>
#include <skelgen/curve/find_curve.hpp>
#include <skelgen/search/extract_options.hpp>
#include <skelgen/search/ladder.hpp>
#include <skelgen/search/line.hpp>
#include <skelgen/search/trail.hpp>
#include <skelgen/surface/prepare.hpp>

namespace skelgen {

using curve::find_curve;
using search::Candidate;
using search::ExtractOptions;
using search::skeleton_of;
using search::Trail;
using search::validate;
using surface::prepare;

/// What `extract` finds in a mesh, and what everything else is built on. In the mesh's coordinates and indices but for
/// `body`.
template <typename Scalar = double>
struct Extraction {
    TriangleMesh<Scalar> mesh;   ///< as given
    Body<Scalar> body;           ///< the closed surface that stands for it, not cut where it touches itself
    CurveSkeleton<Scalar> curve; ///< that the skeleton was found in; empty unless `ExtractOptions::with_curve`
    KinematicSkeleton<Scalar> skeleton;
    SkeletonTemplate skeleton_template; ///< whose joints the skeleton has
    Trail trail;                        ///< what was tried, in order
    Scalar geodesic_diameter = 0;       ///< largest geodesic distance on the body, estimated, in the mesh's unit
    StageTimings timings;               ///< of all that was tried
};

/// Thrown where no skeleton is found: `code()` is no_skeleton, `refusal()` says why.
class NoSkeleton : public Error {
public:
    NoSkeleton(const Failure& failure, Trail trail)
        : Error(ErrorCode::no_skeleton, failure.what, failure.reason), trail_(std::move(trail)) {}

    /// What was tried, in order.
    [[nodiscard]] const Trail& trail() const noexcept { return trail_; }

private:
    Trail trail_;
};

namespace detail {

/// A search with the candidate that was chosen and its skeleton, in the input's coordinates. The mesh, and the time in
/// all, are the caller's to add; the candidate's warnings go behind the skeleton's.
template <typename Scalar>
[[nodiscard]] Extraction<Scalar> extraction_of(search::Climb<Scalar> climb, const search::Found<Scalar>& found,
                                               KinematicSkeleton<Scalar> skeleton, SkeletonTemplate skeleton_template,
                                               const ExtractOptions& options);

} // namespace detail

/// Finds the kinematic skeleton of one human body: any pose, orientation and unit. Surface, curve, template, joints,
/// sides: `search::climb` tries these stages with what may be true of the mesh until a skeleton is sure enough, and the
/// likeliest is taken. The skeleton of a mesh that mirrors itself vertex by vertex does so, too
/// (`symmetry::mirrored_evenly`). Pass `mesh` by std::move to spare a copy.
/// \throws Error usage when an option is out of its range, bad_input when `mesh` is no usable surface; NoSkeleton when
/// no body can be found in it.
template <typename Scalar>
[[nodiscard]] Extraction<Scalar> extract(TriangleMesh<Scalar> mesh, const ExtractOptions& options = {});

/// As `extract`, but the mesh stays the caller's: the result's is empty.
template <typename Scalar>
[[nodiscard]] Extraction<Scalar> extract_in(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options = {});

/// `extract` by another name.
template <typename Scalar>
[[nodiscard]] Extraction<Scalar> extract_skeleton(TriangleMesh<Scalar> mesh, const ExtractOptions& options = {}) {
    return extract(std::move(mesh), options);
}

/// The curve skeletons alone, of bodies or anything else, in the input's coordinates; regions index the input's
/// vertices. There is one for each connected piece of the surface that has a thousandth of the largest one's area or
/// more, the largest first. Nodes are spaced relative to the bounding box of all. Of `options`, `prepare` and `curve`
/// count. \returns one result or more. \throws Error usage when an option is out of its range, bad_input when `mesh` is
/// no usable surface or all of its pieces have fewer than four faces.
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
