#include "gltf_looks.hpp"

#include <array>
#include <set>
#include <string>
#include <utility>

#include <skelgen/core/error.hpp>

#include "data_uri.hpp"
#include "gltf_primitive.hpp"
#include "json_values.hpp"
#include "lost_pictures.hpp"
#include "picture_kind.hpp"

namespace skelgen::io::detail {
namespace {

/// An image's kind by its own bytes; what the file says of it where they are of none that glTF knows, as extensions
/// have them.
std::string mime_type(std::string_view bytes, const GltfValue& image) {
    if (const auto kind = picture_kind(bytes)) return std::string(*kind);
    const auto named = image.find("mimeType");
    if (bytes.empty() || !named || is_known_kind(named->text()))
        image.fail("is no picture of a known kind; save it as PNG or JPEG");
    return named->text();
}

std::string load_picture(GltfData& data, const GltfValue& image, const LoadCompanion& load) {
    if (const auto view = image.find("bufferView")) return std::string(data.view(*view));
    const std::string& uri = image.at("uri").text();
    if (!is_data_uri(uri)) return load(percent_decoded(uri));
    auto bytes = decode_data_uri(uri);
    if (!bytes) image.fail("holds its bytes in another way than base64, or they are damaged");
    return *std::move(bytes);
}

/// All keys of "extensions" objects anywhere in the JSON.
void collect_extensions(const GltfValue::Json& json, std::set<std::string>& names) {
    if (json.is_object())
        for (const auto& [key, value] : json.items()) {
            if (key == "extensions" && value.is_object())
                for (const auto& extension : value.items()) names.insert(extension.key());
            collect_extensions(value, names);
        }
    if (json.is_array())
        for (const auto& value : json) collect_extensions(value, names);
}

/// Of a list of extensions in the file those that `needed` has.
GltfValue::Json still_needed(const GltfFile& file, const char* list, const std::set<std::string>& needed) {
    GltfValue::Json kept = GltfValue::Json::array();
    const auto names = file.root().find(list);
    for (std::size_t i = 0; names && i < names->size(); ++i)
        if (needed.contains((*names)[i].text())) kept.push_back((*names)[i].text());
    return kept;
}

/// A material's reference to a texture and to the texture coordinates that it goes by.
void check_texture(const GltfValue& holder, const char* key) {
    const auto texture = holder.find(key);
    if (!texture) return;
    static_cast<void>(texture->at("index"));
    static_cast<void>(texture->whole_number("texCoord", 0));
}

/// Whether materials and textures are what glTF calls so, as far as it has names for it (2.0, section 5); what
/// extensions add is theirs, and `without_pictures` looks whether the textures that materials name are there.
void check_materials(const GltfFile& file) {
    for (std::size_t i = 0; i < file.count("textures"); ++i)
        if (const auto sampler = file.root().at("textures")[i].find("sampler"))
            static_cast<void>(file.referred("samplers", *sampler));
    for (std::size_t i = 0; i < file.count("materials"); ++i) {
        const GltfValue material = file.root().at("materials")[i];
        for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"}) check_texture(material, key);
        if (const auto metallic = material.find("pbrMetallicRoughness"))
            for (const char* key : {"baseColorTexture", "metallicRoughnessTexture"}) check_texture(*metallic, key);
    }
}

} // namespace

SceneLooks read_gltf_looks(std::string_view bytes, const ReadMeshOptions& options, const LoadCompanion& load) {
    const GltfFile file = open_gltf(bytes);
    GltfData data(file, bytes.size(), load);
    SceneLooks looks;
    for (GltfPart& found : gltf_parts(data, options)) {
        ScenePart part{found.first_vertex, found.vertices, found.first_face, found.faces, std::nullopt, {}, {}};
        const GltfValue primitive = file.root().at("meshes")[found.mesh].at("primitives")[found.primitive];
        if (const auto material = primitive.find("material")) {
            static_cast<void>(file.referred("materials", *material)); // there it is
            part.material = material->whole_number();
        }
        part.texture_coordinates = read_texture_coordinates(data, primitive);
        for (const auto& set : part.texture_coordinates)
            if (set.rows() != part.vertices)
                primitive.fail("has another number of texture coordinates than of vertices");
        part.colours = read_colours(data, primitive);
        if (part.colours.rows() > 0 && part.colours.rows() != part.vertices)
            primitive.fail("has another number of colours than of vertices");
        part.normals = std::move(found.normals);
        looks.parts.push_back(std::move(part));
    }

    check_materials(file);
    GltfValue::Json json = GltfValue::Json::object();
    for (const char* list : {"materials", "textures", "samplers"})
        if (file.count(list) > 0) json[list] = file.json.at(list);
    std::set<std::size_t> lost;
    for (std::size_t i = 0; i < file.count("images"); ++i) {
        const GltfValue image = file.root().at("images")[i];
        json["images"].push_back(GltfValue::Json::object());
        try {
            std::string picture = load_picture(data, image, load);
            json["images"].back()["mimeType"] = mime_type(picture, image);
            looks.pictures.push_back(std::move(picture));
        } catch (const Error& error) {
            if (error.code() != ErrorCode::bad_input) throw;
            looks.lost_pictures.push_back(valid_utf8(error.what()));
            lost.insert(i);
        }
    }
    json = without_pictures(std::move(json), lost);
    std::set<std::string> extensions;
    collect_extensions(json, extensions);
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        if (auto kept = still_needed(file, list, extensions); !kept.empty()) json[list] = std::move(kept);
    looks.json = json.dump();
    return looks;
}

} // namespace skelgen::io::detail
