#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace skelgen::test {

/// What is wrong with `document` according to the JSON Schema (draft 7) in `schema_file`, one fault a line; empty when
/// nothing is. Its validator is compiled once for all tests.
[[nodiscard]] std::string schema_faults(const nlohmann::json& document, const std::filesystem::path& schema_file);

} // namespace skelgen::test
