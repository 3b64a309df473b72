#include "fbx_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include <Eigen/Geometry>

#include <skelgen/version.hpp>

#include "companion_file.hpp"
#include "fbx_node.hpp"
#include "gltf_data.hpp"
#include "gltf_nodes.hpp"
#include "json_values.hpp"
#include "srgb.hpp"

namespace skelgen::io::detail {
namespace {

using Id = std::int64_t;

std::vector<double> to_list(const Eigen::Matrix4d& matrix) { return {matrix.data(), matrix.data() + matrix.size()}; }

/// Degrees about x, then y, then z.
Eigen::Vector3d euler_degrees(const Eigen::Quaterniond& turn) {
    const Eigen::Matrix3d m = turn.toRotationMatrix();
    const Eigen::Vector3d radians(std::atan2(m(2, 1), m(2, 2)), std::atan2(-m(2, 0), std::hypot(m(2, 1), m(2, 2))),
                                  std::atan2(m(1, 0), m(0, 0)));
    return radians * (180 / std::numbers::pi);
}

/// Of the angles that mean the same those that are nearest to the ones before, so that what is between frames is, too.
Eigen::Vector3d nearest_angles(const Eigen::Vector3d& angles, const Eigen::Vector3d& before) {
    const auto turned_to = [&](Eigen::Vector3d one) {
        for (int axis = 0; axis < 3; ++axis) one[axis] -= 360 * std::round((one[axis] - before[axis]) / 360);
        return one;
    };
    const Eigen::Vector3d one = turned_to(angles),
                          other = turned_to({angles[0] + 180, 180 - angles[1], angles[2] + 180});
    return (one - before).squaredNorm() <= (other - before).squaredNorm() ? one : other;
}

/// Members of an object; materials are as their files have them, and may hold anything.
double number_of(const Json& object, const char* key, double fallback) {
    const bool has = object.is_object() && object.contains(key) && object[key].is_number();
    return has ? object[key].get<double>() : fallback;
}
std::string text_of(const Json& object, const char* key, const std::string& fallback) {
    const bool has = object.is_object() && object.contains(key) && object[key].is_string();
    return has ? object[key].get<std::string>() : fallback;
}
std::optional<std::size_t> index_of(const Json& object, const char* key) {
    const bool has = object.is_object() && object.contains(key) && object[key].is_number_unsigned();
    return has ? std::optional(object[key].get<std::size_t>()) : std::nullopt;
}
Json object_of(const Json& object, const char* key) {
    const bool has = object.is_object() && object.contains(key) && object[key].is_object();
    return has ? object[key] : Json::object();
}
template <std::size_t Count>
std::array<double, Count> colour_of(const Json& object, const char* key, const std::array<double, Count>& fallback) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_array() || object[key].size() != Count)
        return fallback;
    std::array<double, Count> out{};
    for (std::size_t i = 0; i < Count; ++i) {
        if (!object[key][i].is_number()) return fallback;
        out[i] = object[key][i].template get<double>();
    }
    return out;
}

/// The picture that a texture shows; none where it has none.
std::optional<std::size_t> picture_of(const Json& scene, const Json& shown) {
    const auto texture = index_of(shown, "index");
    if (!texture || !scene.contains("textures") || *texture >= scene["textures"].size()) return std::nullopt;
    const Json& one = scene["textures"][*texture];
    std::optional<std::size_t> picture = index_of(one, "source");
    const Json extensions = object_of(one, "extensions");
    for (const auto& [name, extension] : extensions.items())
        if (!picture) picture = index_of(extension, "source");
    if (picture && (!scene.contains("images") || *picture >= scene["images"].size())) return std::nullopt;
    return picture;
}

/// What FBX's materials have of one of glTF.
struct Surface {
    std::array<double, 4> colour{1, 1, 1, 1};
    std::array<double, 3> emission{0, 0, 0};
    double metalness = 1, roughness = 1;
    bool is_transparent = false;
    std::map<std::string, Json> textures; ///< by the property of FBX that has it
};

