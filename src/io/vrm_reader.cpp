#include "vrm_reader.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "scene_pose.hpp"
#include "srgb.hpp"

namespace skelgen::io::detail {
namespace {

using Json = GltfValue::Json;
using Names = std::pair<const char*, const char*>; ///< VRM 0.x's and VRM 1.0's

/// A member of that type; null where there is none.
const Json& member(const Json& object, const char* key, Json::value_t type) {
    static const Json none;
    if (!object.is_object()) return none;
    const auto found = object.find(key);
    return found != object.end() && found->type() == type ? *found : none;
}
const Json& list(const Json& object, const char* key) { return member(object, key, Json::value_t::array); }
const Json& object_in(const Json& object, const char* key) { return member(object, key, Json::value_t::object); }
std::string text(const Json& object, const char* key) {
    const Json& found = member(object, key, Json::value_t::string);
    return found.is_string() ? found.get<std::string>() : "";
}
std::optional<double> number(const Json& object, const char* key) {
    if (!object.is_object()) return std::nullopt;
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}
/// A whole number below `count`.
std::optional<std::size_t> index(const Json& value, std::size_t count) {
    if (!value.is_number_unsigned() || value.get<std::size_t>() >= count) return std::nullopt;
    return value.get<std::size_t>();
}
std::optional<std::size_t> index(const Json& object, const char* key, std::size_t count) {
    if (!object.is_object() || !object.contains(key)) return std::nullopt;
    return index(object.at(key), count);
}

template <std::size_t Count>
std::string translated(const std::array<Names, Count>& names, std::string_view old) {
    for (const auto& [from, to] : names)
        if (old == from) return to;
    return "";
}

constexpr std::array<Names, 18> presets{{{"joy", "happy"},
                                         {"angry", "angry"},
                                         {"sorrow", "sad"},
                                         {"fun", "relaxed"},
                                         {"surprised", "surprised"},
                                         {"a", "aa"},
                                         {"i", "ih"},
                                         {"u", "ou"},
                                         {"e", "ee"},
                                         {"o", "oh"},
                                         {"blink", "blink"},
                                         {"blink_l", "blinkLeft"},
                                         {"blink_r", "blinkRight"},
                                         {"lookup", "lookUp"},
                                         {"lookdown", "lookDown"},
                                         {"lookleft", "lookLeft"},
                                         {"lookright", "lookRight"},
                                         {"neutral", "neutral"}}};

constexpr std::array<Names, 5> colours{{{"_Color", "color"},
                                        {"_EmissionColor", "emissionColor"},
                                        {"_ShadeColor", "shadeColor"},
                                        {"_RimColor", "rimColor"},
                                        {"_OutlineColor", "outlineColor"}}};

/// Whom VRM 0.x allows to perform, and what its licences are.
constexpr std::array<Names, 3> permissions{{{"OnlyAuthor", "onlyAuthor"},
                                            {"ExplicitlyLicensedPerson", "onlySeparatelyLicensedPerson"},
                                            {"Everyone", "everyone"}}};

struct Licence {
    const char *name, *url;
    bool needs_credit, may_be_passed_on, may_be_changed, for_profit;
};
constexpr std::array<Licence, 8> licences{
    {{"CC0", "https://creativecommons.org/publicdomain/zero/1.0/", false, true, true, true},
     {"CC_BY", "https://creativecommons.org/licenses/by/4.0/", true, true, true, true},
     {"CC_BY_NC", "https://creativecommons.org/licenses/by-nc/4.0/", true, true, true, false},
     {"CC_BY_SA", "https://creativecommons.org/licenses/by-sa/4.0/", true, true, true, true},
     {"CC_BY_NC_SA", "https://creativecommons.org/licenses/by-nc-sa/4.0/", true, true, true, false},
     {"CC_BY_ND", "https://creativecommons.org/licenses/by-nd/4.0/", true, true, false, true},
     {"CC_BY_NC_ND", "https://creativecommons.org/licenses/by-nc-nd/4.0/", true, true, false, false},
     {"Redistribution_Prohibited", "", true, false, false, true}}};

Json meta_from_0(const Json& old, const GltfFile& file) {
    Json meta = Json::object();
    constexpr std::array<Names, 4> texts{{{"title", "name"},
                                          {"version", "version"},
                                          {"contactInformation", "contactInformation"},
                                          {"otherLicenseUrl", "otherLicenseUrl"}}};
    for (const auto& [from, to] : texts)
        if (const std::string value = text(old, from); !value.empty()) meta[to] = value;
    if (const std::string author = text(old, "author"); !author.empty()) meta["authors"] = {author};
    if (const std::string reference = text(old, "reference"); !reference.empty()) meta["references"] = {reference};
    if (const std::string terms = text(old, "otherPermissionUrl"); !terms.empty())
        meta["thirdPartyLicenses"] = terms; // VRM 1.0 has no other place for further terms
    if (const auto texture = index(old, "texture", file.count("textures")))
        if (const auto source = index(file.json.at("textures")[*texture], "source", file.count("images")))
            meta["thumbnailImage"] = *source;
    if (const std::string who = translated(permissions, text(old, "allowedUserName")); !who.empty())
        meta["avatarPermission"] = who;
    const auto allows = [&](const char* key) { return text(old, key) == "Allow"; };
    meta["allowExcessivelyViolentUsage"] = allows("violentUssageName"); // as VRM 0.x spells it
    meta["allowExcessivelySexualUsage"] = allows("sexualUssageName");
    bool for_profit = allows("commercialUssageName");
    for (const Licence& licence : licences) {
        if (text(old, "licenseName") != licence.name) continue;
        meta["creditNotation"] = licence.needs_credit ? "required" : "unnecessary";
        meta["allowRedistribution"] = licence.may_be_passed_on;
        meta["modification"] = licence.may_be_changed ? "allowModificationRedistribution" : "prohibited";
        for_profit = for_profit && licence.for_profit;
        if (*licence.url != '\0' && !meta.contains("otherLicenseUrl")) meta["otherLicenseUrl"] = licence.url;
    }
    meta["commercialUsage"] = for_profit ? "personalProfit" : "personalNonProfit";
    return meta;
}

/// A value that a material gets; none where VRM 1.0 knows none like that.
void add_material_bind(Json& expression, const Json& value, const GltfFile& file) {
    const std::string property = text(value, "propertyName"), name = text(value, "materialName");
    const Json& target = list(value, "targetValue");
    std::vector<double> numbers;
    for (const Json& one : target)
        if (one.is_number()) numbers.push_back(one.get<double>());
    if (numbers.size() != 4) return;
    for (std::size_t i = 0; i < file.count("materials"); ++i) {
        if (text(file.json.at("materials")[i], "name") != name) continue;
        if (const std::string colour = translated(colours, property); !colour.empty())
            expression["materialColorBinds"].push_back(
                {{"material", i},
                 {"type", colour},
                 {"targetValue", // shown in VRM 0.x, linear in VRM 1.0
                  {linear_light(numbers[0]), linear_light(numbers[1]), linear_light(numbers[2]), numbers[3]}}});
        else if (property == "_MainTex_ST") // scale and offset, the latter from below
            expression["textureTransformBinds"].push_back({{"material", i},
                                                           {"scale", {numbers[0], numbers[1]}},
                                                           {"offset", {numbers[2], 1 - numbers[3] - numbers[1]}}});
        return;
    }
}

Json expressions_from_0(const Json& groups, const GltfFile& file, const std::vector<SceneObject>& objects) {
    Json out = Json::object();
    for (const Json& group : groups) {
        Json expression = Json::object();
        const Json& is_binary = member(group, "isBinary", Json::value_t::boolean);
        if (is_binary.is_boolean()) expression["isBinary"] = is_binary;
        for (const Json& bind : list(group, "binds"))
            for (const SceneObject& object : objects) {
                const auto mesh = index(bind, "mesh", file.count("meshes"));
                const auto target = index(bind, "index", object.morphs.size());
                constexpr double percent = 0.01;
                if (mesh == object.mesh && target)
                    expression["morphTargetBinds"].push_back(
                        {{"node", object.node},
                         {"index", *target},
                         {"weight", std::clamp(percent * number(bind, "weight").value_or(0), 0.0, 1.0)}});
            }
        for (const Json& value : list(group, "materialValues")) add_material_bind(expression, value, file);
        const std::string name = text(group, "name");
        std::string preset = translated(presets, text(group, "presetName"));
        if (preset.empty() && (name == "Surprised" || name == "surprised")) preset = "surprised";
        if (!preset.empty() && !object_in(out, "preset").contains(preset))
            out["preset"][preset] = std::move(expression);
        else if (!name.empty())
            out["custom"][name] = std::move(expression);
    }
    return out;
}

Json point(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }

/// A list of three numbers.
std::optional<Eigen::Vector3d> point_of(const Json& object, const char* key) {
    const Json& values = list(object, key);
    if (values.size() != 3) return std::nullopt;
    Eigen::Vector3d out;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!values[i].is_number()) return std::nullopt;
        out[static_cast<Eigen::Index>(i)] = values[i].get<double>();
    }
    return out;
}

