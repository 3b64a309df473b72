#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <skelgen/core/skeleton_template.hpp>

namespace skelgen {

/// Reads a template from JSON text (data/schema/template.schema.json is its schema) and validates it
/// (core/template_rules.hpp says by which rules).
/// \throws Error bad_input when the text is no JSON, no template, or breaks a rule.
[[nodiscard]] SkeletonTemplate parse_template(std::string_view json);

/// `parse_template` of a file's text.
/// \throws Error bad_input when the file cannot be read, and as `parse_template`.
[[nodiscard]] SkeletonTemplate read_template(const std::filesystem::path& file);

/// Names of the templates that are part of the library, in alphabetical order.
[[nodiscard]] std::vector<std::string> builtin_template_names();

/// A template that is part of the library; the reference stays valid until the program ends.
/// \throws Error usage when there is none of that name; the message lists those there are.
[[nodiscard]] const SkeletonTemplate& builtin_template(std::string_view name);

/// The template that a user asks for: a built-in one, or else the one in the file of that name.
/// \throws Error usage when it is neither, and as `read_template`, with the template's file in the message.
[[nodiscard]] SkeletonTemplate load_template(const std::string& name_or_file);

} // namespace skelgen
