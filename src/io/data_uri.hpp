#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skelgen::io::detail {

/// Whether a reference holds what it refers to ("data:...").
[[nodiscard]] bool is_data_uri(std::string_view uri);

/// The bytes that a data URI in base64 holds; none when it is in another encoding or not well formed.
[[nodiscard]] std::optional<std::string> decode_data_uri(std::string_view uri);

/// A reference with its %41 replaced by the bytes that they stand for.
[[nodiscard]] std::string percent_decoded(std::string_view uri);

} // namespace skelgen::io::detail
