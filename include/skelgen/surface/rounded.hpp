#pragma once

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// A mesh in four times as many faces, rounder than they are: each edge is halved where the curve lies that starts and
/// ends at right angles to its vertices' normals (VPBM01). The vertices stay, with the new ones after them; flat parts
/// stay flat. Any unit. O(n log n).
template <typename Scalar>
[[nodiscard]] TriangleMesh<Scalar> rounded(const TriangleMesh<Scalar>& mesh);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/rounded.hpp>
#endif
