#pragma once

#include <string>

#include <skelgen/render/image.hpp>

namespace skelgen::render {

/// The picture as the bytes of a PNG file, 8 bits per channel with opacity. The same picture gives the same bytes.
/// \throws Error usage when the picture has no pixels, internal when libpng refuses.
[[nodiscard]] std::string encode_png(const Image& image);

} // namespace skelgen::render
