#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::io {

/// Polygons as files hold them, before they become a TriangleMesh.
struct PolygonMesh {
    std::vector<double> coordinates; ///< x, y, z of every vertex in turn
    std::vector<int> corners;        ///< vertex indices, face after face, counter-clockwise seen from outside
    std::vector<int> sizes;          ///< number of corners of each face, 3 or more
    int placeless = 0; ///< corners of the file that have been left out with their faces: at no finite place
};

/// Most corners a face may have: a face of n corners takes O(n^2).
inline constexpr int max_face_corners = 10000;

/// Cuts every polygon into triangles along its own diagonals, the shortest first (a concave polygon is not covered
/// twice, a quad is cut along its shorter inner diagonal). Vertices keep their indices, also those that no face uses;
/// triangles follow the order of the faces. Triangles that would name a vertex twice are left out; nothing else is:
/// several fans around one vertex, or three faces at one edge, stay as they are.
/// O(vertices + corners) for triangles and quads; O(n^2) for a polygon of n corners.
/// \throws Error bad_input when there is no vertex or no face left, a coordinate is not finite (in `Scalar`), a face
///         has less than 3 or more than `max_face_corners` corners, or a corner names no vertex; or when there
///         are so many polygons of more than 100 corners that the squares of their corners add up to more than 4e8.
template <typename Scalar = double>
[[nodiscard]] TriangleMesh<Scalar> triangulate(const PolygonMesh& polygons);

/// The triangles of polygons, and which polygon each is cut from.
struct CutPolygons {
    Triangles triangles;
    std::vector<int> source; ///< per triangle
};

/// The faces that `triangulate` gives, with where they come from. \throws Error as that, but for what `Scalar` cannot
/// hold.
[[nodiscard]] CutPolygons cut_polygons(const PolygonMesh& polygons);

} // namespace skelgen::io