/// A vector of VRM 0.x, as {"x": ...} in Unity's axes, in those of the file's scene.
Eigen::Vector3d vector_from_0(const Json& value) {
    return {number(value, "x").value_or(0), number(value, "y").value_or(0), -number(value, "z").value_or(0)};
}

/// Puts the parts of VRM together.
class VrmReader {
public:
    VrmReader(const GltfFile& file, const std::vector<SceneObject>& objects,
              const std::vector<Eigen::Matrix4d>& node_matrices)
        : file_(&file), objects_(&objects), matrices_(&node_matrices) {}

    VrmData read() {
        const Json& extensions = object_in(file_->json, "extensions");
        if (const Json& vrm = object_in(extensions, "VRMC_vrm"); vrm.is_object())
            read_1(vrm, object_in(extensions, "VRMC_springBone"));
        else if (const Json& old = object_in(extensions, "VRM"); old.is_object())
            read_0(old);
        return std::move(out_);
    }

private:
    [[nodiscard]] std::size_t nodes() const { return matrices_->size(); }

    void read_1(const Json& vrm, const Json& springs) {
        Json& json = out_.json = Json::object();
        json["meta"] = Json(object_in(vrm, "meta"));
        if (!json["meta"].is_object()) json["meta"] = Json::object();
        if (!index(json["meta"], "thumbnailImage", file_->count("images"))) json["meta"].erase("thumbnailImage");
        for (const auto& [bone, value] : object_in(object_in(vrm, "humanoid"), "humanBones").items())
            if (const auto node = index(value, "node", nodes())) json["bones"][bone] = *node;
        if (const Json& expressions = object_in(vrm, "expressions"); expressions.is_object())
            json["expressions"] = expressions;
        if (const Json& first_person = object_in(vrm, "firstPerson"); first_person.is_object())
            json["firstPerson"] = first_person;
        if (const Json& look_at = object_in(vrm, "lookAt"); look_at.is_object()) {
            json["lookAt"] = look_at;
            json["lookAt"].erase("offsetFromHeadBone");
            if (const auto offset = point_of(look_at, "offsetFromHeadBone")) add_eyes(*offset);
        }
        if (springs.is_object()) read_springs_1(springs);
        for (const Json& node : list(file_->json, "nodes"))
            if (object_in(node, "extensions").contains("VRMC_node_constraint")) {
                out_.left_out.emplace_back("constraints of nodes");
                break;
            }
    }

