#include "vrm_writer.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/builtin_templates.hpp>

namespace skelgen::io::detail {
namespace {

using applications::Rig;
using applications::RigJoint;

constexpr const char* any_licence = "https://vrm.dev/licenses/1.0/"; // the one that VRM 1.0 wants named

/// Where a file's nodes have gone: to nodes of the scene and, bones, to joints of the rig.
struct NodeMap {
    std::map<std::size_t, std::size_t> nodes, joints;

    NodeMap(const RigScene& scene, const Json& vrm, const SceneLooks& looks, const Json& human_bones) {
        for (std::size_t node = 0; node < scene.objects.size(); ++node)
            if (const auto object = scene.objects[node]) nodes[looks.objects[*object].node] = node;
        if (!vrm.contains("bones")) return;
        for (const auto& [bone, node] : vrm["bones"].items()) {
            const auto human = human_bones.find(bone);
            if (human == human_bones.end()) continue;
            const std::size_t place = (*human)["node"];
            nodes[node] = place;
            const auto joint = std::find(scene.joint_nodes.begin(), scene.joint_nodes.end(), place);
            joints[node] = static_cast<std::size_t>(joint - scene.joint_nodes.begin());
        }
    }

    /// Of an object's member, which is a node of the file.
    [[nodiscard]] std::optional<std::size_t> of(const Json& object, const char* key) const {
        return in(nodes, object, key);
    }
    [[nodiscard]] std::optional<std::size_t> joint_of(const Json& object, const char* key) const {
        return in(joints, object, key);
    }

private:
    static std::optional<std::size_t> in(const std::map<std::size_t, std::size_t>& places, const Json& object,
                                         const char* key) {
        if (!object.is_object() || !object.contains(key) || !object[key].is_number_unsigned()) return std::nullopt;
        const auto found = places.find(object[key].get<std::size_t>());
        return found == places.end() ? std::nullopt : std::optional(found->second);
    }
};

bool is_list(const Json& object, const char* key) {
    return object.is_object() && object.contains(key) && object[key].is_array();
}

/// A list's elements of an object; none where there is no such list.
Json elements(const Json& object, const char* key) { return is_list(object, key) ? object[key] : Json::array(); }

/// What a rig's joint makes of a place in the file's scene, in the joint's own axes.
Json place_in(const Rig<double>& rig, std::size_t joint, const Json& place) {
    const Eigen::Vector3d p(place[0], place[1], place[2]);
    const RigJoint<double>& axes = rig.joints[joint];
    const Eigen::Vector3d now = rig.motions[joint](rig.metres_per_unit * p);
    const Eigen::Vector3d own = axes.axes.conjugate() * (now - axes.position);
    return {own[0], own[1], own[2]};
}

/// Who made the avatar and what may be done with it. Where the file was no VRM: what its "asset" says of that.
Json meta_of(const Json& vrm, const SceneLooks& looks, const std::string& name) {
    Json meta = vrm.is_object() ? vrm["meta"] : Json::object();
    const Json about = parse_json(looks.about);
    const auto in_extras = [&](const char* key) -> std::string {
        const Json extras = about.value("extras", Json::object());
        return extras.is_object() && extras.contains(key) && extras[key].is_string() ? extras[key].get<std::string>()
                                                                                     : "";
    };
    const std::string copyright =
        about.contains("copyright") && about["copyright"].is_string() ? about["copyright"].get<std::string>() : "";
    const auto is_said = [&](const char* key) {
        return meta.contains(key) && meta[key].is_string() && !meta[key].get<std::string>().empty();
    };
    if (!is_said("name")) meta["name"] = valid_utf8(in_extras("title").empty() ? name : in_extras("title"));
    const bool has_authors = is_list(meta, "authors") && !meta["authors"].empty() &&
                             std::all_of(meta["authors"].begin(), meta["authors"].end(),
                                         [](const Json& author) { return author.is_string(); });
    if (!has_authors) {
        std::string author = in_extras("author").empty() ? copyright : in_extras("author");
        if (author.empty()) author = "unknown";
        meta["authors"] = Json::array({author});
    }
    if (!is_said("copyrightInformation") && !copyright.empty()) meta["copyrightInformation"] = copyright;
    const std::string licence = in_extras("license");
    if (!licence.empty() && !is_said("otherLicenseUrl") && !is_said("thirdPartyLicenses"))
        meta[licence.starts_with("http") ? "otherLicenseUrl" : "thirdPartyLicenses"] = licence;
    if (!is_said("licenseUrl")) meta["licenseUrl"] = any_licence;
    return meta;
}

Json expression_of(Json expression, const NodeMap& map, const RigScene& scene) {
    if (!expression.is_object()) return Json::object();
    Json binds = Json::array();
    for (Json bind : elements(expression, "morphTargetBinds")) {
        const auto node = map.of(bind, "node");
        if (!node || *node >= scene.objects.size()) continue;
        const std::size_t targets = elements(scene.json["meshes"][*node], "weights").size();
        if (!bind.contains("index") || !bind["index"].is_number_unsigned() || bind["index"] >= targets) continue;
        bind["node"] = *node;
        binds.push_back(std::move(bind));
    }
    if (expression.contains("morphTargetBinds")) expression["morphTargetBinds"] = std::move(binds);
    return expression;
}

Json expressions_of(const Json& old, const NodeMap& map, const RigScene& scene) {
    Json out = Json::object();
    for (const char* kind : {"preset", "custom"})
        if (old.contains(kind) && old[kind].is_object())
            for (const auto& [name, expression] : old[kind].items())
                out[kind][name] = expression_of(expression, map, scene);
    return out;
}

Json first_person_of(const Json& old, const NodeMap& map) {
    Json annotations = Json::array();
    for (Json annotation : elements(old, "meshAnnotations"))
        if (const auto node = map.of(annotation, "node")) {
            annotation["node"] = *node;
            annotations.push_back(std::move(annotation));
        }
    return {{"meshAnnotations", std::move(annotations)}};
}

/// Spring bones whose joints are all there, with those colliders that are.
class SpringWriter {
public:
    SpringWriter(const Rig<double>& rig, const NodeMap& map, const Json& old) : rig_(&rig), map_(&map), old_(&old) {}

