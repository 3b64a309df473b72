#pragma once

#include <functional>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/lattice.hpp>

namespace skelgen::surface {

/// What a surface on a lattice is the border of.
template <typename Scalar = double>
struct LatticeShape {
    /// Positive inside, otherwise outside; asked once for each node that matters. What lies at the lattice's border
    /// counts as outside.
    std::function<Scalar(const LatticeNode&)> depth;
    /// Where the surface passes between two neighbours, one inside and one outside, with their depths: from 0 at the
    /// former to 1 at the latter.
    std::function<Scalar(const LatticeNode&, const LatticeNode&, Scalar, Scalar)> crossing;
};

/// The border of a shape, from the `seeds` on as far as it goes: one vertex in each cell that it passes (Gib98), at the
/// mean of its crossings there, two faces for each crossing. Where cells touch in an edge or a corner alone, nodes go
/// over to the outside until none do (well-composed: Lat97), so that the surface is closed and manifold; it looks
/// outwards. Deterministic. O(nodes near the surface).
template <typename Scalar>
[[nodiscard]] TriangleMesh<Scalar> lattice_surface(const Lattice<Scalar>& lattice,
                                                   const std::vector<LatticeNode>& seeds,
                                                   const LatticeShape<Scalar>& shape);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/lattice_surface.hpp>
#endif
