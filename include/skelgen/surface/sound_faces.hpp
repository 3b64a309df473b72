#pragma once

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// Is a mesh one piece, each edge of which two faces share that run along it in opposite senses, with the inside behind
/// them? Vertices where fans of faces touch are allowed. O(n).
template <typename Scalar>
[[nodiscard]] bool is_sound(const TriangleMesh<Scalar>& mesh);

/// Faces without those that bound nothing, and how many of each kind went.
struct SoundFaces {
    Triangles faces;    ///< those that stay, in their order
    int degenerate = 0; ///< repeated a vertex
    int duplicate = 0;  ///< had the same three vertices as an earlier one
    int spikes = 0;     ///< reached far away with a corner of theirs alone, from an edge that is short beside that way
    int fins = 0;       ///< stuck out of the surface: patches up to a hundredth of its area with a free edge, joined to
                        ///< it where two other faces meet
    int walls = 0;      ///< inside: patches that start where two other faces meet and that no ray from outside reaches
};

/// The faces of a welded mesh that can bound a body. Patches end where more than two faces share an edge. Of a surface
/// without such edges nothing but degenerate and duplicate faces goes, and of one without free edges no spikes. O(n log
/// n).
template <typename Scalar>
[[nodiscard]] SoundFaces sound_faces(const TriangleMesh<Scalar>& mesh);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/sound_faces.hpp>
#endif
