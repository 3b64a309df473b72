#include <skelgen/io/template_json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <utility>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/template_rules.hpp>
#include <skelgen/io/read_file.hpp>

#include "json_values.hpp"
#include "number_text.hpp"

namespace skelgen::io {
namespace {

using detail::Json;

constexpr std::string_view format_name = "skelgen-template";
constexpr int left_handed_version = 1; ///< x to the body's left, y forward, z up
constexpr int current_version = 2;     ///< x to the body's left, y up, z forward

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::bad_input, what); }

/// A joint's place in messages: its name where it has one, else its number, counted from 1.
std::string describe(const Json& joint, std::size_t index) {
    if (joint.is_object() && joint.contains("name") && joint["name"].is_string())
        return "joint '" + joint["name"].get<std::string>() + "'";
    return "joint number " + std::to_string(index + 1);
}

/// Throws unless `object` is an object with all `required` keys and no key beside those and the `optional` ones.
void check_keys(const Json& object, const std::string& what, std::initializer_list<std::string_view> required,
                std::initializer_list<std::string_view> optional = {}) {
    if (!object.is_object()) refuse(what + " must be a JSON object");
    for (const std::string_view key : required)
        if (!object.contains(key)) refuse(what + " has no \"" + std::string(key) + "\"");
    for (const auto& item : object.items())
        if (std::find(optional.begin(), optional.end(), item.key()) == optional.end() &&
            std::find(required.begin(), required.end(), item.key()) == required.end())
            refuse(what + " has an unknown key \"" + item.key() + "\": remove it");
}

std::string read_string(const Json& object, const char* key, const std::string& what) {
    if (!object[key].is_string()) refuse(what + ": \"" + key + "\" must be a string");
    return object[key].get<std::string>();
}

/// The one of `values` that is spelled as the string at `key`.
template <typename Enum, std::size_t n>
Enum read_enum(const Json& object, const char* key, const std::string& what, const std::array<Enum, n>& values) {
    const std::string spelling = read_string(object, key, what);
    std::string known;
    for (const Enum value : values) {
        if (to_string(value) == spelling) return value;
        known += (known.empty() ? "" : ", ") + std::string(to_string(value));
    }
    refuse(what + " has the unknown " + key + " '" + spelling + "': use one of " + known);
}

JointRole read_role(const Json& object, const std::string& what) {
    using enum JointRole;
    return read_enum(object, "role", what,
                     std::array{pelvis, waist, chest, neck, head, shoulder, elbow, wrist, hand, hip, knee, ankle, foot,
                                shoulder_girdle, hip_girdle, tail, ear});
}

Vector3<double> read_point(const Json& object, const std::string& key, const std::string& what) {
    const auto point = detail::to_point(object[key]);
    if (!point) refuse(what + ": \"" + key + "\" must be three numbers");
    return *point;
}

double read_radius(const Json& object, const std::string& what) {
    const Json& radius = object["radius"];
    if (!radius.is_number() || !(radius.get<double>() > 0)) refuse(what + ": \"radius\" must be a number above 0");
    return radius.get<double>();
}

/// Throws when following the parents' names from `joint` leads back to it.
void check_cycle(const Json& joints, const Json& joint, const std::string& what) {
    const auto named = [&](const Json& name) {
        return std::find_if(joints.begin(), joints.end(),
                            [&](const Json& j) { return j.is_object() && j.value("name", Json()) == name; });
    };
    Json ancestor = joint["parent"];
    for (std::size_t step = 0; step < joints.size() && ancestor.is_string(); ++step) {
        if (ancestor == joint["name"]) refuse(what + " is its own ancestor: parents must form a tree");
        const auto next = named(ancestor);
        ancestor = next == joints.end() ? Json() : next->value("parent", Json());
    }
}

/// Index of the joint's parent among those `before` it, or -1 for null.
int read_parent(const Json& joints, const Json& joint, const std::string& what,
                const std::vector<TemplateJoint>& before) {
    const Json& parent = joint["parent"];
    if (parent.is_null()) return -1;
    const std::string name = parent.is_string() ? parent.get<std::string>() : "";
    if (!parent.is_string()) refuse(what + ": \"parent\" must be a joint's name, or null for the root");
    const auto found =
        std::find_if(before.begin(), before.end(), [&](const TemplateJoint& other) { return other.name == name; });
    if (found != before.end()) return static_cast<int>(std::distance(before.begin(), found));

    check_cycle(joints, joint, what);
    const bool comes_later = std::any_of(joints.begin(), joints.end(), [&](const Json& j) {
        return j.is_object() && j.value("name", Json()) == parent;
    });
    if (comes_later) refuse(what + " comes before its parent '" + name + "': list parents before children");
    refuse(what + " has the unknown parent '" + name + "'");
}

