#include <cstddef>
#include <cstdint>

#include "expect.hpp"
#include <skelgen/io/read_mesh.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return skelgen::fuzz::run(data, size, [](std::string_view bytes) {
        // The choice of the reader by content, and what is compressed. FBX and DAE are read in another process.
        const bool is_elsewhere =
            bytes.find("FBX") != std::string_view::npos || bytes.find("COLLADA") != std::string_view::npos;
        if (!is_elsewhere) skelgen::fuzz::expect_sound(skelgen::io::parse_mesh(bytes));
    });
}
