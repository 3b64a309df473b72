#pragma once

#include <vector>

#include <Eigen/Core>

#include <skelgen/embedding/reduced_graph.hpp>

namespace skelgen {

/// Weights of the affinities (LF20 section 3.1).
struct MatchingOptions {
    double degree_weight = 5.0;   ///< of exp(-difference of degrees)
    double distance_weight = 5.0; ///< of exp(-difference of geodesic distances / distance_scale) (LF20: 1)
    double distance_scale = 0.1;  ///< LF20: 1, at which lengths, all below 1, hardly tell a head from a hand
    double radius_cost =
        5.0; ///< of a limb's thickness, relative to distances, in descend(): heads are thick, hands thin
    double degree_cost = 0.1; ///< of one branch too many or too few, as a difference of distances, in descend()
};

/// Affinities of all pairs (curve node i, template node j), index i * n + j: (m n) x (m n), symmetric, non-negative.
/// Two pairs that share a node exclude each other: their entry is zero (LH05).
[[nodiscard]] Eigen::MatrixXd affinity_matrix(const ReducedGraph& curve, const ReducedGraph& skeleton_template,
                                              const MatchingOptions& options = {});

/// Per template node the index of its partner among the m candidates, -1 where none is left. The leading eigenvector of
/// `affinities` by Spectra, made discrete greedily (LH05): largest entry first, conflicts discarded. `affinities` is
/// (m n) x (m n), symmetric and non-negative. O((m n)^2). \throws Error internal when no eigenvector is found.
[[nodiscard]] std::vector<int> spectral_assignment(const Eigen::MatrixXd& affinities, int template_nodes);

/// Sum of the squared differences of distances, degrees and thicknesses between the template's nodes and their
/// partners. `partner` without -1.
[[nodiscard]] double distortion(const ReducedGraph& curve, const ReducedGraph& skeleton_template,
                                const std::vector<int>& partner, const MatchingOptions& options = {});

/// Repairs what the relaxation's greedy rounding gets wrong where a limb is folded: as long as it lowers the sum of the
/// squared differences of distances (and degrees), two template nodes exchange partners, or one takes a free curve
/// node. `partner` as from spectral_assignment, without -1. O(n^4) per step, few steps.
[[nodiscard]] std::vector<int> descend(const ReducedGraph& curve, const ReducedGraph& skeleton_template,
                                       std::vector<int> partner, const MatchingOptions& options = {});

/// The least distorted of all assignments, by branch and bound from `partner`: exchanges one at a time do not lead out
/// of a body matched upside down, as one with a raised leg may be. Junctions are tried first, and no more than some
/// million partial assignments are, which a body's curve never needs. O(m^n) at worst, milliseconds in practice.
[[nodiscard]] std::vector<int> least_distorted(const ReducedGraph& curve, const ReducedGraph& skeleton_template,
                                               std::vector<int> partner, const MatchingOptions& options = {});

} // namespace skelgen
