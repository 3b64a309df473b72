#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace skelgen::detail {

/// The whole file as it is.
/// \throws Error bad_input when it cannot be read.
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path);

/// Parses JSON, keeping the order of the keys.
/// \throws Error bad_input with the place of the first mistake.
[[nodiscard]] nlohmann::ordered_json parse_json(std::string_view text);

} // namespace skelgen::detail
