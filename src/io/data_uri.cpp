#include "data_uri.hpp"

#include <charconv>
#include <cstddef>

#include "base64.hpp"

namespace skelgen::io::detail {

bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

std::optional<std::string> decode_data_uri(std::string_view uri) {
    constexpr std::string_view encoding = ";base64";
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(encoding)) return std::nullopt;
    return decode_base64(uri.substr(comma + 1));
}

std::string percent_decoded(std::string_view uri) {
    std::string decoded;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned value = 0;
        const char* const digits = uri.data() + i + 1;
        const bool is_escape =
            uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2;
        decoded += is_escape ? static_cast<char>(value) : uri[i];
        if (is_escape) i += 2;
    }
    return decoded;
}

} // namespace skelgen::io::detail