    /// Where the eyes are, from the head's bone.
    void add_eyes(const Eigen::Vector3d& offset) {
        if (const auto head = index(object_in(out_.json, "bones"), "head", nodes()))
            out_.json["lookAt"]["eyes"] = point(transformed(offset, (*matrices_)[*head]));
    }

    void read_springs_1(const Json& springs) {
        Json kept = {{"colliders", Json::array()}, {"colliderGroups", Json::array()}, {"springs", Json::array()}};
        for (const Json& old : list(springs, "colliders")) {
            Json collider = old.is_object() ? old : Json::object();
            if (const auto node = index(collider, "node", nodes()))
                for (const char* shape : {"sphere", "capsule"})
                    for (const char* place : {"offset", "tail"}) {
                        const Json& values = object_in(object_in(collider, "shape"), shape);
                        const auto p = point_of(values, place);
                        if (p)
                            collider["shape"][shape][place] = point(transformed(*p, (*matrices_)[*node]));
                        else if (values.is_object())
                            collider["shape"][shape].erase(place);
                    }
            kept["colliders"].push_back(std::move(collider));
        }
        for (const char* key : {"colliderGroups", "springs"})
            for (const Json& one : list(springs, key)) kept[key].push_back(one.is_object() ? one : Json::object());
        out_.json["springBone"] = std::move(kept);
    }

