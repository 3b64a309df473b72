#pragma once

#include <optional>
#include <string_view>

namespace skelgen::io::detail {

/// The media type of a picture that glTF knows, by its first bytes; none where it is another one, or none.
[[nodiscard]] inline std::optional<std::string_view> picture_kind(std::string_view bytes) {
    constexpr std::string_view png_magic = "\x89PNG", jpeg_magic = "\xFF\xD8\xFF", webp_magic = "RIFF";
    if (bytes.starts_with(png_magic)) return "image/png";
    if (bytes.starts_with(jpeg_magic)) return "image/jpeg";
    if (bytes.starts_with(webp_magic)) return "image/webp";
    return std::nullopt;
}

/// Is that one of those types?
[[nodiscard]] inline bool is_known_kind(std::string_view type) {
    return type == "image/png" || type == "image/jpeg" || type == "image/webp";
}

} // namespace skelgen::io::detail
