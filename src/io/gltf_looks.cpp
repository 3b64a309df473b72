#include "gltf_looks.hpp"

#include <array>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include <skelgen/core/error.hpp>

#include "data_uri.hpp"
#include "gltf_primitive.hpp"
#include "json_values.hpp"
#include "lost_pictures.hpp"
#include "picture_kind.hpp"
#include "vrm_reader.hpp"

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

/// An object's "extras" as JSON; empty where it has none.
std::string extras_of(const GltfValue& value) {
    const auto found = value.members().find("extras");
    return found == value.members().end() ? "" : found->second.dump();
}

std::string name_of(const GltfValue& value) {
    const auto found = value.members().find("name");
    return found != value.members().end() && found->second.is_string() ? found->second.get<std::string>() : "";
}

/// A mesh's "extras" with the names of its morph targets: some programs have these with the mesh's primitives.
std::string mesh_extras(const GltfValue& mesh) {
    using Json = GltfValue::Json;
    const auto own = mesh.members().find("extras");
    Json extras = own == mesh.members().end() ? Json() : own->second;
    const GltfValue primitives = mesh.at("primitives");
    if (extras.is_null()) extras = Json::object();
    for (std::size_t i = 0; i < primitives.size() && extras.is_object() && !extras.contains("targetNames"); ++i) {
        const auto others = primitives[i].members().find("extras");
        if (others == primitives[i].members().end() || !others->second.is_object()) continue;
        if (const auto names = others->second.find("targetNames"); names != others->second.end())
            extras["targetNames"] = *names;
    }
    return extras.empty() ? "" : extras.dump();
}

std::vector<SceneObject> with_names(std::vector<SceneObject> objects, const GltfFile& file) {
    for (SceneObject& object : objects) {
        const GltfValue node = file.root().at("nodes")[object.node], mesh = file.root().at("meshes")[object.mesh];
        object.name = name_of(node);
        object.mesh_name = name_of(mesh);
        object.extras = extras_of(node);
        object.mesh_extras = mesh_extras(mesh);
    }
    return objects;
}

/// What the file says of itself that outlives the program which wrote it; what it says as VRM as others say it, too.
std::string about(const GltfFile& file, const GltfValue::Json& vrm) {
    using Json = GltfValue::Json;
    Json out = Json::object();
    const GltfValue asset = file.root().at("asset");
    for (const char* key : {"copyright", "extras"})
        if (const auto member = asset.members().find(key); member != asset.members().end()) out[key] = member->second;
    if (!vrm.is_object()) return out.dump();
    const Json& meta = vrm.at("meta");
    Json& extras = out["extras"];
    const auto say = [&](const char* key, const std::string& text) {
        if ((extras.is_null() || extras.is_object()) && !extras.contains(key) && !text.empty()) extras[key] = text;
    };
    const auto said = [&](const char* key) {
        return meta.contains(key) && meta.at(key).is_string() ? meta.at(key).get<std::string>() : "";
    };
    std::string authors;
    if (meta.contains("authors") && meta.at("authors").is_array())
        for (const Json& author : meta.at("authors"))
            if (author.is_string()) authors += (authors.empty() ? "" : ", ") + author.get<std::string>();
    say("title", said("name"));
    say("author", authors);
    say("license", said(said("otherLicenseUrl").empty() ? "licenseUrl" : "otherLicenseUrl"));
    if (extras.is_null()) out.erase("extras");
    const std::string copyright = said("copyrightInformation").empty() ? authors : said("copyrightInformation");
    if (!out.contains("copyright") && !copyright.empty()) out["copyright"] = copyright;
    return out.dump();
}

/// VRM's data with the number that its thumbnail has once those pictures are left out.
GltfValue::Json with_kept_thumbnail(GltfValue::Json vrm, const std::set<std::size_t>& lost) {
    GltfValue::Json& meta = vrm["meta"];
    if (!meta.contains("thumbnailImage")) return vrm;
    const auto image = meta["thumbnailImage"].get<std::size_t>();
    if (lost.contains(image))
        meta.erase("thumbnailImage");
    else
        meta["thumbnailImage"] = image - static_cast<std::size_t>(std::distance(lost.begin(), lost.lower_bound(image)));
    return vrm;
}

/// "2 cameras"
std::string counted(std::size_t number, const std::string& one) {
    return std::to_string(number) + ' ' + one + (number == 1 ? "" : "s");
}

/// What of the file is neither a mesh's nor a rig's.
std::vector<std::string> what_is_left_out(const GltfFile& file, const std::string& lost_morphs) {
    std::vector<std::string> out;
    if (const std::size_t number = file.count("animations"); number > 0) out.push_back(counted(number, "animation"));
    if (const std::size_t number = file.count("cameras"); number > 0) out.push_back(counted(number, "camera"));
    const auto extensions = file.root().find("extensions");
    if (extensions && extensions->members().contains("KHR_lights_punctual")) out.emplace_back("lights");
    if (!lost_morphs.empty()) out.push_back("morph targets (" + lost_morphs + ")");
    return out;
}

} // namespace

SceneLooks read_gltf_looks(std::string_view bytes, const ReadMeshOptions& options, const LoadCompanion& load) {
    const GltfFile file = open_gltf(bytes);
    GltfData data(file, bytes.size(), load);
    GltfData morphs(file, bytes.size(), load);
    SceneLooks looks;
    GltfScene scene = gltf_scene(data, morphs, options);
    for (GltfPart& found : scene.parts) {
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

    looks.objects = with_names(std::move(scene.objects), file);

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
    VrmData vrm = read_vrm(file, looks.objects, scene.node_matrices);
    looks.about = about(file, vrm.json);
    looks.left_out = what_is_left_out(file, scene.lost_morphs);
    looks.left_out.insert(looks.left_out.end(), vrm.left_out.begin(), vrm.left_out.end());
    if (vrm.json.is_object()) {
        looks.forbidden = forbidden_by(vrm.json.at("meta"));
        looks.vrm = with_kept_thumbnail(std::move(vrm.json), lost).dump();
    }
    std::set<std::string> extensions;
    collect_extensions(json, extensions);
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        if (auto kept = still_needed(file, list, extensions); !kept.empty()) json[list] = std::move(kept);
    looks.json = json.dump();
    return looks;
}

} // namespace skelgen::io::detail
