#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <skelgen/io/polygon_mesh.hpp>

/// One parser per file format: the whole file in, polygons out; Error bad_input, naming the line or byte, otherwise.
/// None allocates more than a small multiple of the file's size, whatever its header claims. Time is linear.
///
/// Why not OpenMesh's readers: they build a half-edge mesh, which cannot hold every file's faces. Where two fans of
/// faces touch in one vertex, or three faces meet at an edge, faces are dropped or vertices doubled, so that the
/// result no longer has the file's indices; and they resize to a header's counts before they look at the data.
namespace skelgen::io::detail {

/// OFF as Geomview defines it: [ST][C][N]OFF, text or binary, colours behind vertices and faces, comments.
[[nodiscard]] PolygonMesh parse_off(std::string_view bytes);

/// Whether this first word of a file announces OFF ("OFF", "COFF", "OFF8" with the count stuck to it, ...).
[[nodiscard]] bool is_off_keyword(std::string_view word);

/// Wavefront OBJ: v and f of all objects and groups; everything else is skipped.
[[nodiscard]] PolygonMesh parse_obj(std::string_view text);

/// Whether this first word of a file is one that OBJ files begin with.
[[nodiscard]] bool is_obj_keyword(std::string_view word);

/// PLY 1.0, text and binary of either byte order, with any further elements and properties.
[[nodiscard]] PolygonMesh parse_ply(std::string_view bytes);

/// A PLY file's mesh, and what it says of the vertices beside, one after another; none where it says nothing.
struct PlyFile {
    PolygonMesh mesh;
    std::vector<float> normals; ///< nx, ny, nz: three each, zero where one is no number
    std::vector<float> colours; ///< red, green, blue, alpha: four each, 0 to 1 as they are shown
    std::string texture_file;   ///< the picture's name, as MeshLab has it; empty: none
};

/// Reads all that. \throws Error as `parse_ply`.
[[nodiscard]] PlyFile parse_ply_file(std::string_view bytes);

/// STL: corners at exactly the same position (0 and -0 are the same) become one vertex, numbered as they appear.
[[nodiscard]] PolygonMesh parse_stl_text(std::string_view text);
[[nodiscard]] PolygonMesh parse_stl_binary(std::string_view bytes);

/// Whether the size is exactly the one that a binary STL's count of facets asks for. No text is taken for one below
/// 7 GB: four characters of text make a count of at least 0x09090909.
[[nodiscard]] bool is_stl_binary(std::string_view bytes);

} // namespace skelgen::io::detail
