#pragma once

#include <string>
#include <string_view>

#include <Eigen/Core>

namespace skelgen::io {

/// A 4 x 4 transform of columns as the text of a transform file (data/schema/transform.schema.json): JSON in UTF-8,
/// numbers in the shortest form that reads back the same. \throws Error internal when a number is not finite.
[[nodiscard]] std::string transform_to_json(const Eigen::Matrix4d& matrix);

/// Reads the text of a transform file. Keys it does not know are ignored.
/// \throws Error bad_input saying which part is missing or malformed.
[[nodiscard]] Eigen::Matrix4d parse_transform(std::string_view json);

} // namespace skelgen::io
