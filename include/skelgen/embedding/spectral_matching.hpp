#pragma once

#include <vector>

#include <Eigen/Core>

#include <skelgen/core/header_only.hpp>
#include <skelgen/embedding/reduced_graph.hpp>

namespace skelgen::embedding {

/// Weights of the affinities (LF20 section 3.1) and of the distortion.
struct MatchingOptions {
    double degree_weight = 5.0;   ///< of exp(-difference of degrees) (LF20)
    double distance_weight = 5.0; ///< of exp(-difference of geodesic distances / distance_scale) (LF20: 1)
    double distance_scale = 0.1;  ///< LF20: 1, at which lengths, all below 1, hardly tell a head from a hand
    double radius_cost = 5.0; ///< of a limb's thickness, relative to distances: heads are thick, hands thin; chosen so
                              ///< that the 6 cm between them weigh as much as 30 cm along the body, a forearm
    double degree_cost = 0.1; ///< of one branch too many or too few, as a difference of distances; chosen: as
                              ///< much as a head's length, since arms often leave the spine at two junctions
    double end_cost = 0.3;    ///< of an end for a junction or a junction for an end: as much as an arm's length, so
                              ///< that proportions have to be very odd for a limb that is there to be none
};

/// \throws Error usage when a weight, scale or cost is out of its range.
void validate(const MatchingOptions& options);

/// Affinities of all pairs (curve node i, template node j), index i * n + j: (m n) x (m n), symmetric, non-negative.
/// Two pairs that share a node exclude each other: their entry is zero (LH05). O((m n)^2).
template <typename Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>
affinity_matrix(const ReducedGraph<Scalar>& curve, const ReducedGraph<Scalar>& skeleton_template,
                const MatchingOptions& options = {});

/// Per template node the index of its partner among the m candidates, -1 where none is left. The leading eigenvector of
/// `affinities`, made discrete greedily (LH05): largest entry first, conflicts discarded. `affinities` is
/// (m n) x (m n), symmetric and non-negative. O((m n)^2) per iteration; where the eigenvector is not found after a
/// number of them that falls with the size, what is known of it is taken.
template <typename Scalar>
[[nodiscard]] std::vector<int>
spectral_assignment(const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& affinities, int template_nodes);

/// Sum of the squared differences of distances, degrees and thicknesses between the template's nodes and their
/// partners: no unit, since distances are relative to the largest. `partner` without -1. O(n^2).
template <typename Scalar>
[[nodiscard]] Scalar distortion(const ReducedGraph<Scalar>& curve, const ReducedGraph<Scalar>& skeleton_template,
                                const std::vector<int>& partner, const MatchingOptions& options = {});

/// Repairs what the relaxation's greedy rounding gets wrong where a limb is folded: as long as it lowers the
/// distortion, two template nodes exchange partners, or one takes a free curve node. `partner` as from
/// spectral_assignment, without -1. O(n^4) per step, few steps.
template <typename Scalar>
[[nodiscard]] std::vector<int> descend(const ReducedGraph<Scalar>& curve, const ReducedGraph<Scalar>& skeleton_template,
                                       std::vector<int> partner, const MatchingOptions& options = {});

/// What a search among assignments has found.
struct Assignment {
    std::vector<int> partner; ///< per template node
    bool is_least = true;     ///< false: the search was ended before all others were excluded
};

/// The least distorted of all assignments, by branch and bound from `partner`: exchanges one at a time do not lead out
/// of a body matched upside down, as one with a raised leg may be. Junctions are tried first. O(m^n) at worst, so no
/// more partners are tried than a number that grows with m, and which a body's curve does not need by far:
/// milliseconds in practice, tenths of a second at most.
template <typename Scalar>
[[nodiscard]] Assignment least_distorted(const ReducedGraph<Scalar>& curve,
                                         const ReducedGraph<Scalar>& skeleton_template, std::vector<int> partner,
                                         const MatchingOptions& options = {});

} // namespace skelgen::embedding

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/embedding/impl/spectral_matching.hpp>
#endif
