#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <string_view>

#include "bit_cast.hpp"

namespace skelgen::io::detail {

/// Appends the bytes of a number, the least significant first.
template <typename T>
void append_little_endian(std::string& bytes, T value) {
    auto raw = bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (std::endian::native != std::endian::little) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
}

/// The number that the first of these bytes are, the least significant first.
template <typename T>
T read_little_endian(std::string_view bytes) {
    std::array<char, sizeof(T)> raw{};
    std::copy_n(bytes.begin(), raw.size(), raw.begin());
    if constexpr (std::endian::native != std::endian::little) std::reverse(raw.begin(), raw.end());
    return bit_cast<T>(raw);
}

} // namespace skelgen::io::detail
