#include <skelgen/io/template_json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <optional>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/core/template_rules.hpp>

#include "skelgen_embedded_templates.hpp"

namespace skelgen {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::bad_input, what); }

json parse_json(std::string_view text) {
    try {
        return json::parse(text);
    } catch (const json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: ...": the first word is of no use to
        // users.
        const std::string_view what = error.what();
        refuse("the template is no valid JSON: " + std::string(what.substr(what.find(']') + 2)));
    }
}

/// A joint's place in messages: its name where it has one, else its number, counted from 1.
std::string describe(const json& joint, std::size_t index) {
    if (joint.is_object() && joint.contains("name") && joint["name"].is_string())
        return "joint '" + joint["name"].get<std::string>() + "'";
    return "joint number " + std::to_string(index + 1);
}

/// Throws unless `object` is an object with all `required` keys and no key beside those and the `optional` ones.
void check_keys(const json& object, const std::string& what, std::initializer_list<std::string_view> required,
                std::initializer_list<std::string_view> optional = {}) {
    if (!object.is_object()) refuse(what + " must be a JSON object");
    for (const std::string_view key : required)
        if (!object.contains(key)) refuse(what + " has no \"" + std::string(key) + "\"");
    for (const auto& item : object.items())
        if (std::find(optional.begin(), optional.end(), item.key()) == optional.end() &&
            std::find(required.begin(), required.end(), item.key()) == required.end())
            refuse(what + " has an unknown key \"" + item.key() + "\": remove it");
}

std::string read_string(const json& object, const char* key, const std::string& what) {
    if (!object[key].is_string()) refuse(what + ": \"" + key + "\" must be a string");
    return object[key].get<std::string>();
}

/// The one of `values` that is spelled as the string at `key`.
template <typename Enum, std::size_t n>
Enum read_enum(const json& object, const char* key, const std::string& what, const std::array<Enum, n>& values) {
    const std::string spelling = read_string(object, key, what);
    std::string known;
    for (const Enum value : values) {
        if (to_string(value) == spelling) return value;
        known += (known.empty() ? "" : ", ") + std::string(to_string(value));
    }
    refuse(what + " has the unknown " + key + " '" + spelling + "': use one of " + known);
}

JointRole read_role(const json& object, const std::string& what) {
    using enum JointRole;
    return read_enum(
        object, "role", what,
        std::array{pelvis, waist, chest, neck, head, shoulder, elbow, wrist, hand, hip, knee, ankle, foot});
}

Vector3<double> read_point(const json& object, const std::string& key, const std::string& what) {
    const json& position = object[key];
    const bool is_point = position.is_array() && position.size() == 3 &&
                          std::all_of(position.begin(), position.end(), [](const json& x) { return x.is_number(); });
    if (!is_point) refuse(what + ": \"" + key + "\" must be three numbers");
    return {position[0].get<double>(), position[1].get<double>(), position[2].get<double>()};
}

double read_radius(const json& object, const std::string& what) {
    const json& radius = object["radius"];
    if (!radius.is_number() || !(radius.get<double>() > 0)) refuse(what + ": \"radius\" must be a number above 0");
    return radius.get<double>();
}

/// Throws when following the parents' names from `joint` leads back to it.
void check_cycle(const json& joints, const json& joint, const std::string& what) {
    const auto named = [&](const json& name) {
        return std::find_if(joints.begin(), joints.end(),
                            [&](const json& j) { return j.is_object() && j.value("name", json()) == name; });
    };
    json ancestor = joint["parent"];
    for (std::size_t step = 0; step < joints.size() && ancestor.is_string(); ++step) {
        if (ancestor == joint["name"]) refuse(what + " is its own ancestor: parents must form a tree");
        const auto next = named(ancestor);
        ancestor = next == joints.end() ? json() : next->value("parent", json());
    }
}

