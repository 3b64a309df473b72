#include "mesh_encoding.hpp"

#include <string>

#include <skelgen/core/error.hpp>

#include "assimp_importer.hpp"
#include "gltf_file.hpp"
#include "mesh_parsers.hpp"
#include "text_scanner.hpp"

namespace skelgen::io::detail {
namespace {

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
    if (is_glb(content) || is_gltf_json(content)) return Encoding::gltf;
    if (is_fbx(content)) return Encoding::fbx;
    if (is_collada(content)) return Encoding::dae;
    if (is_stl_binary(content)) return Encoding::stl_binary;
    TextScanner scanner(content);
    scanner.seek_word();
    const std::string_view first_word = scanner.word();
    if (first_word == "ply") return Encoding::ply;
    if (is_off_keyword(first_word)) return Encoding::off;
    if (is_stl_text(content, first_word)) return Encoding::stl_text;
    if (is_obj_keyword(first_word)) return Encoding::obj;
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

} // namespace

Encoding encoding_of(std::string_view content, std::optional<MeshFormat> format) {
    const std::optional<Encoding> by_content = encoding_by_content(content);
    return by_content ? *by_content : encoding_by_extension(format);
}

} // namespace skelgen::io::detail
