#pragma once

#include <string>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/similarity.hpp>

namespace skelgen::surface {

/// What is left of a mesh when all is put right that can be without moving a vertex, and the way back.
template <typename Scalar = double>
struct CleanMesh {
    TriangleMesh<Scalar> mesh;
    std::vector<int> placed;        ///< per vertex of the input its index here, -1 where it is left out; empty where
                                    ///< the vertices are the input's
    std::vector<std::string> notes; ///< what was done and how much, one sentence each
    bool is_sound = false;          ///< it was one closed piece that looks outwards from the beginning
    Similarity<Scalar> similarity = {}; ///< from the input's coordinates to the mesh's
};

/// Puts a mesh's connectivity right: vertices at equal places welded (then those nearer than a millionth of the size),
/// degenerate and duplicate faces, fins and inner walls left out, faces turned outwards. Pieces that are closed by
/// themselves are welded to others only where all become one closed surface. A mesh that needs none of it comes back as
/// it is. O(n log n). \throws Error bad_input when fewer than four faces are left.
template <typename Scalar>
[[nodiscard]] CleanMesh<Scalar> clean(const TriangleMesh<Scalar>& mesh);

/// The same, but a mesh that needs any of it is brought into its own axes first (canonical_places), all places rounded
/// to less than a millionth of the size: which rays meet an edge and which boxes meet then does not depend on how the
/// input was turned. A mesh that needs nothing stays where it is.
template <typename Scalar>
[[nodiscard]] CleanMesh<Scalar> clean_in_own_axes(const TriangleMesh<Scalar>& mesh);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/clean.hpp>
#endif