    void read_0(const Json& vrm) {
        Json& json = out_.json = Json::object();
        json["meta"] = meta_from_0(object_in(vrm, "meta"), *file_);
        for (const Json& bone : list(object_in(vrm, "humanoid"), "humanBones"))
            if (const auto node = index(bone, "node", nodes())) json["bones"][bone_from_0(text(bone, "bone"))] = *node;
        json["expressions"] =
            expressions_from_0(list(object_in(vrm, "blendShapeMaster"), "blendShapeGroups"), *file_, *objects_);
        read_first_person_0(object_in(vrm, "firstPerson"));
        read_springs_0(object_in(vrm, "secondaryAnimation"));
        std::size_t toon = 0;
        for (const Json& material : list(vrm, "materialProperties"))
            if (text(material, "shader") == "VRM/MToon") ++toon;
        if (toon > 0) out_.left_out.push_back("the toon shading of " + std::to_string(toon) + " materials (VRM 0.x)");
    }

    /// VRM 1.0 calls the thumb's bones by what they are.
    static std::string bone_from_0(const std::string& name) {
        for (const std::string side : {"left", "right"}) {
            if (name == side + "ThumbProximal") return side + "ThumbMetacarpal";
            if (name == side + "ThumbIntermediate") return side + "ThumbProximal";
        }
        return name;
    }

    void read_first_person_0(const Json& old) {
        for (const Json& annotation : list(old, "meshAnnotations")) {
            const auto mesh = index(annotation, "mesh", file_->count("meshes"));
            constexpr std::array<Names, 4> flags{{{"Auto", "auto"},
                                                  {"Both", "both"},
                                                  {"ThirdPersonOnly", "thirdPersonOnly"},
                                                  {"FirstPersonOnly", "firstPersonOnly"}}};
            const std::string type = translated(flags, text(annotation, "firstPersonFlag"));
            for (const SceneObject& object : *objects_)
                if (mesh == object.mesh && !type.empty())
                    out_.json["firstPerson"]["meshAnnotations"].push_back({{"node", object.node}, {"type", type}});
        }
        const std::string type = text(old, "lookAtTypeName");
        if (type.empty()) return;
        Json& look_at = out_.json["lookAt"];
        look_at["type"] = type == "BlendShape" ? "expression" : "bone";
        constexpr std::array<Names, 4> ranges{{{"lookAtHorizontalInner", "rangeMapHorizontalInner"},
                                               {"lookAtHorizontalOuter", "rangeMapHorizontalOuter"},
                                               {"lookAtVerticalDown", "rangeMapVerticalDown"},
                                               {"lookAtVerticalUp", "rangeMapVerticalUp"}}};
        for (const auto& [from, to] : ranges)
            if (const auto x = number(object_in(old, from), "xRange"), y = number(object_in(old, from), "yRange");
                x && y)
                look_at[to] = {{"inputMaxValue", *x}, {"outputScale", *y}};
        if (const Json& offset = object_in(old, "firstPersonBoneOffset"); offset.is_object())
            add_eyes(vector_from_0(offset));
    }

