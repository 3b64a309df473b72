#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// For each vertex the label of which there is most after random walks of that length (`part_shares`), with short
/// borders (`with_short_borders`). `labels`: one for each vertex of the body, of those that `mirrored` has an entry
/// for: the label on the other side, or itself; `length` in the body's unit. \throws Error as `part_shares`. O(n^1.5 +
/// n labels).
template <typename Scalar>
[[nodiscard]] std::vector<int> smoothed_labels(const Body<Scalar>& body, const std::vector<int>& labels,
                                               const std::vector<int>& mirrored, double length);

/// Labels, as above, with each in one piece: of several pieces the one with the most vertices stays, the others, the
/// smallest first, take the label of most of what borders on them. O(pieces (n + count)).
template <typename Scalar>
[[nodiscard]] std::vector<int> in_one_piece(const Body<Scalar>& body, const std::vector<int>& labels, int count);

/// Of each face the label of most of its corners, of three different ones that of the first. O(faces).
[[nodiscard]] std::vector<int> face_labels(const Triangles& faces, const std::vector<int>& vertex_labels);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/surface_labels.hpp>
#endif
