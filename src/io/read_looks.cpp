#include <skelgen/io/scene_looks.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_file.hpp>

#include "companion_file.hpp"
#include "gltf_looks.hpp"
#include "json_values.hpp"
#include "mesh_encoding.hpp"
#include "obj_looks.hpp"
#include "plain_content.hpp"

namespace skelgen::io {
namespace {

std::optional<SceneLooks> looks_in(std::string_view bytes, const ReadMeshOptions& options,
                                   const detail::LoadCompanion& load) {
    std::string decompressed, converted;
    bytes = detail::with_line_feeds(detail::plain_content(bytes, decompressed), converted);
    switch (detail::encoding_of(bytes, options.format)) {
    case detail::Encoding::gltf:
        return detail::read_gltf_looks(bytes, options, load);
    case detail::Encoding::obj:
        return detail::read_obj_looks(bytes, load);
    case detail::Encoding::ply:
        return detail::read_ply_looks(bytes);
    default:
        return std::nullopt;
    }
}

/// As `looks_in`. Errors may quote what the file holds: their text is valid UTF-8 whatever that is.
std::optional<SceneLooks> looks_telling_errors(std::string_view bytes, const ReadMeshOptions& options,
                                               const detail::LoadCompanion& load) {
    try {
        return looks_in(bytes, options, load);
    } catch (const Error& error) {
        throw Error(error.code(), detail::valid_utf8(error.what()));
    }
}

} // namespace

std::optional<SceneLooks> parse_looks(std::string_view content, const ReadMeshOptions& options) {
    return looks_telling_errors(content, options, detail::refuse_companion);
}

std::optional<SceneLooks> read_looks(const std::filesystem::path& path, const ReadMeshOptions& options) {
    ReadMeshOptions named = options;
    if (!named.format) named.format = mesh_format_of(path);
    return looks_telling_errors(read_file(path), named, [folder = path.parent_path()](const std::string& reference) {
        return detail::read_companion(folder, reference);
    });
}

} // namespace skelgen::io
