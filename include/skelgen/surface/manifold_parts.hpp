#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// A mesh made edge- and vertex-manifold, and where its vertices come from.
template <typename Scalar = double>
struct ManifoldParts {
    TriangleMesh<Scalar> mesh;
    std::vector<int> source; ///< per vertex, the vertex of the original mesh at the same place
    int dropped_pieces = 0;  ///< connected pieces smaller than the largest one, left out
};

/// Cuts a triangle soup into manifold pieces, the one with the largest area first. Two faces stay joined along an edge
/// only when they alone share it and run through it in opposite senses; a vertex where several fans of faces touch
/// (every SCAPE body has one) becomes one vertex per fan; faces that repeat a vertex are left out. `least_area`: pieces
/// with a smaller part of the largest one's area are left out. Nothing counts as dropped. O(n log n).
template <typename Scalar>
[[nodiscard]] std::vector<ManifoldParts<Scalar>> manifold_parts(const TriangleMesh<Scalar>& mesh,
                                                                double least_area = 0);

/// The one with the largest area alone, and how many there are besides. O(n log n).
template <typename Scalar>
[[nodiscard]] ManifoldParts<Scalar> largest_manifold_part(const TriangleMesh<Scalar>& mesh);

/// The same of a mesh that `is_sound` (sound_faces.hpp), for less. O(n).
template <typename Scalar>
[[nodiscard]] ManifoldParts<Scalar> manifold_part_of_sound(const TriangleMesh<Scalar>& mesh);

/// Two meshes as one of both, not connected. O(n).
template <typename Scalar>
[[nodiscard]] TriangleMesh<Scalar> side_by_side(const TriangleMesh<Scalar>& one, const TriangleMesh<Scalar>& other);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/manifold_parts.hpp>
#endif
