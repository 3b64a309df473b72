#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace skelgen::render {

/// One pixel: red, green, blue, opacity, each 0 to 255; the colours are not multiplied by the opacity.
using Pixel = std::array<std::uint8_t, 4>;

/// A picture as a plain value: `width` x `height` pixels, row by row from the top left.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<Pixel> pixels;

    Image() = default;
    Image(int columns, int rows, Pixel fill)
        : width(columns), height(rows),
          pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), fill) {}

    [[nodiscard]] Pixel& at(int x, int y) { return pixels[index(x, y)]; }
    [[nodiscard]] const Pixel& at(int x, int y) const { return pixels[index(x, y)]; }

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

} // namespace skelgen::render
