#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include <skelgen/core/mesh.hpp>
#include <skelgen/io/mesh_format.hpp>

namespace skelgen::io {

/// What to make of a file.
struct ReadMeshOptions {
    /// The format where the content does not tell (OBJ with unusual first words); none: the extension's.
    std::optional<MeshFormat> format = std::nullopt;
    /// Of scenes (GLB, glTF, VRM, FBX, DAE): the animation to pose them by, by its name or its number, counted from 1.
    /// Empty: none, they are posed as they are stored.
    std::string animation = {};
    double time = 0; ///< seconds from the animation's beginning
    /// Read FBX and DAE in a forked process of their own, of limited time and memory. The library that reads them may
    /// crash on damaged files, or take all that there is. For programs that read strangers' files; a program with
    /// threads of its own has to see to it that none holds a lock meanwhile.
    bool isolated = false;
    /// Told what of the file is left out, a sentence: of FBX and DAE, corners of faces at no finite place.
    std::function<void(const std::string&)> tell = {};
};

/// Reads a triangle mesh: OFF (text, Geomview's binary), OBJ, PLY (text, binary of either byte order), STL (text,
/// binary). Or GLB, glTF or VRM (2.0; also quantised, sparse, compressed by meshopt or Draco), FBX or DAE. What the
/// file holds decides which it is; its extension only where that says nothing. Each may be compressed by gzip.
///
/// - Vertices and faces keep the file's order and indices; normals, colours and texture coordinates are dropped. STL,
///   FBX and DAE: corners at exactly the same position become one vertex.
/// - Polygons are cut into triangles (see `triangulate`). Triangles that name a vertex twice are left out.
/// - Scenes give the triangles that a viewer shows, in the scene's unit: all meshes, moved by their nodes, morphed by
///   their weights, posed by their skins. They are as stored, or as an animation has them. Files that a glTF
///   refers to must be in its folder or below.
/// - Nothing is repaired: pinched vertices, holes, several components and unused vertices come through as they are.
///
/// `Scalar` is float or double. Linear in the file's size, which is 2 GiB at most, also decompressed. Memory stays
/// below a small multiple of it even if the file's counts lie, but for FBX and DAE (see `isolated`). Pipes can be read
/// too. Compressed files, FBX and DAE need libraries that a build may lack: the message then says so. \throws Error
/// bad_input, naming the line, the byte or the place, when there is no such file, or it is of another format, too
/// large, cut short, or longer. It is thrown, too, for a coordinate that is not finite, a face with
/// less than 3 corners or a vertex that does not exist, or no vertices or faces. Error usage when there is
/// no such animation.
template <typename Scalar = double>
[[nodiscard]] TriangleMesh<Scalar> read_mesh(const std::filesystem::path& path, const ReadMeshOptions& options = {});

/// As `read_mesh`, from the content of a file in memory. A scene that refers to other files is then bad input.
template <typename Scalar = double>
[[nodiscard]] TriangleMesh<Scalar> parse_mesh(std::string_view content, const ReadMeshOptions& options);

/// The same with the format to fall back on alone.
template <typename Scalar = double>
[[nodiscard]] TriangleMesh<Scalar> parse_mesh(std::string_view content,
                                              std::optional<MeshFormat> format = std::nullopt);

} // namespace skelgen::io

namespace skelgen {
using io::read_mesh;
} // namespace skelgen
