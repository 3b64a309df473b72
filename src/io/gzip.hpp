#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace skelgen::io::detail {

/// Whether the bytes begin as those of a file that gzip has compressed.
[[nodiscard]] bool is_gzip(std::string_view bytes);

/// What gzip has compressed, of one member or of several one behind the other. Linear in the result.
/// \throws Error bad_input when the bytes are damaged or cut short, when the result would be larger than `limit`, or
/// more
///         than 256 times the input: no mesh shrinks like that. Without zlib in this build: what to do.
[[nodiscard]] std::string gunzip(std::string_view bytes, std::size_t limit);

/// The bytes compressed as gzip does, always the same for the same bytes. \throws Error usage without zlib.
[[nodiscard]] std::string gzip(std::string_view bytes);

/// The bytes in zlib's own format, always the same for the same bytes; none without zlib.
[[nodiscard]] std::optional<std::string> zlib_compressed(std::string_view bytes);

} // namespace skelgen::io::detail