    [[nodiscard]] Json write() {
        Json springs = Json::array();
        for (const Json& spring : (*old_)["springs"])
            if (auto kept = spring_of(spring)) springs.push_back(*std::move(kept));
        if (springs.empty()) return {};
        std::map<std::size_t, std::size_t> colliders; // from old numbers to new ones
        Json out{{"specVersion", "1.0"}, {"colliders", Json::array()}, {"colliderGroups", Json::array()}};
        for (std::size_t i = 0; i < (*old_)["colliders"].size(); ++i)
            if (auto kept = collider_of((*old_)["colliders"][i])) {
                colliders[i] = out["colliders"].size();
                out["colliders"].push_back(*std::move(kept));
            }
        for (Json group : (*old_)["colliderGroups"]) {
            Json kept = Json::array();
            for (const Json& number : elements(group, "colliders"))
                if (number.is_number_unsigned() && colliders.contains(number)) kept.push_back(colliders[number]);
            group["colliders"] = std::move(kept);
            out["colliderGroups"].push_back(std::move(group));
        }
        out["springs"] = std::move(springs);
        return out;
    }

private:
    [[nodiscard]] std::optional<Json> spring_of(Json spring) const {
        if (elements(spring, "joints").empty()) return std::nullopt;
        for (Json& joint : spring["joints"]) {
            const auto node = map_->of(joint, "node");
            if (!node) return std::nullopt;
            joint["node"] = *node;
            if (joint.contains("hitRadius") && joint["hitRadius"].is_number())
                joint["hitRadius"] = rig_->metres_per_unit * joint["hitRadius"].get<double>();
        }
        if (const auto centre = map_->of(spring, "center"))
            spring["center"] = *centre;
        else
            spring.erase("center");
        const std::size_t groups = (*old_)["colliderGroups"].size();
        Json kept = Json::array();
        for (const Json& group : elements(spring, "colliderGroups"))
            if (group.is_number_unsigned() && group < groups) kept.push_back(group);
        spring["colliderGroups"] = std::move(kept);
        return spring;
    }

