#include <skelgen/io/read_mesh.hpp>

#include <algorithm>
#include <string>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_file.hpp>

#include "assimp_importer.hpp"
#include "companion_file.hpp"
#include "gltf_file.hpp"
#include "gltf_parser.hpp"
#include "json_values.hpp"
#include "mesh_parsers.hpp"
#include "plain_content.hpp"
#include "text_scanner.hpp"

namespace skelgen::io {
namespace {

enum class Encoding { off, obj, ply, stl_text, stl_binary, gltf, fbx, dae };

[[noreturn]] void throw_unreadable(const std::string& message) { throw Error(ErrorCode::bad_input, message); }

/// STL text has further words of STL behind "solid"; the free header of a binary one may begin with "solid" too.
bool is_stl_text(std::string_view content, std::string_view first_word) {
    if (first_word != "solid" && first_word != "SOLID") return false;
    constexpr std::size_t far_enough = 1024;
    const std::string_view start = content.substr(0, far_enough);
    if (start.find('\0') != std::string_view::npos) return false;
    for (const char* word : {"facet", "FACET", "endsolid", "ENDSOLID"})
        if (start.find(word) != std::string_view::npos) return true;
    return false;
}

std::optional<Encoding> encoding_by_content(std::string_view content) {
    if (detail::is_glb(content) || detail::is_gltf_json(content)) return Encoding::gltf;
    if (detail::is_fbx(content)) return Encoding::fbx;
    if (detail::is_collada(content)) return Encoding::dae;
    if (detail::is_stl_binary(content)) return Encoding::stl_binary;
    detail::TextScanner scanner(content);
    scanner.seek_word();
    const std::string_view first_word = scanner.word();
    if (first_word == "ply") return Encoding::ply;
    if (detail::is_off_keyword(first_word)) return Encoding::off;
    if (is_stl_text(content, first_word)) return Encoding::stl_text;
    if (detail::is_obj_keyword(first_word)) return Encoding::obj;
    return std::nullopt;
}

Encoding encoding_by_extension(std::optional<MeshFormat> extension) {
    if (!extension) throw_unreadable("is no mesh in a known format (" + mesh_extensions_text() + ")");
    switch (*extension) {
    case MeshFormat::off:
        return Encoding::off;
    case MeshFormat::obj:
        return Encoding::obj;
    case MeshFormat::ply:
        return Encoding::ply;
    case MeshFormat::stl:
        return Encoding::stl_binary;
    case MeshFormat::glb:
    case MeshFormat::gltf:
    case MeshFormat::vrm:
        return Encoding::gltf;
    case MeshFormat::fbx:
        return Encoding::fbx;
    case MeshFormat::dae:
        break;
    }
    return Encoding::dae;
}

PolygonMesh parse(std::string_view content, Encoding encoding, const ReadMeshOptions& options,
                  const detail::LoadCompanion& load) {
    switch (encoding) {
    case Encoding::off:
        return detail::parse_off(content);
    case Encoding::obj:
        return detail::parse_obj(content);
    case Encoding::ply:
        return detail::parse_ply(content);
    case Encoding::stl_text:
        return detail::parse_stl_text(content);
    case Encoding::stl_binary:
        return detail::parse_stl_binary(content);
    case Encoding::gltf:
        return detail::parse_gltf(content, options, load);
    case Encoding::fbx:
        return detail::import_scene(content, MeshFormat::fbx, options);
    case Encoding::dae:
        break;
    }
    return detail::import_scene(content, MeshFormat::dae, options);
}

bool is_scene(Encoding encoding) { return encoding >= Encoding::gltf; }

/// Lines that end in a carriage return alone (old Macs), as lines that the parsers know; empty for all other files.
std::string with_line_feeds(std::string_view content) {
    const auto has = [content](char c) { return content.find(c) != std::string_view::npos; };
    if (has('\n') || !has('\r') || has('\0')) return {};
    std::string result(content);
    std::replace(result.begin(), result.end(), '\r', '\n');
    return result;
}

/// Reads a file's content. `load` gives the files that it refers to.
PolygonMesh read_polygons(std::string_view content, const ReadMeshOptions& options, const detail::LoadCompanion& load) {
    std::string decompressed;
    content = detail::plain_content(content, decompressed);
    if (content.empty()) throw_unreadable("the file is empty; write it again");
    const std::string converted = with_line_feeds(content);
    if (!converted.empty()) content = converted;

    const std::optional<Encoding> by_content = encoding_by_content(content);
    const Encoding encoding = by_content ? *by_content : encoding_by_extension(options.format);
    if (!options.animation.empty() && !is_scene(encoding))
        throw Error(ErrorCode::usage, "has no animations: its format is none for scenes; leave the option out");
    return parse(content, encoding, options, load);
}

/// As `read_polygons`. Errors may quote what the file holds: their text is valid UTF-8 whatever that is.
PolygonMesh read_telling_errors(std::string_view content, const ReadMeshOptions& options,
                                const detail::LoadCompanion& load) {
    try {
        return read_polygons(content, options, load);
    } catch (const Error& error) {
        throw Error(error.code(), detail::valid_utf8(error.what()));
    }
}

} // namespace

template <typename Scalar>
TriangleMesh<Scalar> parse_mesh(std::string_view content, const ReadMeshOptions& options) {
    return triangulate<Scalar>(read_telling_errors(content, options, detail::refuse_companion));
}

template <typename Scalar>
TriangleMesh<Scalar> parse_mesh(std::string_view content, std::optional<MeshFormat> format) {
    return parse_mesh<Scalar>(content, ReadMeshOptions{format, "", 0});
}

template <typename Scalar>
TriangleMesh<Scalar> read_mesh(const std::filesystem::path& path, const ReadMeshOptions& options) {
    ReadMeshOptions named = options;
    if (!named.format) named.format = mesh_format_of(path);
    const auto load = [folder = path.parent_path()](const std::string& reference) {
        return detail::read_companion(folder, reference);
    };
    return triangulate<Scalar>(read_telling_errors(read_file(path), named, load));
}

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template TriangleMesh<Scalar> parse_mesh<Scalar>(std::string_view, const ReadMeshOptions&);                        \
    template TriangleMesh<Scalar> parse_mesh<Scalar>(std::string_view, std::optional<MeshFormat>);                     \
    template TriangleMesh<Scalar> read_mesh<Scalar>(const std::filesystem::path&, const ReadMeshOptions&);
SKELGEN_INSTANTIATE(float)
SKELGEN_INSTANTIATE(double)
#undef SKELGEN_INSTANTIATE

} // namespace skelgen::io
