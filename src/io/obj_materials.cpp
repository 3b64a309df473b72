#include "obj_materials.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_file.hpp>

#include "json_values.hpp"
#include "mtl_parser.hpp"
#include "picture_kind.hpp"

namespace skelgen::io::detail {
namespace {

namespace fs = std::filesystem;

/// A material and the folder of its file, relative to the OBJ's; empty: the same.
struct PlacedMaterial {
    MtlMaterial material;
    std::string folder;
};

/// Finds the files of an OBJ, and adds to the looks what they hold.
class MaterialReader {
public:
    MaterialReader(SceneLooks looks, const LoadCompanion& load) : looks_(std::move(looks)), load_(&load) {}

    SceneLooks read(const ObjFile& file) {
        for (const std::string& library : file.libraries) read_library(library);
        const bool has_all_files = looks_.lost_materials.empty();
        has_coordinates_ = !file.texture_coordinates.empty();
        Json json = Json::object();
        for (const std::string& name : file.materials) {
            const auto known = by_name_.find(name);
            const bool is_missing = known == by_name_.end();
            if (is_missing && has_all_files && !name.empty() && name != "(null)") // as writers say none
                looks_.lost_materials.push_back(
                    valid_utf8("no file that the mesh names has the material '" + name + "'"));
            json["materials"].push_back(describe(is_missing ? PlacedMaterial{{name}, ""} : known->second));
        }
        for (auto* list : {&textures_, &images_})
            if (!list->empty()) json[list == &textures_ ? "textures" : "images"] = std::move(*list);
        looks_.json = json.dump();
        return std::move(looks_);
    }

private:
    /// The first of these files that there is. \throws Error bad_input, why the first one cannot be read, when none
    /// can.
    std::string load_first(const std::vector<std::string>& references) {
        std::optional<Error> why;
        for (const std::string& reference : references) {
            try {
                std::string content = (*load_)(reference);
                if (content.size() > bytes_left_)
                    throw Error(ErrorCode::bad_input, "the files beside the mesh are too large, together");
                bytes_left_ -= content.size();
                return content;
            } catch (const Error& error) {
                if (error.code() != ErrorCode::bad_input) throw;
                if (!why) why = error;
            }
        }
        throw Error(why.value());
    }

    /// What is behind one mtllib: a name, which may have blanks, or several names.
    void read_library(const std::string& line) {
        constexpr std::size_t most = 1000; // each may be the same large file
        if (line.empty() || ++libraries_ > most) return;
        std::string failure;
        if (read_library_file(line, failure)) return;
        std::vector<std::string> names;
        for (std::size_t at = 0; at < line.size() && names.size() < most;) {
            const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
            if (end > at) names.push_back(line.substr(at, end - at));
            at = end + 1;
        }
        std::vector<std::string> failures;
        for (const std::string& name : names)
            if (std::string why; names.size() > 1 && !read_library_file(name, why)) failures.push_back(why);
        if (names.size() <= 1 || failures.size() == names.size()) failures = {failure}; // it was one name
        for (const std::string& why : failures) looks_.lost_materials.push_back(valid_utf8(why));
    }

    bool read_library_file(std::string name, std::string& failure) {
        std::replace(name.begin(), name.end(), '\\', '/');
        try {
            for (MtlMaterial& material : parse_mtl(load_first({name}))) {
                std::string key = material.name;
                by_name_.emplace(std::move(key),
                                 PlacedMaterial{std::move(material), fs::path(name).parent_path().string()});
            }
            return true;
        } catch (const Error& error) {
            if (error.code() != ErrorCode::bad_input) throw;
            failure = error.what();
            return false;
        }
    }

    Json describe(const PlacedMaterial& placed) {
        const MtlMaterial& material = placed.material;
        Json surface{{"metallicFactor", material.metalness}, {"roughnessFactor", material.roughness.value_or(1)}};
        std::array<double, 4> colour{1, 1, 1, material.opacity};
        const bool has_picture = has_coordinates_ && !material.colour_map.empty();
        const auto texture = has_picture ? texture_of(material.colour_map, placed.folder) : std::nullopt;
        if (texture) // Kd would darken it: programs leave there what they have
            surface["baseColorTexture"] = {{"index", *texture}};
        else if (material.colour)
            std::copy(material.colour->begin(), material.colour->end(), colour.begin());
        if (colour != std::array<double, 4>{1, 1, 1, 1}) surface["baseColorFactor"] = colour;
        Json json{{"name", valid_utf8(material.name)}, {"pbrMetallicRoughness", std::move(surface)}};
        const bool is_cut_out = texture && material.opacity_map == material.colour_map;
        if (material.opacity < 1 || is_cut_out) json["alphaMode"] = "BLEND";
        json["doubleSided"] = true; // OBJ knows no faces that are seen from one side alone
        return json;
    }

    /// The number of the texture with this picture; none where it cannot be read.
    std::optional<std::size_t> texture_of(const std::string& name, const std::string& folder) {
        const auto [known, is_new] = texture_numbers_.emplace(std::pair(name, folder), std::nullopt);
        if (!is_new) return known->second;
        try {
            const std::string bare = fs::path(name).filename().string();
            std::string picture =
                load_first({(fs::path(folder) / name).string(), name, (fs::path(folder) / bare).string(), bare});
            const auto kind = picture_kind(picture);
            if (kind != "image/png" && kind != "image/jpeg")
                throw Error(ErrorCode::bad_input,
                            "the picture '" + name + "' is neither PNG nor JPEG; convert it, and name that file");
            images_.push_back({{"mimeType", *kind}});
            textures_.push_back({{"source", looks_.pictures.size()}});
            known->second = looks_.pictures.size();
            looks_.pictures.push_back(std::move(picture));
        } catch (const Error& error) {
            if (error.code() != ErrorCode::bad_input) throw;
            looks_.lost_pictures.push_back(valid_utf8(error.what()));
        }
        return known->second;
    }

    SceneLooks looks_;
    const LoadCompanion* load_;
    std::size_t bytes_left_ = max_file_bytes;
    std::size_t libraries_ = 0;
    bool has_coordinates_ = false; ///< of textures: no picture is shown without
    std::map<std::string, PlacedMaterial> by_name_;
    std::map<std::pair<std::string, std::string>, std::optional<std::size_t>> texture_numbers_; ///< by name and folder
    Json textures_ = Json::array(), images_ = Json::array();
};

} // namespace

SceneLooks with_obj_materials(SceneLooks looks, const ObjFile& file, const LoadCompanion& load) {
    return MaterialReader(std::move(looks), load).read(file);
}

} // namespace skelgen::io::detail
