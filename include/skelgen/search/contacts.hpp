#pragma once

#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/spectral_matching.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::search {

/// Most places in which a body may touch itself: head, trunk, arms and legs, each two of them once. Torn surfaces have
/// dozens of loops.
inline constexpr int most_contacts = 15;

/// A body cut where it touches itself: at the loops of its `curve`, where the template then fits best (see
/// embedding::find_loop_cuts). `curve` is connected and its regions index the body's vertices. Vertices along the cuts
/// are there twice, and new ones close the holes. \returns a body for each way to cut, best first; not those where a
/// cut takes off a limb; none when `curve` has no loop or more than `most_contacts`, or when no way to cut it lets the
/// template in. As find_loop_cuts, and O(n log n) for each way. \throws Error usage when an option is out of its range.
template <typename Scalar>
[[nodiscard]] std::vector<Body<Scalar>> cut_at_contacts(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                                                        const SkeletonTemplate& skeleton_template,
                                                        const embedding::MatchingOptions& matching = {});

} // namespace skelgen::search

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/search/impl/contacts.hpp>
#endif
