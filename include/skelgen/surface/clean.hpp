#pragma once

#include <string>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// What is left of a mesh when all is put right that can be without moving a vertex, and the way back.
template <typename Scalar = double>
struct CleanMesh {
    TriangleMesh<Scalar> mesh;
    std::vector<int> placed;        ///< per vertex of the input its index here, -1 where it is left out; empty where
                                    ///< the vertices are the input's
    std::vector<std::string> notes; ///< what was done and how much, one sentence each
    bool is_sound = false;          ///< it was one closed piece that looks outwards from the beginning
};

/// Puts a mesh's connectivity right: vertices at equal places welded (then those nearer than a millionth of the size),
/// degenerate and duplicate faces, fins and inner walls left out, faces turned outwards. Pieces that are closed by
/// themselves are welded to others only where all become one closed surface. A mesh that needs none of it comes back as
/// it is. O(n log n). \throws Error bad_input when fewer than four faces are left.
template <typename Scalar>
[[nodiscard]] CleanMesh<Scalar> clean(const TriangleMesh<Scalar>& mesh);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/clean.hpp>
#endif
