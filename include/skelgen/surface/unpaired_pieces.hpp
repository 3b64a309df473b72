#pragma once

#include <optional>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// What is left of a mesh of pieces without the lone ones, and how much that leaves out.
struct PairedPieces {
    Triangles faces;     ///< in their order
    int dropped = 0;     ///< pieces
    double left_out = 0; ///< of the area
};

/// Leaves out the pieces that have no twin and lie beside the body's middle: swords, shields, bags, a plume. Limbs come
/// in twins, of as many faces and of about the same area, wherever the two are: bodies may be in any pose. Head, trunk,
/// hair and skirts lie in the middle. That is the plane which mirrors pieces onto their twins, or goes through pieces,
/// with the largest area of such pieces together. \returns what is left; nothing where no two pieces are alike, less
/// than 0.5 % of the area is left out, or more than half. O(n log n + k^4) for the k <= 40 largest pieces.
template <typename Scalar>
[[nodiscard]] std::optional<PairedPieces> without_lone_pieces(const TriangleMesh<Scalar>& mesh);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/unpaired_pieces.hpp>
#endif
