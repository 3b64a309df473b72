#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::synth {

/// The largest geodesic distance on a connected mesh, taken along its edges as the reference data does (some percent
/// above the distance over the faces): the farthest vertex from each of `starts`, then the farthest from the best of
/// those. O(starts * vertices log vertices).
[[nodiscard]] double geodesic_diameter(const TriangleMesh<double>& mesh, const std::vector<int>& starts);

} // namespace skelgen::synth