Surface surface_of(const Json& material) {
    Surface out;
    const Json pbr = object_of(material, "pbrMetallicRoughness");
    const Json glossy = object_of(object_of(material, "extensions"), "KHR_materials_pbrSpecularGlossiness");
    out.colour = colour_of(pbr, "baseColorFactor", colour_of(glossy, "diffuseFactor", out.colour));
    out.emission = colour_of(material, "emissiveFactor", out.emission);
    out.metalness = glossy.empty() ? number_of(pbr, "metallicFactor", 1) : 0;
    out.roughness =
        glossy.empty() ? number_of(pbr, "roughnessFactor", 1) : 1 - number_of(glossy, "glossinessFactor", 1);
    out.is_transparent = text_of(material, "alphaMode", "OPAQUE") != "OPAQUE";
    const auto add = [&](const char* property, const Json& owner, const char* key) {
        if (owner.is_object() && owner.contains(key)) out.textures[property] = owner[key];
    };
    add("DiffuseColor", glossy, "diffuseTexture");
    add("DiffuseColor", pbr, "baseColorTexture");
    add("NormalMap", material, "normalTexture");
    add("EmissiveColor", material, "emissiveTexture");
    if (out.is_transparent && out.textures.contains("DiffuseColor"))
        out.textures["TransparentColor"] = out.textures["DiffuseColor"];
    return out;
}

std::string uv_set_name(std::size_t set) { return set == 0 ? "UVMap" : "UVMap" + std::to_string(set); }

/// A list of rows that corners refer to by their numbers, as texture coordinates.
struct Indexed {
    std::vector<double> values;
    std::vector<std::int32_t> corners;
    std::map<std::size_t, std::int32_t> first; ///< of an accessor's rows the first; 0: of all, for what has none
};

/// A mesh that is being put together from primitives.
struct Geometry {
    std::vector<double> points, normals;
    std::vector<std::int32_t> corners, materials;
    std::vector<Indexed> uv_sets;
    Indexed colours;
    std::vector<std::map<std::int32_t, std::pair<Eigen::Vector3d, Eigen::Vector3d>>> shapes;
    std::vector<std::pair<std::vector<std::int32_t>, std::vector<double>>> clusters; ///< by joint
};

class FbxWriter {
public:
    FbxWriter(std::string_view glb, const FbxOptions& options)
        : options_(&options), file_(open_gltf(glb)), data_(file_, glb.size(), refuse_companion),
          scene_(Json::parse(file_.json.dump())), nodes_(read_nodes(file_).nodes), places_(world_matrices(nodes_)) {
        for (Eigen::Matrix4d& place : places_) place.topRightCorner<3, 1>() *= options.scale;
    }

    std::string write() {
        if (scene_.contains("skins")) joints_ = scene_["skins"][0]["joints"].get<std::vector<std::size_t>>();
        for (const std::size_t node : joints_) add_joint(node);
        for (std::size_t i = 0; i < list("materials").size(); ++i) add_material(list("materials")[i]);
        for (std::size_t node = 0; node < nodes_.size(); ++node)
            if (scene_["nodes"][node].contains("mesh")) add_mesh(node);
        if (!joints_.empty()) add_bind_pose();
        for (std::size_t i = 0; i < list("animations").size(); ++i)
            add_animation(list("animations")[i], options_->seconds_per_frame[i]);
        std::vector<FbxNode> document = head();
        document.push_back(definitions());
        document.push_back(std::move(objects_));
        document.push_back(std::move(connections_));
        document.emplace_back("Takes").child("Current", "");
        return format_fbx_document(document);
    }

private:
    [[nodiscard]] const Json& list(const char* key) const {
        static const Json none = Json::array();
        const auto found = scene_.find(key);
        return found == scene_.end() ? none : *found;
    }
    GltfArray numbers(std::size_t accessor) {
        const GltfValue::Json index = accessor;
        return data_.accessor({index, "accessor"});
    }
    GltfData::RowsInUse rows_in_use(std::size_t accessor) {
        const GltfValue::Json index = accessor;
        return data_.rows_in_use({index, "accessor"}, 3);
    }

    Id new_id() { return next_id_++; }
    FbxNode object(const char* kind, Id id, const std::string& name, const char* type, const char* subtype) {
        ++counts_[kind];
        using namespace std::string_literals;
        return FbxNode(kind, id, name + "\0\1"s + type, subtype);
    }
    void connect(Id child, Id parent) { connections_.child("C", "OO", child, parent); }
    void connect(Id child, Id parent, const std::string& property) {
        connections_.child("C", "OP", child, parent, property);
    }

    template <typename... Values>
    static void set(FbxNode& properties, const std::string& name, const char* type, const char* label,
                    const char* flags, const Values&... values) {
        properties.child("P", name, type, label, flags, values...);
    }
    static void set(FbxNode& properties, const char* name, const char* type, const char* label, const char* flags,
                    const Eigen::Vector3d& v) {
        set(properties, name, type, label, flags, v[0], v[1], v[2]);
    }
    static void set_enum(FbxNode& properties, const char* name, std::int32_t value) {
        set(properties, name, "enum", "", "", value);
    }

