#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::io {

/// The axis of what is put together from tubes, in the coordinates of its mesh: the curve that is to be found in it.
struct AxisTruth {
    Points<double> nodes;                  ///< n x 3, connected, closer together than the tubes are thick
    std::vector<std::array<int, 2>> edges; ///< pairs of node indices, first < second, each edge once
    std::vector<double> radii;             ///< n: of the ball inside; over a tube's cap, of the last whole ball
};

/// Nodes with one edge. O(n + edges).
[[nodiscard]] int end_count(const AxisTruth& truth);

/// Independent cycles. O(1).
[[nodiscard]] int cycle_count(const AxisTruth& truth);

/// Reads `axis` of a truth file (JSON): {"nodes": [[x, y, z], ...], "edges": [[a, b], ...], "radii": [r, ...]}. Keys it
/// does not know are ignored.
/// \throws Error bad_input when it cannot be read, misses something, or the nodes are not connected.
[[nodiscard]] AxisTruth read_axis_truth(const std::filesystem::path& path);

} // namespace skelgen::io
