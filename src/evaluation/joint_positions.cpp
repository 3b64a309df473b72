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
    return positions;
}

} // namespace

JointPositions read_joint_positions(const std::filesystem::path& path) {
    try {
        return to_positions(io::detail::parse_json(io::read_file(path)));
    } catch (const Error& error) {
        if (error.code() != ErrorCode::bad_input) throw;
    } catch (const Json::exception&) { // no joints, or joints without name or position
    }
    return {};
}

} // namespace skelgen::evaluation