    /// A node's name, and its "extras" as properties of the user's.
    FbxNode model(std::size_t node, const char* subtype, FbxNode properties) {
        const Json& json = scene_["nodes"][node];
        const Json extras = json.value("extras", Json::object());
        if (extras.is_object())
            for (const auto& [key, value] : extras.items()) {
                if (value.is_number())
                    set(properties, key, "double", "Number", "AU", value.get<double>());
                else
                    set(properties, key, "KString", "", "AU",
                        value.is_string() ? value.get<std::string>() : value.dump());
            }
        FbxNode out = object("Model", models_[node], json.value("name", ""), "Model", subtype);
        out.child("Version", std::int32_t{232});
        out.append(std::move(properties));
        out.child("Shading", true);
        out.child("Culling", "CullingOff");
        return out;
    }

    void add_joint(std::size_t node) {
        models_[node] = new_id();
        const SceneNode& joint = nodes_[node];
        FbxNode properties("Properties70");
        set_enum(properties, "InheritType", 1);
        // All of it here, none as PreRotation: assimp adds that to animations twice.
        set(properties, "Lcl Rotation", "Lcl Rotation", "", "A", euler_degrees(joint.rotation));
        const Eigen::Vector3d place = options_->scale * joint.translation;
        set(properties, "Lcl Translation", "Lcl Translation", "", "A", place);
        objects_.append(model(node, "LimbNode", std::move(properties)));
        const Id attribute = new_id();
        FbxNode limb = object("NodeAttribute", attribute, "", "NodeAttribute", "LimbNode");
        limb.child("TypeFlags", "Skeleton");
        objects_.append(std::move(limb));
        connect(attribute, models_[node]);
        connect(models_[node], joint.parent < 0 ? 0 : models_[static_cast<std::size_t>(joint.parent)]);
    }

    void add_material(const Json& material) {
        const Surface surface = surface_of(material);
        const auto shown = [](const double* light) {
            return Eigen::Vector3d(shown_light(light[0]), shown_light(light[1]), shown_light(light[2]));
        };
        const auto number = [](FbxNode& properties, const char* name, double value) {
            set(properties, name, "Number", "", "A", value);
        };
        FbxNode properties("Properties70");
        set(properties, "DiffuseColor", "Color", "", "A", shown(surface.colour.data()));
        set(properties, "EmissiveColor", "Color", "", "A", shown(surface.emission.data()));
        set(properties, "TransparentColor", "Color", "", "A", Eigen::Vector3d(1, 1, 1));
        const double alpha = surface.is_transparent ? surface.colour[3] : 1;
        number(properties, "TransparencyFactor", 1 - alpha);
        set(properties, "Opacity", "double", "Number", "", alpha);
        constexpr double sharpest = 10, of_plastics = 0.25; // as Blender has them
        number(properties, "Shininess", std::pow(sharpest * (1 - surface.roughness), 2));
        number(properties, "SpecularFactor", of_plastics);
        number(properties, "ReflectionFactor", surface.metalness);
        materials_.push_back(new_id());
        FbxNode out = object("Material", materials_.back(), text_of(material, "name", "material"), "Material", "");
        out.child("Version", std::int32_t{102});
        out.child("ShadingModel", "phong");
        out.child("MultiLayer", std::int32_t{0});
        out.append(std::move(properties));
        objects_.append(std::move(out));
        for (const auto& [property, texture] : surface.textures)
            if (const auto picture = picture_of(scene_, texture))
                add_texture(materials_.back(), property, *picture, index_of(texture, "texCoord").value_or(0));
    }

    void add_texture(Id material, const std::string& property, std::size_t picture, std::size_t set_number) {
        const Json& image = scene_["images"][picture];
        std::string name = text_of(image, "name", "");
        if (name.empty()) name = "picture" + std::to_string(picture);
        const std::string type = text_of(image, "mimeType", "image/png");
        const std::string file = name + "." + (type == "image/jpeg" ? "jpg" : type.substr(type.find('/') + 1));
        const auto [video, is_new] = videos_.emplace(picture, 0);
        if (is_new) {
            video->second = new_id();
            FbxNode out = object("Video", video->second, name, "Video", "Clip");
            out.child("Type", "Clip");
            out.child("UseMipMap", std::int32_t{0});
            out.child("Filename", file);
            out.child("RelativeFilename", file);
            const GltfValue::Json view = image.at("bufferView").get<std::size_t>();
            out.child("Content").add_bytes(data_.view({view, "bufferView"}));
            objects_.append(std::move(out));
        }
        const Id id = new_id();
        FbxNode out = object("Texture", id, name, "Texture", "");
        out.child("Type", "TextureVideoClip");
        out.child("Version", std::int32_t{202});
        out.child("TextureName", name);
        FbxNode properties("Properties70");
        set(properties, "UVSet", "KString", "", "", uv_set_name(set_number));
        set(properties, "UseMaterial", "bool", "", "", std::int32_t{1});
        out.append(std::move(properties));
        out.child("Media", name);
        out.child("FileName", file);
        out.child("RelativeFilename", file);
        objects_.append(std::move(out));
        connect(id, material, property);
        connect(video->second, id);
    }

