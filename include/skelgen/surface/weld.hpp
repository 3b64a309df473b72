#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// A mesh whose vertices are at different places, and where those of the original went.
template <typename Scalar = double>
struct WeldedMesh {
    TriangleMesh<Scalar> mesh;
    std::vector<int> placed; ///< per vertex of the original its index here, -1 where no face uses it
    int welded = 0;          ///< vertices that went into others
    int unused = 0;          ///< vertices that no face uses, left out
};

/// The box that holds the middle nine tenths of the faces' corners along each axis, which a few strays far away do not
/// change. Any unit; a mesh without faces has an empty one. O(faces).
template <typename Scalar>
[[nodiscard]] Eigen::AlignedBox<Scalar, 3> robust_box(const TriangleMesh<Scalar>& mesh);

/// The faces none of whose corners lies farther from `box`, the mesh's robust one, than its diagonal: a body reaches a
/// third of it beyond. None where these are all faces. O(faces).
template <typename Scalar>
[[nodiscard]] std::optional<Triangles> faces_within_reach(const TriangleMesh<Scalar>& mesh,
                                                          const Eigen::AlignedBox<Scalar, 3>& box);

/// Which vertices faces use, and which of these become one.
struct Welding {
    std::vector<int> used;
    core::DisjointSets groups;

    /// Are all of a mesh's vertices used and left apart?
    [[nodiscard]] bool keeps(Eigen::Index vertices) const {
        const auto n = static_cast<std::size_t>(vertices);
        return used.size() == n && groups.count() == n;
    }
};

/// The welds that `weld` makes. \throws Error, and O, as it.
template <typename Scalar>
[[nodiscard]] Welding find_welds(const TriangleMesh<Scalar>& mesh, Scalar tolerance,
                                 const std::vector<bool>& apart = {});

/// The mesh with these welds made. O(n).
template <typename Scalar>
[[nodiscard]] WeldedMesh<Scalar> weld(const TriangleMesh<Scalar>& mesh, Welding welding);

/// Makes one vertex of those at equal places, then of those in chains of steps up to `tolerance` (in the mesh's unit),
/// and leaves out what no face uses; the first of each group stays, and all keep their order. `apart` (one entry for
/// each vertex; empty: none) marks those that stay as they are. Faces may come to repeat a vertex. A mesh without any
/// of this comes back with the same vertices and faces. \throws Error usage when `apart` has another size. O(n log n)
/// where few lie as near.
template <typename Scalar>
[[nodiscard]] WeldedMesh<Scalar> weld(const TriangleMesh<Scalar>& mesh, Scalar tolerance,
                                      const std::vector<bool>& apart = {});

/// Marks the vertices of closed pieces: of four faces or more that hang together by vertices, two at every edge. Not
/// those of copies, which have another piece's vertex at each of their places, as `placed` (of WeldedMesh) says: such a
/// piece bounds something by itself, and where another one touches it, a seam would tear both. O(n log n).
template <typename Scalar>
[[nodiscard]] std::vector<bool> in_closed_pieces(const TriangleMesh<Scalar>& mesh, const std::vector<int>& placed);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/weld.hpp>
#endif
