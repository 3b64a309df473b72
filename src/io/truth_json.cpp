#include <skelgen/io/truth_json.hpp>

#include <cmath>
#include <utility>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_file.hpp>

#include "json_values.hpp"

namespace skelgen::io {
namespace {

using detail::Json;

[[noreturn]] void refuse(const std::string& what) {
    throw Error(ErrorCode::bad_input, "is no truth file: " + what +
                                          "; it needs \"scale\", \"joints\" and \"markers\", both {name: [x, y, z]}");
}

NamedPoints read_points(const Json& document, const char* key) {
    if (!document.is_object() || !document.contains(key) || !document[key].is_object())
        refuse("\"" + std::string(key) + "\" is missing or no object");
    NamedPoints points;
    for (const auto& [name, value] : document[key].items()) {
        const auto point = detail::to_point(value);
        if (!point) refuse("\"" + name + "\" is no list of three numbers");
        points.emplace_back(name, *point);
    }
    return points;
}

double read_scale(const Json& document) {
    if (!document.contains("scale") || !document["scale"].is_number()) refuse("\"scale\" is missing or no number");
    const double scale = document["scale"].get<double>();
    if (!(scale > 0) || !std::isfinite(scale)) refuse("\"scale\" is not above zero");
    return scale;
}

std::set<std::string> read_missing(const Json& document) {
    std::set<std::string> names;
    if (!document.contains("missing")) return names;
    if (!document["missing"].is_array()) refuse("\"missing\" is no list");
    for (const Json& name : document["missing"]) {
        if (!name.is_string()) refuse("\"missing\" has something that is no name");
        names.insert(name.get<std::string>());
    }
    return names;
}

bool is_not_a_body(const Json& document) {
    const auto found = document.find("not_a_body");
    return found != document.end() && *found == true;
}

} // namespace

GroundTruth read_ground_truth(const std::filesystem::path& path) {
    const Json document = detail::parse_json(read_file(path));
    GroundTruth truth;
    truth.not_a_body = is_not_a_body(document);
    if (truth.not_a_body) return truth;
    truth.joints = read_points(document, "joints");
    for (const auto& [name, point] : read_points(document, "markers")) truth.markers[name] = point;
    truth.scale = read_scale(document);
    truth.missing = read_missing(document);
    for (const char* kind : {"fingers", "toes"})
        if (document.contains(kind))
            for (auto& joint : read_points(document, kind)) truth.digits.push_back(std::move(joint));
    if (const auto expect = document.find("expect"); expect != document.end() && *expect == "quadruped")
        truth.plan = BodyKind::quadruped;
    return truth;
}

NamedPoints read_true_joints(const std::filesystem::path& path) {
    return read_points(detail::parse_json(read_file(path)), "joints");
}

} // namespace skelgen::io
