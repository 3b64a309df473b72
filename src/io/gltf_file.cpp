#include "gltf_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>

#include <skelgen/core/error.hpp>

#include "binary_reader.hpp"

namespace skelgen::io::detail {
namespace {

constexpr std::string_view glb_magic = "glTF";
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942; // "JSON", "BIN"

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::bad_input, "glTF: " + message); }

/// A scene has no use for more, and each level takes a hundred times the memory of its one byte.
constexpr int deepest_nesting = 100;

GltfValue::Json parse(std::string_view text) {
    const auto check_depth = [](int depth, GltfValue::Json::parse_event_t, GltfValue::Json&) {
        if (depth > deepest_nesting) refuse("its JSON is nested too deeply; export the scene again");
        return true;
    };
    try {
        return GltfValue::Json::parse(text, check_depth);
    } catch (const GltfValue::Json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 1, ...": users can do without the first word.
        const std::string_view what = error.what();
        refuse("its JSON cannot be read: " + std::string(what.substr(what.find(']') + 2)) +
               "; repair or export the scene again");
    }
}

/// Extensions that change what shapes a scene has, and that are known here.
constexpr std::array<std::string_view, 3> known_extensions{"KHR_mesh_quantization", "KHR_draco_mesh_compression",
                                                           "EXT_meshopt_compression"};
/// Beginnings of the names of those that change looks and meanings alone.
constexpr std::array<std::string_view, 12> harmless_prefixes{
    "KHR_materials_", "KHR_texture_", "KHR_lights_", "KHR_xmp", "KHR_techniques_",      "KHR_audio", "EXT_texture_",
    "EXT_lights_",    "MSFT_",        "ADOBE_",      "VRM",     "KHR_animation_pointer"};

bool is_harmless(std::string_view extension) {
    return std::any_of(harmless_prefixes.begin(), harmless_prefixes.end(),
                       [extension](std::string_view prefix) { return extension.starts_with(prefix); });
}

void check_extensions(const GltfValue& root) {
    const auto required = root.find("extensionsRequired");
    for (std::size_t i = 0; required && i < required->size(); ++i) {
        const std::string& name = (*required)[i].text();
        const bool known = std::find(known_extensions.begin(), known_extensions.end(), name) != known_extensions.end();
        if (!known && !is_harmless(name))
            refuse("the scene needs the extension " + name + ", which is not known here; export it without");
    }
}

void check_version(const GltfValue& root) {
    const std::string& version = root.at("asset").at("version").text();
    if (!version.starts_with("2."))
        refuse("is of version " + version + ", and 2.0 is read; export the scene as glTF 2.0");
}

/// The two chunks of a GLB file: JSON and, where there is one, binary.
std::pair<std::string_view, std::optional<std::string_view>> split_glb(std::string_view bytes) {
    BinaryReader reader(bytes, std::endian::little, "scene");
    reader.skip(glb_magic.size());
    const auto version = reader.read<std::uint32_t>();
    if (version != 2)
        refuse("is of version " + std::to_string(version) + ", and 2 is read; export the scene as glTF 2.0");
    const auto length = reader.read<std::uint32_t>();
    if (length > bytes.size())
        reader.fail("the header promises " + std::to_string(length) + " bytes, but the file has " +
                    std::to_string(bytes.size()));

    const auto next_chunk = [&](std::uint32_t type, const char* name) {
        const auto size = reader.read<std::uint32_t>();
        if (reader.read<std::uint32_t>() != type) reader.fail(std::string("this is no chunk of type ") + name);
        const std::string_view chunk = bytes.substr(bytes.size() - reader.bytes_left(), size);
        reader.skip(size);
        return chunk;
    };
    constexpr std::size_t chunk_header = 8;
    const std::string_view json = next_chunk(json_chunk, "JSON");
    if (reader.bytes_left() < chunk_header) return {json, std::nullopt};
    return {json, next_chunk(binary_chunk, "BIN")};
}

} // namespace

bool is_glb(std::string_view bytes) { return bytes.starts_with(glb_magic); }

bool is_gltf_json(std::string_view bytes) {
    constexpr std::size_t far_enough = 1024;
    const std::size_t start = bytes.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos || bytes[start] != '{') return false;
    const std::string_view head = bytes.substr(start, far_enough);
    for (const char* word :
         {"\"asset\"", "\"accessors\"", "\"bufferViews\"", "\"nodes\"", "\"scenes\"", "\"extensions"})
        if (head.find(word) != std::string_view::npos) return true;
    return false;
}

GltfFile open_gltf(std::string_view bytes) {
    std::string_view text = bytes;
    GltfFile file;
    if (is_glb(bytes)) std::tie(text, file.binary) = split_glb(bytes);
    file.json = parse(text);
    check_version(file.root());
    check_extensions(file.root());
    return file;
}

} // namespace skelgen::io::detail