    [[nodiscard]] std::optional<Json> collider_of(Json collider) const {
        const auto node = map_->of(collider, "node");
        const auto joint = map_->joint_of(collider, "node");
        if (!node || !joint || *joint >= rig_->motions.size()) return std::nullopt;
        collider["node"] = *node;
        for (const char* shape : {"sphere", "capsule"}) {
            if (!collider["shape"].is_object() || !collider["shape"].contains(shape)) continue;
            Json& one = collider["shape"][shape];
            for (const char* place : {"offset", "tail"})
                if (is_list(one, place)) one[place] = place_in(*rig_, *joint, one[place]);
            if (one.contains("radius") && one["radius"].is_number())
                one["radius"] = rig_->metres_per_unit * one["radius"].get<double>();
        }
        return collider;
    }

    const Rig<double>* rig_;
    const NodeMap* map_;
    const Json* old_;
};

} // namespace

std::size_t count_lost_springs(const SceneLooks& looks) {
    const Json vrm = parse_json(looks.vrm);
    if (!vrm.contains("springBone")) return 0;
    std::vector<std::size_t> kept;
    for (const TemplateJoint& joint : builtin_template("human21").joints) {
        const std::string bone = name_of({joint.name, joint.parent, joint.role, joint.side}, JointNames::vrm);
        if (vrm.contains("bones") && vrm["bones"].contains(bone)) kept.push_back(vrm["bones"][bone]);
    }
    const auto is_kept = [&](const Json& joint) {
        return joint.is_object() && joint.contains("node") &&
               std::find(kept.begin(), kept.end(), joint["node"]) != kept.end();
    };
    std::size_t lost = 0;
    for (const Json& spring : vrm["springBone"]["springs"]) {
        const Json joints = elements(spring, "joints");
        if (joints.empty() || !std::all_of(joints.begin(), joints.end(), is_kept)) ++lost;
    }
    return lost;
}

void add_vrm(RigScene& scene, const Rig<double>& rig, const SceneLooks& looks, const std::string& name,
             Json human_bones) {
    const Json old = looks.vrm.empty() ? Json() : parse_json(looks.vrm);
    const NodeMap map(scene, old, looks, human_bones);
    Json vrm{{"specVersion", "1.0"}, {"meta", meta_of(old, looks, name)}};
    if (old.contains("expressions")) vrm["expressions"] = expressions_of(old["expressions"], map, scene);
    if (old.contains("firstPerson")) vrm["firstPerson"] = first_person_of(old["firstPerson"], map);
    if (old.contains("lookAt")) {
        Json look_at = old["lookAt"];
        const auto head = map.joint_of(old.value("bones", Json::object()), "head");
        if (look_at.contains("eyes") && head && *head < rig.motions.size())
            look_at["offsetFromHeadBone"] = place_in(rig, *head, look_at["eyes"]);
        look_at.erase("eyes");
        vrm["lookAt"] = std::move(look_at);
    }
    const auto use = [&](const char* extension, Json content) {
        scene.json["extensionsUsed"].push_back(extension);
        scene.json["extensions"][extension] = std::move(content);
    };
    if (old.contains("springBone"))
        if (Json springs = SpringWriter(rig, map, old["springBone"]).write(); !springs.is_null())
            use("VRMC_springBone", std::move(springs));
    vrm["humanoid"] = {{"humanBones", std::move(human_bones)}};
    use("VRMC_vrm", std::move(vrm));
}

} // namespace skelgen::io::detail