    /// The bones from a spring's first one to its tip, along the first child of each.
    [[nodiscard]] std::vector<std::size_t> chain_from(std::size_t node) const {
        std::vector<std::size_t> chain;
        std::set<std::size_t> seen;
        for (std::optional<std::size_t> next = node; next && seen.insert(*next).second;) {
            chain.push_back(*next);
            const Json& children = list(file_->json.at("nodes")[*next], "children");
            next = children.empty() ? std::nullopt : index(children.front(), nodes());
        }
        return chain;
    }

    void read_springs_0(const Json& old) {
        Json kept = {{"colliders", Json::array()}, {"colliderGroups", Json::array()}, {"springs", Json::array()}};
        for (const Json& group : list(old, "colliderGroups")) {
            Json indices = Json::array();
            const auto node = index(group, "node", nodes());
            for (const Json& collider : list(group, "colliders")) {
                if (!node) continue;
                const Eigen::Vector3d place =
                    transformed(vector_from_0(object_in(collider, "offset")), (*matrices_)[*node]);
                indices.push_back(kept["colliders"].size());
                kept["colliders"].push_back(
                    {{"node", *node},
                     {"shape",
                      {{"sphere", {{"offset", point(place)}, {"radius", number(collider, "radius").value_or(0)}}}}}});
            }
            kept["colliderGroups"].push_back({{"colliders", std::move(indices)}});
        }
        for (const Json& group : list(old, "boneGroups"))
            for (const Json& root : list(group, "bones")) {
                const auto first = index(root, nodes());
                if (!first) continue;
                Json spring = {{"name", text(group, "comment")}, {"joints", Json::array()}};
                for (const std::size_t node : chain_from(*first))
                    spring["joints"].push_back({{"node", node},
                                                {"hitRadius", number(group, "hitRadius").value_or(0)},
                                                {"stiffness", number(group, "stiffiness").value_or(1)}, // so spelt
                                                {"gravityPower", number(group, "gravityPower").value_or(0)},
                                                {"gravityDir", point(vector_from_0(object_in(group, "gravityDir")))},
                                                {"dragForce", number(group, "dragForce").value_or(0.5)}});
                if (const auto centre = index(group, "center", nodes())) spring["center"] = *centre;
                for (const Json& one : list(group, "colliderGroups"))
                    if (one.is_number_integer()) spring["colliderGroups"].push_back(one);
                kept["springs"].push_back(std::move(spring));
            }
        out_.json["springBone"] = std::move(kept);
    }

    const GltfFile* file_;
    const std::vector<SceneObject>* objects_;
    const std::vector<Eigen::Matrix4d>* matrices_;
    VrmData out_;
};

} // namespace

VrmData read_vrm(const GltfFile& file, const std::vector<SceneObject>& objects,
                 const std::vector<Eigen::Matrix4d>& node_matrices) {
    return VrmReader(file, objects, node_matrices).read();
}

std::string forbidden_by(const Json& meta) {
    const Json& redistribution = member(meta, "allowRedistribution", Json::value_t::boolean);
    // What VRM does not say is forbidden. Where another licence is named, that says it instead.
    const bool is_silent =
        redistribution.is_null() && text(meta, "modification").empty() && !text(meta, "otherLicenseUrl").empty();
    if (is_silent) return "";
    const bool may_be_passed_on = redistribution.is_boolean() && redistribution.get<bool>();
    const std::string modification = text(meta, "modification");
    const bool may_be_changed = !modification.empty() && modification != "prohibited";
    if (may_be_passed_on) return may_be_changed ? "" : "modification";
    return may_be_changed ? "redistribution" : "redistribution and modification";
}

} // namespace skelgen::io::detail
