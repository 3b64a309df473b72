#pragma once

#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/curve/find_curve.hpp>
#include <skelgen/embedding/spectral_matching.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::embedding {

/// A body whose surface has been cut where it touched itself, and the curve that was then found in it.
template <typename Scalar = double>
struct PartedBody {
    Body<Scalar> body;                ///< vertices along the cuts are there twice, and new ones close the holes
    curve::CurveResult<Scalar> curve; ///< a tree
};

/// Most places in which a body may touch itself: head, trunk, arms and legs, each two of them once. Torn surfaces have
/// dozens of loops.
inline constexpr int most_contacts = 15;

/// Parts a body where it touches itself: the loops of its `curve` are opened where the template then fits best (see
/// find_loop_cuts), the surface is cut there, and the curve is found again, until it has no loops. `curve` is connected
/// and its regions index the body's vertices. \returns a body for each way of find_loop_cuts, best first; not those
/// where a cut opens no loop or takes off a limb; none when `curve` has no loop or more than `most_contacts`, or when
/// no way to cut it lets the template in. Each round takes as long as find_curve, and there is at most one for each
/// loop and way. \throws Error usage when an option is out of its range.
template <typename Scalar>
[[nodiscard]] std::vector<PartedBody<Scalar>>
part_contacts(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& skeleton_template,
              const MatchingOptions& matching = {}, const curve::CurveOptions& curve_options = {});

} // namespace skelgen::embedding

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/embedding/impl/part_contacts.hpp>
#endif
