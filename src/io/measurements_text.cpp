#include <skelgen/io/measurements_text.hpp>

#include <cmath>
#include <optional>
#include <utility>

#include <skelgen/core/error.hpp>

#include "application_json.hpp"
#include "number_text.hpp"

namespace skelgen::io {
namespace {

/// All measures of a body in the order in which they are written.
std::vector<std::pair<std::string, std::optional<double>>> columns(const applications::Measurements& measures) {
    std::vector<std::pair<std::string, std::optional<double>>> out{{"height", measures.height},
                                                                   {"arm_span", measures.arm_span},
                                                                   {"area", measures.area},
                                                                   {"volume", measures.volume}};
    for (const auto& [name, value] : measures.lengths) out.emplace_back("length_" + name, value);
    for (const auto& [name, value] : measures.girths) out.emplace_back("girth_" + name, value);
    for (const auto& [name, value] : out)
        if (value && !std::isfinite(*value))
            throw Error(ErrorCode::internal, "the measure '" + name + "' is not a finite number");
    return out;
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

} // namespace

std::string measurements_to_json(const std::vector<MeasuredBody>& bodies) {
    using detail::Json;
    Json list = Json::array();
    for (const MeasuredBody& body : bodies) {
        static_cast<void>(columns(body.measures)); // all of them finite
        Json lengths = Json::object(), girths = Json::object();
        for (const auto& [name, value] : body.measures.lengths) lengths[name] = value;
        for (const auto& [name, value] : body.measures.girths) girths[name] = value ? Json(*value) : Json();
        list.push_back({{"mesh", detail::to_json(body.mesh)},
                        {"height", body.measures.height},
                        {"arm_span", body.measures.arm_span},
                        {"area", body.measures.area},
                        {"volume", body.measures.volume},
                        {"lengths", lengths},
                        {"girths", girths},
                        {"quality", detail::to_json(body.quality)}});
    }
    return Json{{"format", "skelgen-measurements"}, {"version", 1}, {"bodies", list}}.dump(1) + "\n";
}

std::string measurements_to_csv(const std::vector<MeasuredBody>& bodies) {
    std::string text;
    for (const MeasuredBody& body : bodies) {
        const auto values = columns(body.measures);
        if (text.empty()) {
            text = "file,sides_confidence";
            for (const auto& [name, value] : values) text += "," + name;
            text += "\r\n";
        }
        text += quoted(detail::valid_utf8(body.mesh.file)) + ",";
        detail::append_number(text, body.quality.sides_confidence);
        for (const auto& [name, value] : values) {
            text += ',';
            if (value) detail::append_number(text, *value);
        }
        text += "\r\n";
    }
    return text;
}

} // namespace skelgen::io
