#pragma once

#include <array>
#include <charconv>
#include <string>
#include <type_traits>
#include <version>
#ifndef __cpp_lib_to_chars
#include <cstdio>
#include <cstdlib>
#include <limits>
#endif

namespace skelgen::io::detail {

/// Appends the shortest text that reads back as exactly this number, the same in every locale.
template <typename Number>
void append_number(std::string& text, Number value) {
    std::array<char, 32> buffer; // the longest double takes 24
#ifndef __cpp_lib_to_chars       // libc++ has it for whole numbers alone
    if constexpr (std::is_floating_point_v<Number>) {
        int digits = std::numeric_limits<Number>::digits10;
        int length = 0;
        do {
            length = std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, static_cast<double>(value));
        } while (static_cast<Number>(std::strtod(buffer.data(), nullptr)) != value &&
                 ++digits <= std::numeric_limits<Number>::max_digits10);
        text.append(buffer.data(), static_cast<std::size_t>(length));
        return;
    } else
#endif
    {
        const std::to_chars_result result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
        text.append(buffer.data(), result.ptr);
    }
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
