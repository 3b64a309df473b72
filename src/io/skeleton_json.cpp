#include <skelgen/io/skeleton_json.hpp>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <skelgen/core/error.hpp>
#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/read_file.hpp>
#include <skelgen/version.hpp>

#include "json_values.hpp"
#include "number_text.hpp"

namespace skelgen::io {
namespace {

using detail::Json;

constexpr int format_version = 1;
constexpr const char* format_name = "skelgen-skeleton";

// ---------------------------------------------------------------------------------------------------------- writing

/// File names may hold any bytes; what is no UTF-8 becomes the replacement character.
std::string to_json_text(const std::string& text) {
    return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The shortest text that reads back as the same value of the same type: 0.1f is "0.1", not "0.10000000149011612".
template <typename Number>
std::string number(Number value) {
    if constexpr (std::is_floating_point_v<Number>) {
        if (!std::isfinite(value)) throw Error(ErrorCode::internal, "the skeleton holds a number that is not finite");
        if (value == 0) return "0"; // and never "-0"
    }
    std::string text;
    detail::append_number(text, value);
    return text;
}

template <typename Scalar>
std::string triple(const Vector3<Scalar>& v) {
    return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]";
}

/// `items` on lines of their own between `open` and `close`; empty brackets on one line.
std::string block(const char* open, const std::vector<std::string>& items, const char* close) {
    std::string text = open;
    for (std::size_t i = 0; i < items.size(); ++i) text += (i == 0 ? "\n    " : ",\n    ") + items[i];
    return text + (items.empty() ? "" : "\n  ") + close;
}

std::string mesh_text(const SourceMesh& mesh) {
    return "{\"file\": " + to_json_text(mesh.file) + ", \"vertices\": " + number(mesh.vertices) +
           ", \"faces\": " + number(mesh.faces) + ", \"geodesic_diameter\": " + number(mesh.geodesic_diameter) + "}";
}

/// What follows in a digit's line where others are one with it.
std::string fused_text(const std::string& joint, const SkeletonProvenance& provenance) {
    const auto found = std::find_if(provenance.fused.begin(), provenance.fused.end(),
                                    [&](const auto& each) { return each.first == joint; });
    if (found == provenance.fused.end()) return "";
    std::string names;
    for (const std::string& name : found->second) names += (names.empty() ? "" : ", ") + to_json_text(name);
    return ", \"fused\": [" + names + "]";
}

template <typename Scalar>
std::string joints_text(const std::vector<Joint<Scalar>>& joints, const SkeletonProvenance& provenance) {
    std::vector<std::string> lines;
    for (const auto& joint : joints) {
        const bool is_root = joint.parent < 0;
        const std::string parent =
            is_root ? "null" : to_json_text(joints.at(static_cast<std::size_t>(joint.parent)).name);
        const std::string named = "{\"name\": " + to_json_text(joint.name) + ", \"parent\": " + parent;
        if (!joint.is_present) {
            lines.push_back(named + ", \"present\": false}");
            continue;
        }
        lines.push_back(named + ", \"position\": " + triple(joint.position) + ", \"radius\": " + number(joint.radius) +
                        ", \"confidence\": " + number(joint.confidence) + fused_text(joint.name, provenance) + "}");
    }
    return block("[", lines, "]");
}

template <typename Scalar>
std::string end_points_text(const std::vector<std::pair<std::string, Vector3<Scalar>>>& end_points) {
    std::vector<std::string> lines;
    for (const auto& [name, position] : end_points) lines.push_back(to_json_text(name) + ": " + triple(position));
    return block("{", lines, "}");
}

template <typename Scalar>
std::string frame_text(const BodyFrame<Scalar>& frame) {
    return "{\"origin\": " + triple(frame.origin) + ", \"left\": " + triple(frame.left) +
           ", \"forward\": " + triple(frame.forward) + ", \"up\": " + triple(frame.up) + "}";
}

std::string quality_text(const Quality& quality) {
    std::string warnings;
    for (const std::string& warning : quality.warnings)
        warnings += (warnings.empty() ? "" : ", ") + to_json_text(warning);
    std::string votes;
    for (const SideVote& vote : quality.side_votes)
        votes += (votes.empty() ? "" : ", ") + to_json_text(vote.witness) + ": " + number(vote.strength);
    return "{\"sides_confidence\": " + number(quality.sides_confidence) +
           ", \"matched_nodes\": " + number(quality.matched_nodes) + ", \"warnings\": [" + warnings +
           "], \"side_votes\": {" + votes + "}}";
}

std::string timings_text(const FileTimings& timings) {
    // No clock is better than a microsecond: more digits would be noise.
    const auto ms = [](double value) { return number(std::round(value * 1000) / 1000); };
    return "{\"read\": " + ms(timings.read) + ", \"surface\": " + ms(timings.stages.surface) +
           ", \"curve\": " + ms(timings.stages.curve) + ", \"embed\": " + ms(timings.stages.embed) +
           ", \"refine\": " + ms(timings.stages.refine) + ", \"sides\": " + ms(timings.stages.sides) +
           ", \"total\": " + ms(timings.stages.total) + "}";
}

// ---------------------------------------------------------------------------------------------------------- reading

[[noreturn]] void refuse(const std::string& what) {
    throw Error(ErrorCode::bad_input, "is no skeleton file: " + what + "; write it with `skelgen extract`");
}

const Json& member(const Json& object, const char* key, const std::string& where) {
    if (!object.is_object()) refuse(where + " is no object");
    const auto found = object.find(key);
    if (found == object.end()) refuse("\"" + std::string(key) + "\" is missing in " + where);
    return *found;
}

std::string to_text(const Json& value, const std::string& where) {
    if (!value.is_string()) refuse(where + " is no text");
    return value.get<std::string>();
}

double to_number(const Json& value, const std::string& where) {
    if (!value.is_number()) refuse(where + " is no number");
    return value.get<double>();
}

std::int64_t to_count(const Json& value, const std::string& where) {
    if (!value.is_number_integer() || value.get<std::int64_t>() < 0) refuse(where + " is no count");
    return value.get<std::int64_t>();
}

Vector3<double> to_vector(const Json& value, const std::string& where) {
    const auto point = detail::to_point(value);
    if (!point) refuse(where + " is no list of three numbers");
    return *point;
}

int parent_index(const Json& value, const KinematicSkeleton<double>& before, const std::string& where) {
    if (value.is_null()) {
        if (!before.joints.empty()) refuse(where + " is a second root");
        return -1;
    }
    const int parent = find_joint(before, to_text(value, "the parent of " + where));
    if (parent < 0) refuse("the parent of " + where + " does not come before it");
    return parent;
}

void read_joints(const Json& list, KinematicSkeleton<double>& skeleton) {
    if (!list.is_array() || list.empty()) refuse("\"joints\" is no list of joints");
    for (const Json& item : list) {
        Joint<double> joint;
        const std::string place = "joint " + std::to_string(skeleton.joints.size());
        joint.name = to_text(member(item, "name", place), "the name of " + place);
        const std::string where = "joint \"" + joint.name + "\"";
        if (find_joint(skeleton, joint.name) >= 0) refuse(where + " comes twice");
        joint.parent = parent_index(member(item, "parent", where), skeleton, where);
        if (item.contains("present") && !item["present"].is_boolean())
            refuse("\"present\" of " + where + " is no truth value");
        joint.is_present = item.value("present", true);
        const Joint<double>* const parent =
            joint.parent < 0 ? nullptr : &skeleton.joints[static_cast<std::size_t>(joint.parent)];
        if (!joint.is_present) {
            if (!parent) refuse(where + ", the root, is not present");
            joint.position = parent->position;
            joint.confidence = 0;
            skeleton.joints.push_back(std::move(joint));
            continue;
        }
        if (parent && !parent->is_present) refuse(where + " is present, but its parent is not");
        joint.position = to_vector(member(item, "position", where), "the position of " + where);
        joint.radius = to_number(member(item, "radius", where), "the radius of " + where);
        if (item.contains("confidence")) joint.confidence = to_number(item["confidence"], "the confidence of " + where);
        skeleton.joints.push_back(std::move(joint));
    }
}

/// The digits that are one with others, per first joint.
std::vector<std::pair<std::string, std::vector<std::string>>> to_fused(const Json& joints) {
    std::vector<std::pair<std::string, std::vector<std::string>>> out;
    for (const Json& item : joints) {
        if (!item.contains("fused")) continue;
        const std::string where = "\"fused\" of joint " + item["name"].dump();
        if (!item["fused"].is_array()) refuse(where + " is no list");
        auto& [joint, names] = out.emplace_back(item["name"].get<std::string>(), std::vector<std::string>{});
        for (const Json& name : item["fused"]) names.push_back(to_text(name, "a name in " + where));
    }
    return out;
}

BodyFrame<double> to_frame(const Json& value) {
    const auto axis = [&](const char* key) {
        return to_vector(member(value, key, "\"frame\""), "\"" + std::string(key) + "\" in \"frame\"");
    };
    return {axis("origin"), axis("left"), axis("forward"), axis("up")};
}

Quality to_quality(const Json& value) {
    const std::string where = "\"quality\"";
    Quality quality;
    quality.sides_confidence = to_number(member(value, "sides_confidence", where), "\"sides_confidence\"");
    quality.matched_nodes = static_cast<int>(to_count(member(value, "matched_nodes", where), "\"matched_nodes\""));
    if (value.contains("side_votes")) {
        if (!value["side_votes"].is_object()) refuse("\"side_votes\" is no object");
        for (const auto& [witness, strength] : value["side_votes"].items())
            quality.side_votes.push_back({witness, to_number(strength, "the vote of " + witness)});
    }
    const Json& warnings = member(value, "warnings", where);
    if (!warnings.is_array()) refuse("\"warnings\" is no list");
    for (const Json& warning : warnings) quality.warnings.push_back(to_text(warning, "a warning"));
    return quality;
}

SourceMesh to_source_mesh(const Json& value) {
    const std::string where = "\"mesh\"";
    return {to_text(member(value, "file", where), "the mesh's file"),
            to_count(member(value, "vertices", where), "the mesh's number of vertices"),
            to_count(member(value, "faces", where), "the mesh's number of faces"),
            to_number(member(value, "geodesic_diameter", where), "the mesh's geodesic diameter")};
}

FileTimings to_timings(const Json& value) {
    const auto ms = [&](const char* key) {
        return to_number(member(value, key, "\"timings_ms\""), "\"" + std::string(key) + "\" in \"timings_ms\"");
    };
    const double surface = value.contains("surface") ? ms("surface") : 0; // which older files do not have
    return {ms("read"), {surface, ms("curve"), ms("embed"), ms("refine"), ms("sides"), ms("total")}};
}

void check_format(const Json& document) {
    const std::string where = "the file";
    if (to_text(member(document, "format", where), "\"format\"") != format_name)
        refuse("its \"format\" is not \"" + std::string(format_name) + "\"");
    if (to_count(member(document, "version", where), "\"version\"") != format_version)
        throw Error(ErrorCode::bad_input, "is a skeleton file of a version other than " +
                                              std::to_string(format_version) + ", the one this skelgen reads");
}

} // namespace

template <typename Scalar>
std::string skeleton_to_json(const KinematicSkeleton<Scalar>& skeleton, const SkeletonProvenance& provenance) {
    std::string text =
        "{\n  \"format\": " + to_json_text(format_name) + ", \"version\": " + number(format_version) + ",\n";
    text += "  \"generator\": {\"name\": \"skelgen\", \"version\": " + to_json_text(std::string(version)) + "},\n";
    if (provenance.mesh) text += "  \"mesh\": " + mesh_text(*provenance.mesh) + ",\n";
    text += "  \"template\": " + to_json_text(skeleton.template_name) + ",\n";
    text += "  \"joints\": " + joints_text(skeleton.joints, provenance) + ",\n";
    text += "  \"end_points\": " + end_points_text(skeleton.end_points) + ",\n";
    text += "  \"frame\": " + frame_text(skeleton.frame) + ",\n";
    text += "  \"quality\": " + quality_text(skeleton.quality);
    if (provenance.timings_ms) text += ",\n  \"timings_ms\": " + timings_text(*provenance.timings_ms);
    return text + "\n}\n";
}

template <typename Scalar>
void write_skeleton(const std::filesystem::path& path, const KinematicSkeleton<Scalar>& skeleton,
                    const SkeletonProvenance& provenance) {
    write_file_atomically(path, skeleton_to_json(skeleton, provenance));
}

SkeletonDocument parse_skeleton_document(std::string_view json) {
    const Json file = detail::parse_json(json);
    check_format(file);
    SkeletonDocument document;
    document.skeleton.template_name = to_text(member(file, "template", "the file"), "\"template\"");
    read_joints(member(file, "joints", "the file"), document.skeleton);
    const Json& end_points = member(file, "end_points", "the file");
    if (!end_points.is_object()) refuse("\"end_points\" is no object");
    for (const auto& [name, position] : end_points.items())
        document.skeleton.end_points.emplace_back(name, to_vector(position, "the end point \"" + name + "\""));
    document.skeleton.frame = to_frame(member(file, "frame", "the file"));
    document.skeleton.quality = to_quality(member(file, "quality", "the file"));
    if (file.contains("mesh")) document.provenance.mesh = to_source_mesh(file["mesh"]);
    document.provenance.fused = to_fused(file["joints"]);
    if (file.contains("timings_ms")) document.provenance.timings_ms = to_timings(file["timings_ms"]);
    return document;
}

SkeletonDocument read_skeleton_document(const std::filesystem::path& path) {
    return parse_skeleton_document(read_file(path));
}

KinematicSkeleton<double> read_skeleton(const std::filesystem::path& path) {
    return read_skeleton_document(path).skeleton;
}

template std::string skeleton_to_json(const KinematicSkeleton<float>&, const SkeletonProvenance&);
template std::string skeleton_to_json(const KinematicSkeleton<double>&, const SkeletonProvenance&);
template void write_skeleton(const std::filesystem::path&, const KinematicSkeleton<float>&, const SkeletonProvenance&);
template void write_skeleton(const std::filesystem::path&, const KinematicSkeleton<double>&, const SkeletonProvenance&);

} // namespace skelgen::io
