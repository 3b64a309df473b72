#pragma once

#include <string>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// The faces of a mesh that may belong to one body, and what was left out of it.
struct BodyFaces {
    Triangles faces;                ///< in their order
    Triangles all_things;           ///< those of all that stands apart from it, too; empty where nothing does
    int bodies = 1;                 ///< how many things of a body's size there are; the faces are the largest one's
    int dropped_pieces = 0;         ///< that stand apart, or are no more than plates
    bool stood_on_plate = false;    ///< a plate that was grown to the body is left out, and what had sunk into it
    std::vector<std::string> notes; ///< on plates, one sentence each
};

/// Leaves out what is no body, or another one. A plate is a piece that is far flatter than a body and no small part of
/// it, or, grown to the body, two flat sides close to each other below everything else. Pieces whose boxes do not meet
/// even when grown by a fiftieth of the size stand apart; so do two large ones of which no vertex is in or near the
/// other. Of a mesh that is one piece without flat sides all faces stay. `component`: the body to keep, from 1 for the
/// largest. `is_one_piece`: it is known to be. O(n log n + pieces^2).
template <typename Scalar>
[[nodiscard]] BodyFaces faces_of_body(const TriangleMesh<Scalar>& mesh, int component = 1, bool is_one_piece = false);

/// A mesh without the vertices that no face uses, and where the others were.
template <typename Scalar = double>
struct UsedPart {
    TriangleMesh<Scalar> mesh;
    std::vector<int> source;
};
template <typename Scalar>
[[nodiscard]] UsedPart<Scalar> used_part(const TriangleMesh<Scalar>& mesh);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/pieces.hpp>
#endif
