#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// A closed path along edges of a surface that does not part it: around a handle, or through one.
template <typename Scalar = double>
struct HandleLoop {
    std::vector<int> vertices; ///< in order, each once
    Scalar length = 0;         ///< as handle_loops weighs it
};

/// Per vertex the least part of its length that an edge there counts: a fifth in a crease of a right angle and sharper,
/// all of it where no edge lies in a crease. `mesh` must be manifold, `adjacency` as from core::face_adjacency. O(n).
template <typename Scalar>
[[nodiscard]] std::vector<Scalar> crease_factors(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency);

/// Two loops for each handle of a closed connected surface, which together span all of its loops: of those through
/// `root` a shortest such set (EW05), without the ways from there that they go forth and back. Edges in creases count
/// less (crease_factors): where limbs have grown together the shortest loops run along the seam.
/// `mesh` must be manifold, `adjacency` as from core::face_adjacency. By length. O(n log n + genus n).
template <typename Scalar>
[[nodiscard]] std::vector<HandleLoop<Scalar>> handle_loops(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency,
                                                           int root);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/handle_loops.hpp>
#endif
