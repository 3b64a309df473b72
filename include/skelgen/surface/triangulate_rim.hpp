#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// The rim of a hole in a manifold surface.
struct Rim {
    std::vector<int> vertices; ///< in the order in which faces that close the hole have to run
    std::vector<int> faces;    ///< the surface's face at the edge from each vertex to the next
};

/// The triangles (indices into the rim's vertices) that close a hole with no new vertex and bend as little as possible
/// at any edge, those to the faces around the hole included, and of these the ones with the least area (Lie03; BS95):
/// across a tube's open side, and not through it. `is_edge(i, j)` says whether two of the rim's vertices that are no
/// neighbours on it have an edge already, which no triangle may then use. Any unit. \returns nothing where no such
/// triangles exist. \throws Error usage when the rim has not one face for each vertex. O(n^3), in memory O(n^2).
template <typename Scalar>
[[nodiscard]] std::optional<std::vector<std::array<int, 3>>>
triangulate_rim(const TriangleMesh<Scalar>& mesh, const Rim& rim, const std::function<bool(int, int)>& is_edge);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/triangulate_rim.hpp>
#endif
