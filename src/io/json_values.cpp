#include "json_values.hpp"

#include <algorithm>
#include <string>

#include <skelgen/core/error.hpp>

namespace skelgen::io::detail {

Json parse_json(std::string_view text) {
    try {
        return Json::parse(text);
    } catch (const Json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: ...": users can do without the first word.
        const std::string_view what = error.what();
        throw Error(ErrorCode::bad_input,
                    "is no valid JSON: " + std::string(what.substr(what.find(']') + 2)) + "; repair it");
    }
}

std::optional<Vector3<double>> to_point(const Json& value) {
    const bool is_point = value.is_array() && value.size() == 3 &&
                          std::all_of(value.begin(), value.end(), [](const Json& x) { return x.is_number(); });
    if (!is_point) return std::nullopt;
    return Vector3<double>(value[0].get<double>(), value[1].get<double>(), value[2].get<double>());
}

} // namespace skelgen::io::detail