TemplateJoint read_joint(const Json& joints, std::size_t index, const std::vector<TemplateJoint>& before) {
    const Json& object = joints[index];
    const std::string what = describe(object, index);
    check_keys(object, what, {"name", "parent", "role", "side", "position"}, {"tip", "radius"});
    TemplateJoint joint;
    joint.name = read_string(object, "name", what);
    joint.parent = read_parent(joints, object, what, before);
    joint.role = read_role(object, what);
    joint.side = read_enum(object, "side", what, std::array{Side::none, Side::left, Side::right});
    joint.position = read_point(object, "position", what);
    if (object.contains("tip")) joint.tip = read_point(object, "tip", what);
    if (object.contains("radius")) joint.radius = read_radius(object, what);
    return joint;
}

std::string join(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

int read_version(const Json& document, const std::string& what) {
    for (const int version : {left_handed_version, current_version})
        if (document["version"] == version) return version;
    refuse(what + "'s \"version\" must be " + std::to_string(left_handed_version) + " or " +
           std::to_string(current_version));
}

void turn_right_handed(SkeletonTemplate& skeleton_template) {
    for (TemplateJoint& joint : skeleton_template.joints) {
        std::swap(joint.position.y(), joint.position.z());
        if (joint.tip) std::swap(joint.tip->y(), joint.tip->z());
    }
}

std::string point_text(const Vector3<double>& point) {
    std::string text = "[";
    detail::append_point(text, point, ", ");
    return text + "]";
}

std::string json_text(std::string_view text) { return Json(text).dump(); }

std::string joint_text(const SkeletonTemplate& skeleton_template, const TemplateJoint& joint) {
    std::string text =
        "{\"name\": " + json_text(joint.name) +
        ", \"parent\": " + (joint.parent < 0 ? "null" : json_text(skeleton_template.joint(joint.parent).name)) +
        ", \"role\": " + json_text(to_string(joint.role)) + ", \"side\": " + json_text(to_string(joint.side)) +
        ", \"position\": " + point_text(joint.position);
    if (joint.tip) text += ", \"tip\": " + point_text(*joint.tip);
    if (joint.radius > 0) {
        text += ", \"radius\": ";
        detail::append_number(text, joint.radius);
    }
    return text + "}";
}

} // namespace

SkeletonTemplate parse_template(std::string_view json) {
    const Json document = detail::parse_json(json);
    const std::string what = "the template";
    check_keys(document, what, {"format", "version", "name", "joints"}, {"description", "plan"});
    if (document["format"] != format_name) refuse(what + "'s \"format\" must be " + json_text(format_name));
    const int version = read_version(document, what);
    if (!document["joints"].is_array()) refuse(what + "'s \"joints\" must be a list");

    SkeletonTemplate result;
    result.name = read_string(document, "name", what);
    if (document.contains("plan"))
        result.plan = read_enum(document, "plan", what, std::array{BodyKind::human, BodyKind::quadruped});
    for (std::size_t i = 0; i < document["joints"].size(); ++i)
        result.joints.push_back(read_joint(document["joints"], i, result.joints));
    if (version == left_handed_version) turn_right_handed(result);
    validate_template(result);
    return result;
}

SkeletonTemplate read_template(const std::filesystem::path& file) { return parse_template(read_file(file)); }

SkeletonTemplate load_template(const std::string& name_or_file) {
    const std::vector<std::string> names = builtin_template_names();
    if (std::find(names.begin(), names.end(), name_or_file) != names.end()) return builtin_template(name_or_file);
    std::error_code ignored;
    if (!std::filesystem::exists(name_or_file, ignored))
        throw Error(ErrorCode::usage,
                    "'" + name_or_file + "' is neither a built-in template (" + join(names) + ") nor a file");
    try {
        return read_template(name_or_file);
    } catch (const Error& error) {
        throw Error(error.code(), "template " + name_or_file + ": " + error.what());
    }
}

std::string template_to_json(const SkeletonTemplate& skeleton_template) {
    validate_template(skeleton_template);
    std::string text = "{\n  \"format\": " + json_text(format_name) +
                       ",\n  \"version\": " + std::to_string(current_version) +
                       ",\n  \"name\": " + json_text(skeleton_template.name);
    if (skeleton_template.plan != BodyKind::human)
        text += ",\n  \"plan\": " + json_text(to_string(skeleton_template.plan));
    text += ",\n  \"joints\": [";
    const char* separator = "\n    ";
    for (const TemplateJoint& joint : skeleton_template.joints) {
        text += separator + joint_text(skeleton_template, joint);
        separator = ",\n    ";
    }
    return text + "\n  ]\n}\n";
}

} // namespace skelgen::io
