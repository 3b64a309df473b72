#pragma once

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// A mesh whose faces look outwards.
template <typename Scalar = double>
struct OrientedMesh {
    TriangleMesh<Scalar> mesh; ///< faces in their order and, but for turned ones, as they were
    int turned = 0;            ///< faces turned round
};

/// Turns faces until neighbours along edges of two faces agree, as few as possible by area, and then each piece
/// outwards: a closed one by its volume, an open one by the side that more rays see (TPS14). A piece that has no two
/// sides (a Moebius band) is left with a line where neighbours disagree. O(n log n).
template <typename Scalar>
[[nodiscard]] OrientedMesh<Scalar> orient(TriangleMesh<Scalar> mesh);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/orientation.hpp>
#endif
