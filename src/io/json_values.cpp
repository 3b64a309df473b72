#include "json_values.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <skelgen/core/error.hpp>

namespace skelgen::io::detail {

namespace {

/// Refuses what no file of ours has and what would take long: a new key is compared with all others of its object, and
/// each level of nesting takes a hundred times the memory of its one byte.
class Limits {
public:
    bool operator()(int depth, Json::parse_event_t event, const Json&) {
        if (depth > deepest_nesting) throw Error(ErrorCode::bad_input, "is JSON that is nested too deeply; repair it");
        const auto level = static_cast<std::size_t>(depth);
        if (event == Json::parse_event_t::object_start) keys_[level + 1] = 0;
        if (event == Json::parse_event_t::key && ++keys_[level] > most_keys)
            throw Error(ErrorCode::bad_input, "is JSON with an object of too many keys; repair it");
        return true;
    }

private:
    static constexpr int deepest_nesting = 100, most_keys = 10000;
    std::array<int, deepest_nesting + 2> keys_{}; ///< of the object that is being read at each level of nesting
};

} // namespace

Json parse_json(std::string_view text) {
    try {
        return Json::parse(text, Limits());
    } catch (const Json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: ...": users can do without the first word.
        const std::string_view what = error.what();
        throw Error(ErrorCode::bad_input,
                    "is no valid JSON: " + valid_utf8(std::string(what.substr(what.find(']') + 2))) + "; repair it");
    }
}

std::string valid_utf8(const std::string& text) {
    const std::string quoted = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
    return Json::parse(quoted).get<std::string>();
}

std::optional<Vector3<double>> to_point(const Json& value) {
    const bool is_point = value.is_array() && value.size() == 3 &&
                          std::all_of(value.begin(), value.end(), [](const Json& x) { return x.is_number(); });
    if (!is_point) return std::nullopt;
    return Vector3<double>(value[0].get<double>(), value[1].get<double>(), value[2].get<double>());
}

} // namespace skelgen::io::detail
