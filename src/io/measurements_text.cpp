#include <skelgen/io/measurements_text.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <skelgen/applications/rig.hpp>
#include <skelgen/core/error.hpp>

#include "application_json.hpp"
#include "number_text.hpp"

namespace skelgen::io {
namespace {

std::string unit_name(double metres) { return metres == 1 ? "m" : metres == 0.01 ? "cm" : metres == 0.001 ? "mm" : ""; }

/// All measures of a body in the order in which they are written.
std::vector<std::pair<std::string, std::optional<double>>> columns(const applications::Measurements& measures) {
    std::vector<std::pair<std::string, std::optional<double>>> out{{"height", measures.height}};
    if (measures.arm_span > 0) out.emplace_back("arm_span", measures.arm_span); // an animal has none
    out.emplace_back("area", measures.area);
    out.emplace_back("volume", measures.volume);
    for (const auto& [name, value] : measures.lengths) out.emplace_back("length_" + name, value);
    for (const auto& [name, value] : measures.girths) out.emplace_back("girth_" + name, value);
    for (const auto& [name, value] : out)
        if (value && !std::isfinite(*value))
            throw Error(ErrorCode::internal, "the measure '" + name + "' is not a finite number");
    return out;
}

/// The unit that makes the body as high as people are; null where none does.
detail::Json unit_of(const applications::Measurements& measures) {
    const double metres = applications::metres_per_unit(measures.height);
    if (metres == 0) return {};
    return {{"name", unit_name(metres)}, {"metres", metres}};
}

/// Where the girths were taken.
detail::Json places_of(const applications::Measurements& measures) {
    detail::Json out = detail::Json::object();
    for (std::size_t i = 0; i < measures.girths.size(); ++i) {
        const auto& plane = measures.girth_planes.at(i);
        const auto numbers = [](const Vector3<double>& v) { return detail::Json{v[0], v[1], v[2]}; };
        out[measures.girths[i].first] =
            plane ? detail::Json{{"place", numbers(plane->place)}, {"normal", numbers(plane->normal)}} : detail::Json();
    }
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
        Json measured{{"mesh", detail::to_json(body.mesh)},
                      {"unit", unit_of(body.measures)},
                      {"height", body.measures.height},
                      {"arm_span", body.measures.arm_span},
                      {"area", body.measures.area},
                      {"volume", body.measures.volume},
                      {"lengths", lengths},
                      {"girths", girths},
                      {"girth_places", places_of(body.measures)},
                      {"quality", detail::to_json(body.quality)}};
        if (!(body.measures.arm_span > 0)) measured.erase("arm_span");
        list.push_back(std::move(measured));
    }
    return Json{{"format", "skelgen-measurements"}, {"version", 1}, {"bodies", list}}.dump(1) + "\n";
}

std::string measurements_to_csv(const std::vector<MeasuredBody>& bodies) {
    std::string text;
    for (const MeasuredBody& body : bodies) {
        const auto values = columns(body.measures), first = columns(bodies.front().measures);
        if (text.empty()) {
            text = "file,sides_confidence";
            for (const auto& [name, value] : values) text += "," + name;
            text += ",unit\r\n";
        } else if (!std::equal(values.begin(), values.end(), first.begin(), first.end(),
                               [](const auto& one, const auto& other) { return one.first == other.first; })) {
            throw Error(ErrorCode::usage, "people and animals have not the same measures, and a table one set of "
                                          "columns: write JSON, or a table of each");
        }
        text += quoted(detail::valid_utf8(body.mesh.file)) + ",";
        detail::append_number(text, body.quality.sides_confidence);
        for (const auto& [name, value] : values) {
            text += ',';
            if (value) detail::append_number(text, *value);
        }
        text += "," + unit_name(applications::metres_per_unit(body.measures.height)) + "\r\n";
    }
    return text;
}

} // namespace skelgen::io
