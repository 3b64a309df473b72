#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/face_tree.hpp>

namespace skelgen::surface {

/// What rays from some faces of a mesh meet: how many there were, and which part of them left from the front (where the
/// normal points) or the back and met nothing.
struct Visibility {
    int rays = 0; ///< from each side
    double front = 0, back = 0;
};

/// Looks out from up to `samples` of the given faces, spread evenly over the list: rays along the normal and slanted
/// around it, from both sides. `tree` as of the mesh. O(samples log faces).
template <typename Scalar>
[[nodiscard]] Visibility look_out(const TriangleMesh<Scalar>& mesh, const FaceTree<Scalar>& tree,
                                  const std::vector<int>& faces, int samples);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/visibility.hpp>
#endif
