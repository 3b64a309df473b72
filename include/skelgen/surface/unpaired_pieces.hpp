#pragma once

#include <optional>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// Which pieces pass for a limb's, as there is one like them elsewhere.
enum class Twins {
    alike,   ///< of as many faces and of about the same area, wherever the two are: bodies in any pose
    mirrored ///< and on either side of one plane: what both hands hold stays, what is found twice by chance does not
};

/// What is left of a mesh of pieces without the lone ones, and how much that leaves out.
struct PairedPieces {
    Triangles faces;     ///< in their order
    int dropped = 0;     ///< pieces
    double left_out = 0; ///< of the area
};

/// Leaves out the pieces that have no twin and lie beside the body's middle: swords, shields, bags, a plume. Limbs come
/// in twins; head, trunk, hair and skirts lie in the middle, that is the plane which mirrors most of the area of pieces
/// that have a twin, or passes through their centres. \returns none where no two pieces are alike, where nothing is
/// left out that would count, or more than half. O(n log n + k^4) for the k <= 40 largest pieces.
template <typename Scalar>
[[nodiscard]] std::optional<PairedPieces> without_lone_pieces(const TriangleMesh<Scalar>& mesh, Twins twins);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/unpaired_pieces.hpp>
#endif
