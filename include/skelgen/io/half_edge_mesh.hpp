#pragma once

// What the adaptors to half-edge libraries (OpenMesh, CGAL) share.

#include <cstddef>
#include <string>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/io/polygon_mesh.hpp>

namespace skelgen::io::detail {

/// Takes down a half-edge mesh: first its vertices, then its faces corner by corner. Where elements were removed, the
/// indices have gaps; here they close up.
class PolygonCollector {
public:
    /// Every vertex index is below `indices`.
    explicit PolygonCollector(std::size_t indices) : new_index_(indices, -1) {}

    void add_vertex(int index, double x, double y, double z) {
        new_index_[static_cast<std::size_t>(index)] = static_cast<int>(polygons_.coordinates.size() / 3);
        polygons_.coordinates.insert(polygons_.coordinates.end(), {x, y, z});
    }

    void add_corner(int index) {
        polygons_.corners.push_back(new_index_[static_cast<std::size_t>(index)]);
        ++size_;
    }

    void end_face() {
        polygons_.sizes.push_back(size_);
        size_ = 0;
    }

    [[nodiscard]] const PolygonMesh& polygons() const { return polygons_; }

private:
    PolygonMesh polygons_;
    std::vector<int> new_index_; ///< per vertex index: the vertex's number among those that are there
    int size_ = 0;               ///< of the face being added
};

/// \throws Error bad_input always: a half-edge mesh cannot hold this face.
[[noreturn]] inline void throw_no_half_edge_face(std::ptrdiff_t face) {
    throw Error(ErrorCode::bad_input, "face " + std::to_string(face) +
                                          " (counted from 0) does not fit into a half-edge mesh: the surface is not "
                                          "manifold or not consistently turned there; repair it");
}

} // namespace skelgen::io::detail
