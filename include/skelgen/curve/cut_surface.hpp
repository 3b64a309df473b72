#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// A surface cut in places, and where its vertices come from.
struct CutSurface {
    TriangleMesh<double> mesh;
    std::vector<int> source; ///< per vertex that of the original mesh at the same place, -1 for those that close a hole
};

/// Separates two parts of a surface, each a list of vertices, along the border of the first where they meet: its
/// vertices there become two each, and the two holes are closed by fans around new vertices. The old vertices come
/// first and keep their places. Holes that were there before stay. O(n log n).
[[nodiscard]] CutSurface cut_surface(const TriangleMesh<double>& mesh, const std::vector<int>& part,
                                     const std::vector<int>& other);

} // namespace skelgen
