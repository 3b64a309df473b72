#pragma once

#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/outcome.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/spectral_matching.hpp>

namespace skelgen::embedding {

/// A piece of the template between two joints of its reduced graph, and the curve that it lies on.
struct Chain {
    std::vector<int> joints; ///< template joints along it, both ends included
    std::vector<int> nodes;  ///< curve nodes along it, from the partner of the first joint to that of the last
};

/// The template laid into a curve skeleton.
struct Embedding {
    std::vector<int> node_of_joint; ///< per template joint its curve node, -1 for joints of degree 2
    std::vector<Chain> chains;      ///< every bone of the template belongs to exactly one
    int matched_nodes = 0;
    double distortion = 0; ///< of distances, degrees and thicknesses, see distortion()
    bool is_least = true;  ///< no other is less distorted; false: the search was ended early
};

/// Most ends and junctions of a curve that a template is looked for in: a body with all its fingers, toes, hair and
/// folds has fewer than half as many, a torn surface hundreds.
inline constexpr int most_reduced_nodes = 100;

/// Embeds the template in a pruned curve skeleton (LF20 section 3.1): reduced graphs, spectral matching, merging of
/// unmatched junctions into the matched neighbour with the most branches. Which of two like limbs is the left one is
/// not known yet. O(k^2 log k) for k nodes of the curve; the matching is cheap beside that. \returns failure
/// too_few_ends when the curve has too few ends and junctions for the reduced template or is in several pieces,
/// too_many_ends when it has more than `most_reduced_nodes`. \throws Error usage when an option is out of its range.
template <typename Scalar>
[[nodiscard]] Outcome<Embedding> embed(const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& skeleton_template,
                                       const MatchingOptions& options = {});

/// How far the curve goes on beyond the chains, as a part of their total length: a person's arm is a sixth of it, and
/// what fingers, hair and clothes add is less. O(k log k).
template <typename Scalar>
[[nodiscard]] Scalar unmatched_reach(const CurveSkeleton<Scalar>& curve, const Embedding& embedding);

/// The longest way along the curve between two ends of the chains. O(k log k).
template <typename Scalar>
[[nodiscard]] Scalar matched_diameter(const CurveSkeleton<Scalar>& curve, const Embedding& embedding);

} // namespace skelgen::embedding

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/embedding/impl/embed.hpp>
#endif
