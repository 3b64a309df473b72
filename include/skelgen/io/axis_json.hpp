#pragma once

#include <filesystem>

#include <skelgen/core/curve_skeleton.hpp>

namespace skelgen::io {

/// Reads the axis of what is put together from tubes, in the coordinates of its mesh: the curve that is to be found in
/// it. It is `axis` of a truth file (JSON): {"nodes": [[x, y, z], ...], "edges": [[a, b], ...], "radii": [r, ...]};
/// keys that are not known are ignored. \returns nodes, connected; edges, in ascending order; radii, above zero, of the
/// ball inside, over a tube's cap of the last whole ball; no regions. \throws Error bad_input when it cannot be read,
/// misses something, or the nodes are not connected.
[[nodiscard]] CurveSkeleton<double> read_axis_truth(const std::filesystem::path& path);

} // namespace skelgen::io
