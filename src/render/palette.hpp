#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace skelgen::render {

/// Each 0 to 1, as written to the file (sRGB).
struct Colour {
    float red = 0;
    float green = 0;
    float blue = 0;
};

/// A colour's part, 0 to 1, as it is written: 0 to 255.
inline std::uint8_t to_byte(float part) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.0f, 1.0f)));
}

/// Every colour of our pictures, in one place. Blue and yellow stay apart for every kind of colour blindness.
namespace palette {
inline constexpr Colour left{0.10f, 0.42f, 0.90f};
inline constexpr Colour right{0.99f, 0.72f, 0.05f};
inline constexpr Colour middle{0.30f, 0.33f, 0.38f};
inline constexpr Colour curve{0.80f, 0.16f, 0.50f};
inline constexpr Colour mark{0.87f, 0.08f, 0.10f};
inline constexpr Colour text{0.16f, 0.18f, 0.22f};
inline constexpr Colour leader{0.62f, 0.65f, 0.70f};
inline constexpr Colour failure{0.80f, 0.08f, 0.10f};
inline constexpr Colour halo{1.00f, 1.00f, 1.00f};
} // namespace palette

} // namespace skelgen::render
