#pragma once

#include <string>
#include <string_view>

namespace skelgen::io::detail {

/// Bytes in base64 (RFC 4648 section 4), padded. Linear.
[[nodiscard]] std::string encode_base64(std::string_view bytes);

} // namespace skelgen::io::detail
