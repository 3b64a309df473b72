#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::io {

/// Reads a template from JSON text (data/schema/template.schema.json is its schema) and validates it
/// (core/template_rules.hpp says by which rules). Positions are those of `TemplateJoint` in version 2 of the format; in
/// version 1 y points forward and z up, which is converted.
/// \throws Error bad_input when the text is no JSON, no template, or breaks a rule.
[[nodiscard]] SkeletonTemplate parse_template(std::string_view json);

/// `parse_template` of a file's text.
/// \throws Error bad_input when the file cannot be read, and as `parse_template`.
[[nodiscard]] SkeletonTemplate read_template(const std::filesystem::path& file);

/// The template that a user asks for: a built-in one, or else the one in the file of that name.
/// \throws Error usage when it is neither, and as `read_template`, with the template's file in the message.
[[nodiscard]] SkeletonTemplate load_template(const std::string& name_or_file);

/// The inverse of `parse_template`: version 2, one joint a line, numbers in the shortest form that reads back the same.
/// \throws Error bad_input when the template breaks a rule: it could not be read back.
[[nodiscard]] std::string template_to_json(const SkeletonTemplate& skeleton_template);

} // namespace skelgen::io

namespace skelgen {
using io::load_template;
using io::read_template;
} // namespace skelgen
