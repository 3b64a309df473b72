#include <skelgen/render/png.hpp>

#include <png.h>

#include <skelgen/core/error.hpp>

namespace skelgen::render {

std::string encode_png(const Image& image) {
    if (image.width < 1 || image.height < 1) throw Error(ErrorCode::usage, "a picture without pixels cannot be a PNG");
    png_image header = {};
    header.version = PNG_IMAGE_VERSION;
    header.width = static_cast<png_uint_32>(image.width);
    header.height = static_cast<png_uint_32>(image.height);
    header.format = PNG_FORMAT_RGBA;

    // libpng's bound on the compressed size spares the second compression that asking for the exact size costs.
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
    std::string bytes(size, '\0');
    if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr) == 0)
        throw Error(ErrorCode::internal, std::string("libpng cannot encode the picture: ") + header.message);
    bytes.resize(size);
    return bytes;
}

} // namespace skelgen::render
