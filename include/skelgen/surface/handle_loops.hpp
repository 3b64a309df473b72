#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// An edge between two faces; its weight is its length, or less of it in a crease: a fifth where the faces meet at a
/// right angle and sharper, all of it where they lie in one plane or the edge is a ridge.
template <typename Scalar = double>
struct CreaseEdge {
    std::array<int, 2> vertices, faces;
    Scalar weight;
};

/// A surface's edges, weighed by the creases in which they lie.
template <typename Scalar = double>
struct CreaseGraph {
    std::vector<CreaseEdge<Scalar>> edges;
    core::SurfaceGraph<Scalar> graph; ///< the vertices, as far from each other as the edges weigh
    std::vector<Scalar> factors;      ///< per vertex the least part of its length that an edge there counts
    std::size_t faces = 0;
};

/// `mesh` must be closed and manifold, `adjacency` as from core::face_adjacency. O(n).
template <typename Scalar>
[[nodiscard]] CreaseGraph<Scalar> crease_graph(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency);

/// A closed path along edges of a surface that does not part it: around a handle, or through one.
template <typename Scalar = double>
struct HandleLoop {
    std::vector<int> vertices; ///< in order, each once
    Scalar length = 0;         ///< the sum of its edges' weights
};

/// Two loops for each handle of a closed connected surface, which together span all of its loops: of those through
/// `root` a shortest such set (EW05), without the ways from there that they go forth and back. Where limbs have grown
/// together the shortest loops run along the seam. By length; of those that are longer than `longest` with the ways
/// back and forth, none. O(n log n + genus n), within `longest` O(n + k log k) for the k vertices not half as far.
template <typename Scalar>
[[nodiscard]] std::vector<HandleLoop<Scalar>>
handle_loops(const CreaseGraph<Scalar>& surface, int root,
             std::type_identity_t<Scalar> longest = std::numeric_limits<Scalar>::infinity());

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/handle_loops.hpp>
#endif
