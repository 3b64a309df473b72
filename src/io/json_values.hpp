#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include <skelgen/core/mesh.hpp>

/// What all readers of JSON files share.
namespace skelgen::io::detail {

/// JSON with its keys in the order in which they are written.
using Json = nlohmann::ordered_json;

/// The text with what is no UTF-8 replaced: messages may quote anything that files hold.
[[nodiscard]] std::string valid_utf8(const std::string& text);

/// \throws Error bad_input with the place of the first mistake when `text` is no JSON, or when it is nested deeper than
///         100 levels or has an object of more than 10,000 keys.
[[nodiscard]] Json parse_json(std::string_view text);

/// The point that a list of three numbers stands for; none when `value` is something else.
[[nodiscard]] std::optional<Vector3<double>> to_point(const Json& value);

} // namespace skelgen::io::detail