    /// The rows of an accessor, once each, and a number of its first one. No accessor: one row of `fill`.
    std::int32_t first_row(Indexed& list, std::optional<std::size_t> accessor, const std::vector<double>& fill,
                           const auto& change) {
        const auto [place, is_new] = list.first.emplace(accessor ? *accessor + 1 : 0, 0);
        if (!is_new) return place->second;
        place->second = static_cast<std::int32_t>(list.values.size() / fill.size());
        std::vector<double> values = accessor ? numbers(*accessor).values : fill;
        change(values);
        list.values.insert(list.values.end(), values.begin(), values.end());
        return place->second;
    }

    /// How many control points there are of this many vertices of a primitive.
    [[nodiscard]] std::size_t without_copies(std::size_t vertices) const { return vertices - options_->copies.size(); }

    /// Places, weights and morphs of a primitive's vertices; \returns the number of its first one.
    std::int32_t add_vertices(Geometry& geometry, const Json& primitive) {
        const Json& attributes = primitive["attributes"];
        const GltfArray positions = numbers(attributes["POSITION"]);
        const std::size_t count = without_copies(positions.rows);
        const auto base = static_cast<std::int32_t>(geometry.points.size() / 3);
        for (std::size_t i = 0; i < 3 * count; ++i) geometry.points.push_back(options_->scale * positions.values[i]);
        if (attributes.contains("JOINTS_0") && !joints_.empty()) {
            const GltfArray joints = numbers(attributes["JOINTS_0"]), weights = numbers(attributes["WEIGHTS_0"]);
            for (std::size_t v = 0; v < count; ++v)
                for (std::size_t k = 0; k < 4; ++k)
                    if (weights.row(v)[k] > 0) {
                        auto& [points, values] = geometry.clusters[static_cast<std::size_t>(joints.row(v)[k])];
                        points.push_back(base + static_cast<std::int32_t>(v));
                        values.push_back(weights.row(v)[k]);
                    }
        }
        const Json targets = primitive.value("targets", Json::array());
        geometry.shapes.resize(std::max(geometry.shapes.size(), targets.size()));
        for (std::size_t t = 0; t < targets.size(); ++t)
            for (const auto& [key, is_normal] : {std::pair("POSITION", false), std::pair("NORMAL", true)}) {
                if (!targets[t].contains(key)) continue;
                const GltfData::RowsInUse offsets = rows_in_use(targets[t][key]);
                for (std::size_t i = 0; i < offsets.places.size(); ++i) {
                    if (offsets.places[i] >= count) continue;
                    const auto [place, is_new] =
                        geometry.shapes[t].try_emplace(base + static_cast<std::int32_t>(offsets.places[i]),
                                                       Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
                    const Eigen::Map<const Eigen::Vector3d> offset(offsets.rows.row(i));
                    (is_normal ? place->second.second : place->second.first) = offset;
                }
            }
        return base;
    }

    Geometry geometry_of(const Json& primitives) {
        Geometry geometry;
        geometry.clusters.resize(joints_.size());
        std::size_t sets = 0;
        bool has_colours = false, has_materials = false;
        for (const Json& primitive : primitives) {
            const Json& attributes = primitive["attributes"];
            while (attributes.contains("TEXCOORD_" + std::to_string(sets))) ++sets;
            has_colours = has_colours || attributes.contains("COLOR_0");
            has_materials = has_materials || primitive.contains("material");
        }
        geometry.uv_sets.resize(sets);
        std::map<std::size_t, std::int32_t> bases; // by the accessor of the positions
        std::map<std::size_t, std::int32_t> used;  // materials of this mesh, in the order of their use
        for (const Json& primitive : primitives) {
            const Json& attributes = primitive["attributes"];
            const std::size_t positions = attributes["POSITION"];
            if (!bases.contains(positions)) bases[positions] = add_vertices(geometry, primitive);
            const auto accessor = [&](const std::string& name) {
                return attributes.contains(name) ? std::optional(attributes[name].get<std::size_t>()) : std::nullopt;
            };
            std::vector<std::pair<Indexed*, std::int32_t>> lists;
            for (std::size_t set = 0; set < sets; ++set)
                lists.emplace_back(&geometry.uv_sets[set],
                                   first_row(geometry.uv_sets[set], accessor("TEXCOORD_" + std::to_string(set)), {0, 0},
                                             [](std::vector<double>& uv) {
                                                 for (std::size_t i = 1; i < uv.size(); i += 2) uv[i] = 1 - uv[i];
                                             }));
            if (has_colours)
                lists.emplace_back(&geometry.colours, first_row(geometry.colours, accessor("COLOR_0"), {1, 1, 1, 1},
                                                                [](std::vector<double>& colours) {
                                                                    for (std::size_t i = 0; i < colours.size(); ++i)
                                                                        if (i % 4 < 3)
                                                                            colours[i] = shown_light(colours[i]);
                                                                }));
            std::vector<bool> is_own; // per list, whether the primitive has rows of its own there
            for (std::size_t set = 0; set < sets; ++set)
                is_own.push_back(accessor("TEXCOORD_" + std::to_string(set)).has_value());
            is_own.push_back(accessor("COLOR_0").has_value());
            const GltfArray normals = numbers(attributes["NORMAL"]), corners = numbers(primitive["indices"]);
            const std::size_t points = without_copies(normals.rows);
            for (std::size_t i = 0; i < corners.rows; ++i) {
                const auto vertex = static_cast<std::size_t>(corners.values[i]);
                const std::int32_t point = bases[positions] + (vertex < points ? static_cast<std::int32_t>(vertex)
                                                                               : options_->copies[vertex - points]);
                geometry.corners.push_back(i % 3 == 2 ? -1 - point : point); // so the last of a polygon is marked
                geometry.normals.insert(geometry.normals.end(), normals.row(vertex), normals.row(vertex) + 3);
                for (std::size_t l = 0; l < lists.size(); ++l)
                    lists[l].first->corners.push_back(lists[l].second +
                                                      (is_own[l] ? static_cast<std::int32_t>(vertex) : 0));
            }
            if (!has_materials) continue;
            const std::size_t material = primitive.value("material", plain_material);
            const auto number = used.emplace(material, static_cast<std::int32_t>(used.size())).first->second;
            if (static_cast<std::size_t>(number) == used_materials_.size()) used_materials_.push_back(material);
            geometry.materials.insert(geometry.materials.end(), corners.rows / 3, number);
        }
        return geometry;
    }

    static FbxNode layer_element(const char* kind, std::size_t number, const std::string& name, const char* mapping,
                                 const char* reference) {
        FbxNode out(kind, static_cast<std::int32_t>(number));
        out.child("Version", std::int32_t{101});
        out.child("Name", name);
        out.child("MappingInformationType", mapping);
        out.child("ReferenceInformationType", reference);
        return out;
    }

    void add_mesh(std::size_t node) {
        const Json& mesh = scene_["meshes"][scene_["nodes"][node]["mesh"].get<std::size_t>()];
        const std::string name = mesh.value("name", "mesh");
        used_materials_.clear();
        const Geometry geometry = geometry_of(mesh["primitives"]);
        models_[node] = new_id();
        FbxNode properties("Properties70");
        set_enum(properties, "InheritType", 1);
        objects_.append(model(node, "Mesh", std::move(properties)));
        connect(models_[node], 0);
        meshes_.push_back(node);
        for (const std::size_t material : used_materials_) {
            if (material == plain_material && material_of_none_ == 0) {
                add_material(Json::object());
                material_of_none_ = materials_.back();
                materials_.pop_back();
            }
            connect(material == plain_material ? material_of_none_ : materials_[material], models_[node]);
        }

        const Id id = new_id();
        FbxNode out = object("Geometry", id, name, "Geometry", "Mesh");
        out.child("GeometryVersion", std::int32_t{124});
        out.child("Vertices", geometry.points);
        out.child("PolygonVertexIndex", geometry.corners);
        constexpr const char* by_corner = "ByPolygonVertex";
        std::vector<FbxNode> layers;
        const auto add_layer = [&](const char* kind, std::size_t number, FbxNode element) {
            if (layers.size() <= number) {
                layers.emplace_back("Layer", static_cast<std::int32_t>(layers.size()));
                layers.back().child("Version", std::int32_t{100});
            }
            FbxNode& entry = layers[number].child("LayerElement");
            entry.child("Type", kind);
            entry.child("TypedIndex", static_cast<std::int32_t>(number));
            out.append(std::move(element));
        };
        FbxNode normals = layer_element("LayerElementNormal", 0, "", by_corner, "Direct");
        normals.child("Normals", geometry.normals);
        add_layer("LayerElementNormal", 0, std::move(normals));
        if (!geometry.colours.values.empty()) {
            FbxNode colours = layer_element("LayerElementColor", 0, "Col", by_corner, "IndexToDirect");
            colours.child("Colors", geometry.colours.values);
            colours.child("ColorIndex", geometry.colours.corners);
            add_layer("LayerElementColor", 0, std::move(colours));
        }
        if (!geometry.materials.empty()) {
            FbxNode materials = layer_element("LayerElementMaterial", 0, "", "ByPolygon", "IndexToDirect");
            materials.child("Materials", geometry.materials);
            add_layer("LayerElementMaterial", 0, std::move(materials));
        }
        for (std::size_t i = 0; i < geometry.uv_sets.size(); ++i) {
            FbxNode uv = layer_element("LayerElementUV", i, uv_set_name(i), by_corner, "IndexToDirect");
            uv.child("UV", geometry.uv_sets[i].values);
            uv.child("UVIndex", geometry.uv_sets[i].corners);
            add_layer("LayerElementUV", i, std::move(uv));
        }
        for (FbxNode& layer : layers) out.append(std::move(layer));
        objects_.append(std::move(out));
        connect(id, models_[node]);
        if (!joints_.empty()) add_skin(id, name, geometry);
        if (!geometry.shapes.empty()) add_shapes(id, mesh, geometry);
    }

    void add_skin(Id geometry, const std::string& name, const Geometry& of) {
        const Id skin = new_id();
        FbxNode out = object("Deformer", skin, name, "Deformer", "Skin");
        out.child("Version", std::int32_t{101});
        out.child("Link_DeformAcuracy", 50.0); // so it is spelt
        objects_.append(std::move(out));
        connect(skin, geometry);
        for (std::size_t j = 0; j < joints_.size(); ++j) {
            const Id cluster = new_id();
            const auto& [points, weights] = of.clusters[j];
            FbxNode one =
                object("Deformer", cluster, scene_["nodes"][joints_[j]].value("name", ""), "SubDeformer", "Cluster");
            one.child("Version", std::int32_t{100});
            one.child("UserData", "", "");
            if (!points.empty()) {
                one.child("Indexes", points);
                one.child("Weights", weights);
            }
            one.child("Transform", to_list(places_[joints_[j]].inverse()));
            one.child("TransformLink", to_list(places_[joints_[j]]));
            objects_.append(std::move(one));
            connect(cluster, skin);
            connect(models_[joints_[j]], cluster);
        }
    }

    void add_shapes(Id geometry, const Json& mesh, const Geometry& of) {
        const Json extras = object_of(mesh, "extras");
        const Json names = extras.contains("targetNames") ? extras["targetNames"] : Json::array();
        const Json weights = mesh.value("weights", Json::array());
        const Id blend = new_id();
        FbxNode deformer = object("Deformer", blend, mesh.value("name", "mesh"), "Deformer", "BlendShape");
        deformer.child("Version", std::int32_t{100});
        objects_.append(std::move(deformer));
        connect(blend, geometry);
        for (std::size_t i = 0; i < of.shapes.size(); ++i) {
            const std::string name = names.is_array() && i < names.size() && names[i].is_string()
                                         ? names[i].get<std::string>()
                                         : "morph" + std::to_string(i);
            constexpr double full = 100;
            const double weight = full * (i < weights.size() ? weights[i].get<double>() : 0);
            const Id channel = new_id(), shape = new_id();
            FbxNode one = object("Deformer", channel, name, "SubDeformer", "BlendShapeChannel");
            one.child("Version", std::int32_t{100});
            one.child("DeformPercent", weight);
            FbxNode properties("Properties70");
            set(properties, "DeformPercent", "Number", "", "A", weight);
            one.append(std::move(properties));
            one.child("FullWeights", std::vector<double>{full});
            objects_.append(std::move(one));
            std::vector<std::int32_t> points;
            std::vector<double> offsets, normals;
            // Blender before 4 reads no file that has a shape without points: one stays where it is.
            auto moved = of.shapes[i];
            if (moved.empty()) moved.try_emplace(0, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
            for (const auto& [point, offset] : moved) {
                points.push_back(point);
                for (int axis = 0; axis < 3; ++axis) {
                    offsets.push_back(options_->scale * offset.first[axis]);
                    normals.push_back(offset.second[axis]);
                }
            }
            FbxNode out = object("Geometry", shape, name, "Geometry", "Shape");
            out.child("Version", std::int32_t{100});
            out.child("Indexes", points);
            out.child("Vertices", offsets);
            out.child("Normals", normals);
            objects_.append(std::move(out));
            connect(channel, blend);
            connect(shape, channel);
        }
    }

    void add_bind_pose() {
        FbxNode out = object("Pose", new_id(), "BindPose", "Pose", "BindPose");
        out.child("Type", "BindPose");
        out.child("Version", std::int32_t{100});
        out.child("NbPoseNodes", static_cast<std::int32_t>(meshes_.size() + joints_.size()));
        const auto add = [&](std::size_t node) {
            FbxNode& one = out.child("PoseNode");
            one.child("Node", models_[node]);
            one.child("Matrix", to_list(places_[node]));
        };
        for (const std::size_t node : meshes_) add(node);
        for (const std::size_t node : joints_) add(node);
        objects_.append(std::move(out));
    }

    void add_animation(const Json& animation, double seconds_per_frame) {
        const std::string name = animation.value("name", "animation");
        const Id stack = new_id(), layer = new_id();
        const Json& first = animation["samplers"][0];
        std::vector<Id> times;
        for (std::size_t i = 0; i < numbers(first["input"]).rows; ++i)
            times.push_back(std::llround(static_cast<double>(i) * seconds_per_frame * ticks_per_second));
        FbxNode out = object("AnimationStack", stack, name, "AnimStack", "");
        FbxNode properties("Properties70");
        for (const char* end : {"LocalStop", "ReferenceStop"}) set(properties, end, "KTime", "Time", "", times.back());
        out.append(std::move(properties));
        objects_.append(std::move(out));
        FbxNode one = object("AnimationLayer", layer, name, "AnimLayer", "");
        one.append(FbxNode("Properties70"));
        objects_.append(std::move(one));
        connect(layer, stack);
        last_time_ = std::max(last_time_, times.back());
        frames_per_second_ = 1 / seconds_per_frame;
        for (const Json& channel : animation["channels"]) {
            const std::size_t node = channel["target"]["node"];
            const GltfArray values = numbers(animation["samplers"][channel["sampler"].get<std::size_t>()]["output"]);
            const bool is_turn = channel["target"]["path"] == "rotation";
            std::array<std::vector<float>, 3> curves;
            Eigen::Vector3d last = is_turn ? euler_degrees(nodes_[node].rotation) : Eigen::Vector3d(0, 0, 0);
            for (std::size_t i = 0; i < values.rows; ++i) {
                const double* row = values.row(i);
                if (is_turn) {
                    const Eigen::Quaterniond turn(row[3], row[0], row[1], row[2]);
                    last = nearest_angles(euler_degrees(turn.normalized()), last);
                } else {
                    last = options_->scale * Eigen::Vector3d(row[0], row[1], row[2]);
                }
                for (std::size_t axis = 0; axis < 3; ++axis)
                    curves[axis].push_back(static_cast<float>(last[static_cast<int>(axis)]));
            }
            add_curves(layer, models_[node], is_turn ? "Lcl Rotation" : "Lcl Translation", is_turn ? "R" : "T", times,
                       curves);
        }
    }

    void add_curves(Id layer, Id model, const char* property, const char* name, const std::vector<Id>& times,
                    const std::array<std::vector<float>, 3>& curves) {
        const Id node = new_id();
        FbxNode out = object("AnimationCurveNode", node, name, "AnimCurveNode", "");
        FbxNode properties("Properties70");
        constexpr std::array<const char*, 3> channels{"d|X", "d|Y", "d|Z"};
        for (std::size_t axis = 0; axis < 3; ++axis)
            set(properties, channels[axis], "Number", "", "A", static_cast<double>(curves[axis].front()));
        out.append(std::move(properties));
        objects_.append(std::move(out));
        connect(node, layer);
        connect(node, model, property);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            constexpr std::int32_t linear = 4;
            const Id curve = new_id();
            FbxNode one = object("AnimationCurve", curve, "", "AnimCurve", "");
            one.child("Default", static_cast<double>(curves[axis].front()));
            one.child("KeyVer", std::int32_t{4008});
            one.child("KeyTime", times);
            one.child("KeyValueFloat", curves[axis]);
            one.child("KeyAttrFlags", std::vector<std::int32_t>{linear});
            one.child("KeyAttrDataFloat", std::vector<float>(4, 0.0F));
            one.child("KeyAttrRefCount", std::vector<std::int32_t>{static_cast<std::int32_t>(times.size())});
            objects_.append(std::move(one));
            connect(curve, node, channels[axis]);
        }
    }

    [[nodiscard]] std::vector<FbxNode> head() const {
        using namespace std::string_literals;
        const std::string creator = "skelgen " + std::string(version);
        const Json& asset = scene_["asset"];
        const Json extras = object_of(asset, "extras");
        const auto said = [&](const char* key) { return text_of(extras, key, ""); };
        std::vector<FbxNode> out;
        FbxNode& extension = out.emplace_back("FBXHeaderExtension");
        extension.child("FBXHeaderVersion", std::int32_t{1003});
        extension.child("FBXVersion", std::int32_t{7400});
        extension.child("EncryptionType", std::int32_t{0});
        extension.child("Creator", creator);
        FbxNode& info = extension.child("SceneInfo", "GlobalInfo\0\1SceneInfo"s, "UserData");
        info.child("Type", "UserData");
        info.child("Version", std::int32_t{100});
        FbxNode& meta = info.child("MetaData");
        meta.child("Version", std::int32_t{100});
        meta.child("Title", said("title"));
        meta.child("Author", said("author").empty() ? text_of(asset, "copyright", "") : said("author"));
        meta.child("Comment", said("license"));
        out.emplace_back("FileId").add_bytes(fbx_file_id());
        out.emplace_back("CreationTime", fbx_creation_time);
        out.emplace_back("Creator", creator);
        FbxNode& settings = out.emplace_back("GlobalSettings");
        settings.child("Version", std::int32_t{1000});
        FbxNode& properties = settings.child("Properties70");
        // +y up, facing +z, +x to the left of the one who faces so.
        for (const auto& [name, value] :
             {std::pair("UpAxis", 1), std::pair("UpAxisSign", 1), std::pair("FrontAxis", 2),
              std::pair("FrontAxisSign", 1), std::pair("CoordAxis", 0), std::pair("CoordAxisSign", 1),
              std::pair("OriginalUpAxis", 1), std::pair("OriginalUpAxisSign", 1)})
            set(properties, name, "int", "Integer", "", std::int32_t{value});
        for (const char* name : {"UnitScaleFactor", "OriginalUnitScaleFactor"})
            set(properties, name, "double", "Number", "", options_->centimetres_per_unit);
        constexpr std::int32_t custom_rate = 14;
        set_enum(properties, "TimeMode", custom_rate);
        set(properties, "TimeSpanStart", "KTime", "Time", "", Id{0});
        set(properties, "TimeSpanStop", "KTime", "Time", "", last_time_);
        set(properties, "CustomFrameRate", "double", "Number", "", frames_per_second_);
        FbxNode& documents = out.emplace_back("Documents");
        documents.child("Count", std::int32_t{1});
        FbxNode& document = documents.child("Document", document_id, "", "Scene");
        document.child("RootNode", Id{0});
        out.emplace_back("References");
        return out;
    }

    [[nodiscard]] FbxNode definitions() const {
        FbxNode out("Definitions");
        out.child("Version", std::int32_t{100});
        std::int32_t all = 1;
        for (const auto& [kind, count] : counts_) all += count;
        out.child("Count", all);
        out.child("ObjectType", "GlobalSettings").child("Count", std::int32_t{1});
        for (const auto& [kind, count] : counts_) out.child("ObjectType", kind).child("Count", count);
        return out;
    }

    static constexpr double ticks_per_second = 46186158000;
    static constexpr std::size_t plain_material = static_cast<std::size_t>(-1); ///< of faces that have none
    static constexpr Id document_id = 1;

    const FbxOptions* options_;
    GltfFile file_;
    GltfData data_;
    Json scene_;
    std::vector<SceneNode> nodes_;
    std::vector<Eigen::Matrix4d> places_;
    std::vector<std::size_t> joints_, meshes_; ///< their nodes
    std::map<std::size_t, Id> models_;         ///< by node
    std::vector<Id> materials_;
    Id material_of_none_ = 0;
    std::vector<std::size_t> used_materials_; ///< of the mesh that is being written
    std::map<std::size_t, Id> videos_;        ///< by picture
    std::map<std::string, std::int32_t> counts_;
    Id next_id_ = document_id + 1, last_time_ = 0;
    double frames_per_second_ = 30;
    FbxNode objects_{"Objects"}, connections_{"Connections"};
};

} // namespace

std::string glb_to_fbx(std::string_view glb, const FbxOptions& options) { return FbxWriter(glb, options).write(); }

std::size_t pictures_lost_in_fbx(const std::string& looks_json) {
    const Json looks = parse_json(looks_json);
    std::set<std::size_t> kept;
    for (const Json& material : looks.value("materials", Json::array()))
        for (const auto& [property, texture] : surface_of(material).textures)
            if (const auto picture = picture_of(looks, texture)) kept.insert(*picture);
    return looks.value("images", Json::array()).size() - kept.size();
}

} // namespace skelgen::io::detail
