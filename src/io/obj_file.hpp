#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <skelgen/io/polygon_mesh.hpp>

namespace skelgen::io::detail {

/// What a corner of an OBJ's face has beside its vertex, as indices; -1: nothing, or what is not there.
struct ObjCorner {
    int texture = -1, normal = -1;
    friend bool operator==(const ObjCorner&, const ObjCorner&) = default;
};

/// All of a Wavefront OBJ file that says what its faces look like.
struct ObjFile {
    PolygonMesh mesh;
    std::vector<ObjCorner> corners;         ///< of the mesh's corners
    std::vector<float> texture_coordinates; ///< two each; what is no number is 0
    std::vector<float> normals;             ///< three each; zero where one is no number
    std::vector<float> colours;             ///< four for each vertex; none where no vertex has any
    std::vector<std::string> libraries;     ///< what stands behind mtllib: a file's name, or several
    std::vector<std::string> materials;     ///< names, as they are first used
    std::vector<int> face_materials;        ///< of the mesh's faces; -1: none
};

/// Reads all of an OBJ file. What it says of looks may be unsound: it is left out. Linear. \throws Error as
/// `parse_obj`.
[[nodiscard]] ObjFile parse_obj_file(std::string_view text);

} // namespace skelgen::io::detail
