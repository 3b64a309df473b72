#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::embedding {

/// A graph without its nodes of degree 2: what a curve skeleton and a template have in common (LF20 section 3.1).
template <typename Scalar = double>
struct ReducedGraph {
    std::vector<int> origin;    ///< per node, its index in the curve skeleton or the template
    std::vector<int> degree;    ///< number of branches at each node
    std::vector<Scalar> radius; ///< of each end the limb's thickness there, 0 where unknown, same unit as the distances
    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>
        distances; ///< geodesic distances between the nodes along the full graph, largest scaled to 1
};

/// Reduced graph of a curve skeleton; distances are not finite where it is in several pieces. O(k^2 log k).
template <typename Scalar>
[[nodiscard]] ReducedGraph<Scalar> reduce(const CurveSkeleton<Scalar>& curve);

/// Reduced graph of a template in its rest pose; leaves count to their tips where the template gives them.
/// O(joints^2 log joints).
template <typename Scalar>
[[nodiscard]] ReducedGraph<Scalar> reduce(const SkeletonTemplate& skeleton_template);

/// Length of the longest path along the template's bones, from tip to tip, in the template's unit.
/// O(joints^2 log joints).
[[nodiscard]] double longest_path(const SkeletonTemplate& skeleton_template);

namespace detail {

/// Nodes and joints are counted in int; this is their place in a vector.
[[nodiscard]] inline std::size_t at(int index) { return static_cast<std::size_t>(index); }

} // namespace detail
} // namespace skelgen::embedding

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/embedding/impl/reduced_graph.hpp>
#endif
