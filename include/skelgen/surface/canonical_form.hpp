#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/similarity.hpp>

namespace skelgen::surface {

/// A mesh in the one position, size and order in which the pipeline works.
template <typename Scalar = double>
struct CanonicalMesh {
    TriangleMesh<Scalar> mesh;     ///< unit area, centred, principal axes along x, y, z
    Similarity<Scalar> similarity; ///< from the input's coordinates
    std::vector<int> input_vertex; ///< per canonical vertex its index in the input
};

/// A mesh's vertices in the one position and size in which the pipeline works.
template <typename Scalar = double>
struct CanonicalPlaces {
    Points<Scalar> vertices;       ///< in the input's order
    Similarity<Scalar> similarity; ///< from the input's coordinates
};

/// The places of a mesh's vertices in canonical form. O(n). \throws Error bad_input when the surface has no area.
template <typename Scalar>
[[nodiscard]] CanonicalPlaces<Scalar> canonical_places(const TriangleMesh<Scalar>& mesh);

/// Brings a mesh into canonical form: moved to its centroid, turned to its principal axes, scaled to unit area,
/// vertices and faces in geometric order. A body turned, moved, scaled or with its vertices and faces shuffled has the
/// same canonical form up to rounding, which is what makes every later step indifferent to all of that. O(n log n).
/// \throws Error bad_input when the surface has no area.
template <typename Scalar>
[[nodiscard]] CanonicalMesh<Scalar> canonical_form(const TriangleMesh<Scalar>& mesh);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/canonical_form.hpp>
#endif
