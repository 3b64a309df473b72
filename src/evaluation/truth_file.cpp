#include <skelgen/evaluation/evaluate.hpp>

#include <cmath>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>

#include "../io/json_file.hpp"

namespace skelgen {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& what) {
    throw Error(ErrorCode::bad_input, "is no truth file: " + what +
                                          "; it needs \"scale\", \"joints\" and \"markers\", both {name: [x, y, z]}");
}

Vector3<double> to_point(const Json& value, const std::string& name) {
    if (!value.is_array() || value.size() != 3) refuse("\"" + name + "\" is no list of three numbers");
    Vector3<double> point;
    for (int i = 0; i < 3; ++i) {
        const Json& coordinate = value[static_cast<std::size_t>(i)];
        if (!coordinate.is_number()) refuse("\"" + name + "\" is no list of three numbers");
        point[i] = coordinate.get<double>();
    }
    return point;
}

const Json& points(const Json& document, const char* key) {
    if (!document.is_object() || !document.contains(key) || !document[key].is_object())
        refuse("\"" + std::string(key) + "\" is missing or no object");
    return document[key];
}

bool is_not_a_body(const Json& document) {
    const auto found = document.find("not_a_body");
    return found != document.end() && *found == true;
}

} // namespace

GroundTruth read_ground_truth(const std::filesystem::path& path) {
    const Json document = detail::parse_json(detail::read_text_file(path));
    GroundTruth truth;
    truth.not_a_body = is_not_a_body(document);
    if (truth.not_a_body) return truth;
    for (const auto& [name, point] : points(document, "joints").items())
        truth.joints.emplace_back(name, to_point(point, name));
    for (const auto& [name, point] : points(document, "markers").items()) truth.markers[name] = to_point(point, name);
    if (!document.contains("scale") || !document["scale"].is_number()) refuse("\"scale\" is missing or no number");
    truth.scale = document["scale"].get<double>();
    if (!(truth.scale > 0) || !std::isfinite(truth.scale)) refuse("\"scale\" is not above zero");
    return truth;
}

JointPositions read_joint_positions(const std::filesystem::path& path) {
    JointPositions positions;
    try {
        const Json document = detail::parse_json(detail::read_text_file(path));
        for (const Json& joint : document.at("joints")) {
            const auto coordinates = joint.at("position").get<std::vector<double>>();
            if (coordinates.size() != 3) return {};
            positions[joint.at("name").get<std::string>()] = Vector3<double>(coordinates.data());
        }
    } catch (const Error&) {
        return {};
    } catch (const Json::exception&) {
        return {};
    }
    return positions;
}

} // namespace skelgen
