#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen {

/// A graph without its nodes of degree 2: what a curve skeleton and a template have in common (LF20 section 3.1).
struct ReducedGraph {
    std::vector<int> origin;    ///< per node, its index in the curve skeleton or the template
    std::vector<int> degree;    ///< number of branches at each node
    std::vector<double> radius; ///< of each end the limb's thickness there, 0 where unknown, same unit as the distances
    Eigen::MatrixXd distances;  ///< geodesic distances between the nodes along the full graph, largest scaled to 1
};

/// Reduced graph of a curve skeleton. O(k^2 log k).
[[nodiscard]] ReducedGraph reduce(const CurveSkeleton<double>& curve);

/// Reduced graph of a template in its rest pose; leaves count to their tips where the template gives them.
[[nodiscard]] ReducedGraph reduce(const SkeletonTemplate& skeleton_template);

/// Length of the longest path along the template's bones, from tip to tip.
[[nodiscard]] double longest_path(const SkeletonTemplate& skeleton_template);

} // namespace skelgen
