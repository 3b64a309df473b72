#include <skelgen/io/write_mesh.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

#include <skelgen/io/atomic_file.hpp>

#include "fbx_writer.hpp"
#include "glb_writer.hpp"
#include "gzip.hpp"
#include "little_endian.hpp"
#include "number_text.hpp"
#include "unwritable_mesh.hpp"

namespace skelgen::io {
namespace {

using detail::append_little_endian;
using detail::append_number;
using detail::append_point;
using detail::refuse_to_write_mesh;

template <typename Scalar>
void check(const TriangleMesh<Scalar>& mesh) {
    if (!mesh.vertices.allFinite()) refuse_to_write_mesh("a coordinate is not a number or infinite; repair the mesh");
    if (mesh.faces.size() > 0 && (mesh.faces.minCoeff() < 0 || mesh.faces.maxCoeff() >= mesh.vertices.rows()))
        refuse_to_write_mesh("a face names a vertex that does not exist; repair the mesh");
}

/// Vertices and faces as text, one a line behind the given starts.
template <typename Scalar>
void append_rows(std::string& text, const TriangleMesh<Scalar>& mesh, const char* vertex_start, const char* face_start,
                 int first_index) {
    for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i) {
        text += vertex_start;
        append_point(text, mesh.vertices.row(i));
        text += '\n';
    }
    for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i) {
        text += face_start;
        for (int corner = 0; corner < 3; ++corner) {
            text += ' ';
            append_number(text, mesh.faces(i, corner) + first_index);
        }
        text += '\n';
    }
}

template <typename Scalar>
std::string format_off(const TriangleMesh<Scalar>& mesh) {
    std::string text = "OFF\n";
    append_number(text, mesh.vertices.rows());
    text += ' ';
    append_number(text, mesh.faces.rows());
    text += " 0\n";
    append_rows(text, mesh, "", "3", 0);
    return text;
}

template <typename Scalar>
std::string format_obj(const TriangleMesh<Scalar>& mesh) {
    std::string text;
    append_rows(text, mesh, "v ", "f", 1);
    return text;
}

template <typename Scalar>
std::string ply_header(const TriangleMesh<Scalar>& mesh) {
    const std::string type = std::is_same_v<Scalar, float> ? "float" : "double";
    std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex ";
    append_number(header, mesh.vertices.rows());
    for (const char* axis : {"x", "y", "z"}) header += "\nproperty " + type + " " + axis;
    header += "\nelement face ";
    append_number(header, mesh.faces.rows());
    header += "\nproperty list uchar int vertex_indices\nend_header\n";
    return header;
}

template <typename Scalar>
std::string format_ply(const TriangleMesh<Scalar>& mesh) {
    std::string bytes = ply_header(mesh);
    for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i)
        for (int axis = 0; axis < 3; ++axis) append_little_endian(bytes, mesh.vertices(i, axis));
    for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i) {
        append_little_endian(bytes, std::uint8_t{3});
        for (int corner = 0; corner < 3; ++corner)
            append_little_endian(bytes, static_cast<std::int32_t>(mesh.faces(i, corner)));
    }
    return bytes;
}

template <typename Scalar>
Eigen::Vector3f unit_normal(const TriangleMesh<Scalar>& mesh, Eigen::Index face) {
    const auto corner = [&](int i) {
        return mesh.vertices.row(mesh.faces(face, i)).transpose().template cast<double>().eval();
    };
    const Eigen::Vector3d origin = corner(0);
    const Eigen::Vector3d normal =
        (corner(1) - origin).stableNormalized().cross((corner(2) - origin).stableNormalized()).stableNormalized();
    return normal.cast<float>();
}

template <typename Scalar>
std::string format_stl(const TriangleMesh<Scalar>& mesh) {
    const Points<float> vertices = mesh.vertices.template cast<float>();
    if (!vertices.allFinite()) refuse_to_write_mesh("a coordinate is too large for STL; write OFF, OBJ or PLY");

    constexpr std::size_t header_bytes = 80;
    std::string bytes = "binary STL"; // a header that begins with "solid" would be taken for text
    bytes.resize(header_bytes, ' ');
    append_little_endian(bytes, static_cast<std::uint32_t>(mesh.faces.rows()));
    for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i) {
        const Eigen::Vector3f normal = unit_normal(mesh, i);
        for (int axis = 0; axis < 3; ++axis) append_little_endian(bytes, normal[axis]);
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis) append_little_endian(bytes, vertices(mesh.faces(i, corner), axis));
        append_little_endian(bytes, std::uint16_t{0});
    }
    return bytes;
}

/// As a file, compressed where its name says so.
void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
    write_file_atomically(path, has_gzip_extension(path) ? detail::gzip(bytes) : bytes);
}

} // namespace

template <typename Scalar>
std::string format_mesh(const TriangleMesh<Scalar>& mesh, MeshFormat format) {
    check(mesh);
    switch (format) {
    case MeshFormat::off:
        return format_off(mesh);
    case MeshFormat::obj:
        return format_obj(mesh);
    case MeshFormat::ply:
        return format_ply(mesh);
    case MeshFormat::stl:
        return format_stl(mesh);
    case MeshFormat::glb:
        return detail::format_glb(mesh.vertices.template cast<double>(), mesh.faces);
    case MeshFormat::fbx:
        return detail::glb_to_fbx(detail::format_glb({mesh.vertices.template cast<double>(), mesh.faces}, {}, {}), {});
    case MeshFormat::gltf:
    case MeshFormat::vrm:
    case MeshFormat::dae:
        break;
    }
    refuse_to_write_mesh("this format is only read; write " + written_mesh_extensions_text());
}

template <typename Scalar>
void write_mesh(const std::filesystem::path& path, const TriangleMesh<Scalar>& mesh) {
    const std::optional<MeshFormat> format = mesh_format_of(path);
    if (!format || !is_written(*format))
        refuse_to_write_mesh("the file's name must end in " + written_mesh_extensions_text());
    write_bytes(path, format_mesh(mesh, *format));
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh<double>& mesh, const SceneLooks& looks,
                const applications::VertexTurns<double>& turns) {
    const std::optional<MeshFormat> format = mesh_format_of(path);
    const bool is_fbx = format == MeshFormat::fbx;
    if ((format != MeshFormat::glb && !is_fbx) || looks.parts.empty()) return write_mesh(path, mesh);
    check(mesh);
    const std::string glb = detail::format_glb(mesh, looks, turns);
    write_bytes(path, is_fbx ? detail::glb_to_fbx(glb, {.copies = looks.copies}) : glb);
}

template std::string format_mesh<float>(const TriangleMesh<float>&, MeshFormat);
template std::string format_mesh<double>(const TriangleMesh<double>&, MeshFormat);
template void write_mesh<float>(const std::filesystem::path&, const TriangleMesh<float>&);
template void write_mesh<double>(const std::filesystem::path&, const TriangleMesh<double>&);

} // namespace skelgen::io