/// Index of the joint's parent among those `before` it, or -1 for null.
int read_parent(const json& joints, const json& joint, const std::string& what,
                const std::vector<TemplateJoint>& before) {
    const json& parent = joint["parent"];
    if (parent.is_null()) return -1;
    const std::string name = parent.is_string() ? parent.get<std::string>() : "";
    if (!parent.is_string()) refuse(what + ": \"parent\" must be a joint's name, or null for the root");
    const auto found =
        std::find_if(before.begin(), before.end(), [&](const TemplateJoint& other) { return other.name == name; });
    if (found != before.end()) return static_cast<int>(std::distance(before.begin(), found));

    check_cycle(joints, joint, what);
    const bool comes_later = std::any_of(joints.begin(), joints.end(), [&](const json& j) {
        return j.is_object() && j.value("name", json()) == parent;
    });
    if (comes_later) refuse(what + " comes before its parent '" + name + "': list parents before children");
    refuse(what + " has the unknown parent '" + name + "'");
}

TemplateJoint read_joint(const json& joints, std::size_t index, const std::vector<TemplateJoint>& before) {
    const json& object = joints[index];
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

std::vector<SkeletonTemplate> parse_builtin_templates() {
    std::vector<SkeletonTemplate> templates;
    for (const detail::EmbeddedFile& file : detail::embedded_templates) templates.push_back(parse_template(file.text));
    std::sort(templates.begin(), templates.end(),
              [](const SkeletonTemplate& a, const SkeletonTemplate& b) { return a.name < b.name; });
    return templates;
}

const std::vector<SkeletonTemplate>& builtin_templates() {
    static const std::vector<SkeletonTemplate> templates = parse_builtin_templates();
    return templates;
}

const SkeletonTemplate* find_builtin(std::string_view name) {
    const std::vector<SkeletonTemplate>& all = builtin_templates();
    const auto found = std::find_if(all.begin(), all.end(), [&](const SkeletonTemplate& t) { return t.name == name; });
    return found == all.end() ? nullptr : &*found;
}

} // namespace

SkeletonTemplate parse_template(std::string_view json_text) {
    const json document = parse_json(json_text);
    const std::string what = "the template";
    check_keys(document, what, {"format", "version", "name", "joints"}, {"description"});
    if (document["format"] != "skelgen-template") refuse(what + "'s \"format\" must be \"skelgen-template\"");
    if (document["version"] != 1) refuse(what + "'s \"version\" must be 1");
    if (!document["joints"].is_array()) refuse(what + "'s \"joints\" must be a list");

    SkeletonTemplate result;
    result.name = read_string(document, "name", what);
    for (std::size_t i = 0; i < document["joints"].size(); ++i)
        result.joints.push_back(read_joint(document["joints"], i, result.joints));
    validate_template(result);
    return result;
}

SkeletonTemplate read_template(const std::filesystem::path& file) {
    std::error_code ignored;
    std::ifstream stream(file, std::ios::binary);
    if (!stream || std::filesystem::is_directory(file, ignored))
        refuse("cannot read the template file: check that it exists and may be read");
    const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (stream.bad()) refuse("reading the template file failed half-way");
    return parse_template(text);
}

std::vector<std::string> builtin_template_names() {
    std::vector<std::string> names;
    for (const SkeletonTemplate& each : builtin_templates()) names.push_back(each.name);
    return names;
}

const SkeletonTemplate& builtin_template(std::string_view name) {
    if (const SkeletonTemplate* found = find_builtin(name)) return *found;
    throw Error(ErrorCode::usage, "there is no built-in template '" + std::string(name) + "': use one of " +
                                      join(builtin_template_names()));
}

SkeletonTemplate load_template(const std::string& name_or_file) {
    if (const SkeletonTemplate* found = find_builtin(name_or_file)) return *found;
    std::error_code ignored;
    if (!std::filesystem::exists(name_or_file, ignored))
        throw Error(ErrorCode::usage, "'" + name_or_file + "' is neither a built-in template (" +
                                          join(builtin_template_names()) + ") nor a file");
    try {
        return read_template(name_or_file);
    } catch (const Error& error) {
        throw Error(error.code(), "template " + name_or_file + ": " + error.what());
    }
}

} // namespace skelgen
