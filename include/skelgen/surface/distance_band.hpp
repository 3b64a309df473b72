#pragma once

#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/lattice.hpp>

namespace skelgen::surface {

/// A lattice around a mesh with `margin` cells to spare on each side.
template <typename Scalar>
[[nodiscard]] Lattice<Scalar> lattice_around(const TriangleMesh<Scalar>& mesh, Scalar cell, int margin);

/// Distances to the nearest face at the lattice's nodes up to `reach` from one; infinity at the others. O(area of the
/// faces in cells, but at least one for each face, times the nodes within reach).
template <typename Scalar>
[[nodiscard]] SparseGrid<Scalar> distance_band(const TriangleMesh<Scalar>& mesh, const Lattice<Scalar>& lattice,
                                               Scalar reach);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/distance_band.hpp>
#endif
