#pragma once

#include <cmath>

namespace skelgen::io::detail {

/// The light of a channel as it is shown, 0 to 1 (IEC 61966-2-1).
template <typename Number>
[[nodiscard]] Number linear_light(Number shown) {
    constexpr auto knee = Number(0.04045), slope = Number(12.92), offset = Number(0.055), power = Number(2.4);
    return shown <= knee ? shown / slope : std::pow((shown + offset) / (1 + offset), power);
}

/// The other way: how a channel of light is shown.
template <typename Number>
[[nodiscard]] Number shown_light(Number light) {
    constexpr auto knee = Number(0.0031308), slope = Number(12.92), offset = Number(0.055), power = Number(2.4);
    return light <= knee ? slope * light : (1 + offset) * std::pow(light, 1 / power) - offset;
}

} // namespace skelgen::io::detail
