#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skelgen::io::detail {

/// Bytes in base64 (RFC 4648 section 4), padded. Linear.
[[nodiscard]] std::string encode_base64(std::string_view bytes);

/// The bytes of a text in base64, with or without padding; none where it holds another character. Linear.
[[nodiscard]] std::optional<std::string> decode_base64(std::string_view text);

} // namespace skelgen::io::detail
