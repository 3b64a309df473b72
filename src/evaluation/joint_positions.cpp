#include <skelgen/evaluation/evaluate.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_file.hpp>

#include "io/json_values.hpp"

namespace skelgen::evaluation {
namespace {

using io::detail::Json;

/// \throws Json::exception where something is missing or of another kind.
JointPositions to_positions(const Json& document) {
    JointPositions positions;
    for (const Json& joint : document.at("joints")) {
        if (!joint.value("present", true)) continue;
        const auto position = io::detail::to_point(joint.at("position"));
        if (!position) return {};
        positions[joint.at("name").get<std::string>()] = *position;
    }
    if (const auto ends = document.find("end_points"); ends != document.end() && ends->is_object())
        for (const auto& [name, place] : ends->items())
            if (const auto position = io::detail::to_point(place)) positions.try_emplace(name, *position);
    return positions;
}

/// \throws Json::exception likewise.
JointConfidences to_confidences(const Json& document) {
    JointConfidences confidences;
    for (const Json& joint : document.at("joints"))
        if (joint.value("present", true) && joint.contains("confidence"))
            confidences[joint.at("name").get<std::string>()] = joint.at("confidence").get<double>();
    return confidences;
}

/// What `convert` makes of a skeleton file; empty where that is none.
template <typename Result, typename Convert>
Result read_of(const std::filesystem::path& path, const Convert& convert) {
    try {
        return convert(io::detail::parse_json(io::read_file(path)));
    } catch (const Error& error) {
        if (error.code() != ErrorCode::bad_input) throw;
    } catch (const Json::exception&) { // no joints, or joints without a name or a value, or one of another kind
    }
    return {};
}

} // namespace

JointPositions read_joint_positions(const std::filesystem::path& path) {
    return read_of<JointPositions>(path, to_positions);
}

JointConfidences read_joint_confidences(const std::filesystem::path& path) {
    return read_of<JointConfidences>(path, to_confidences);
}

} // namespace skelgen::evaluation
