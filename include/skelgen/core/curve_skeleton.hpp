#pragma once

#include <array>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// A curve skeleton: a graph embedded in space. Every node knows the surface that contracted to it.
template <typename Scalar = double>
struct CurveSkeleton {
    Points<Scalar> nodes;                  ///< k x 3 positions
    std::vector<std::array<int, 2>> edges; ///< pairs of node indices, first < second, each edge once
    std::vector<std::vector<int>> regions; ///< k lists of mesh vertices; together each vertex exactly once
    std::vector<Scalar> radii;             ///< k mean distances from a node to its region; of a tip, its neighbour's
};

} // namespace skelgen
