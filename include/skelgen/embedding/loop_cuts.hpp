#pragma once

#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/spectral_matching.hpp>

namespace skelgen::embedding {

/// Where a loop of a curve skeleton is to be opened: the surface of one list of curve nodes from that of the other.
struct LoopCut {
    std::vector<int> limb;  ///< along a branch of the loop, from the cut on, no farther than halfway to its other end
    std::vector<int> other; ///< what is not nearer to that other end
};

/// How often a body touches itself: the independent cycles of its curve but for short ones from a junction back to
/// itself, as of a finger on a hip, which no limb makes. O(k^2).
template <typename Scalar>
[[nodiscard]] int contact_count(const CurveSkeleton<Scalar>& curve);

/// Where all loops of a curve are to be opened: as many cuts as it has contacts.
using LoopCuts = std::vector<LoopCut>;

/// Where the loops of a body that touches itself are to be opened, so that the template fits what remains best: a loop
/// is cut in the middle of one of its branches (hands clasped), or where a branch comes out of what it touches (a hand
/// on a thigh). Beam search over the cuts of one loop after the other by the distortion of the embedding, which takes
/// some hundred embeddings a loop at most. \returns the best way to cut the connected curve and those that the
/// distortion alone does not tell from it, three in all at most, best first; none when it has no contacts
/// (`contact_count`) or more than six (a scan's tunnels are no contacts), or when no set of cuts lets the template in,
/// in its own proportions or other ones, with less than twice the distortion of what fits well: what comes of such cuts
/// is no body.
/// \throws Error usage when an option is out of its range.
template <typename Scalar>
[[nodiscard]] std::vector<LoopCuts> find_loop_cuts(const CurveSkeleton<Scalar>& curve,
                                                   const SkeletonTemplate& skeleton_template,
                                                   const MatchingOptions& options = {});

} // namespace skelgen::embedding

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/embedding/impl/loop_cuts.hpp>
#endif
