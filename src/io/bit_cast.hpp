#pragma once

#include <bit>
#include <version>
#ifndef __cpp_lib_bit_cast
#include <cstring>
#endif

namespace skelgen::io::detail {

/// As `std::bit_cast`, which not every standard library has that is otherwise sufficient.
template <typename To, typename From>
[[nodiscard]] To bit_cast(const From& from) {
    static_assert(sizeof(To) == sizeof(From));
#ifdef __cpp_lib_bit_cast
    return std::bit_cast<To>(from);
#else
    To to;
    std::memcpy(&to, &from, sizeof(To));
    return to;
#endif
}

} // namespace skelgen::io::detail
