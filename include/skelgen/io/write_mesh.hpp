#pragma once

#include <filesystem>
#include <string>

#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/scene_looks.hpp>

namespace skelgen::io {

/// The bytes of a file with this mesh. OFF and OBJ are text with the shortest numbers that read back the same, PLY is
/// binary little-endian with properties of type `Scalar`. STL, GLB and FBX are binary (FBX 7.4, whose unit is said to
/// be the metre, as glTF's is). STL, GLB and FBX have single precision, and STL no indices. `Scalar` is float or
/// double. Linear. \throws Error usage when the format is one that is only read, a face names no vertex, a coordinate
/// is not finite, or too large for the format's floats.
template <typename Scalar>
[[nodiscard]] std::string format_mesh(const TriangleMesh<Scalar>& mesh, MeshFormat format);

/// Writes `mesh` in the format of the extension: .off, .obj, .ply, .stl, .glb or .fbx; compressed where `.gz`
/// follows. The file appears whole or not at all
/// (see `write_file_atomically`). \throws Error usage when the extension is none of these or as `format_mesh`; as
/// `write_file_atomically` when the file
///         cannot be written.
template <typename Scalar>
void write_mesh(const std::filesystem::path& path, const TriangleMesh<Scalar>& mesh);

/// The same with the looks of the scene whose vertices and faces these are, however they have moved: kept by GLB and
/// FBX, by no other format. `turns`: how each vertex has been turned since, as `PosedBody::turns`; then the looks' own
/// normals are written, else smooth ones. \throws Error usage also when looks or turns are those of another mesh.
void write_mesh(const std::filesystem::path& path, const TriangleMesh<double>& mesh, const SceneLooks& looks,
                const applications::VertexTurns<double>& turns = {});

} // namespace skelgen::io

namespace skelgen {
using io::write_mesh;
} // namespace skelgen
