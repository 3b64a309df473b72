#pragma once

#include <array>
#include <charconv>
#include <string>

namespace skelgen::io::detail {

/// Appends the shortest text that reads back as exactly this number, the same in every locale.
template <typename Number>
void append_number(std::string& text, Number value) {
    std::array<char, 32> buffer; // the longest double takes 24
    const std::to_chars_result result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    text.append(buffer.data(), result.ptr);
}

/// Appends the three coordinates of a point (any Eigen vector), `separator` between them.
template <typename Point>
void append_point(std::string& text, const Point& point, const char* separator = " ") {
    append_number(text, point[0]);
    text += separator;
    append_number(text, point[1]);
    text += separator;
    append_number(text, point[2]);
}

} // namespace skelgen::io::detail
