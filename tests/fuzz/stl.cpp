#include <cstddef>
#include <cstdint>

#include "expect.hpp"
#include "io/mesh_parsers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return skelgen::fuzz::run(data, size, [](std::string_view bytes) {
        using namespace skelgen::io;
        const bool is_binary = detail::is_stl_binary(bytes);
        skelgen::fuzz::expect_sound(
            triangulate(is_binary ? detail::parse_stl_binary(bytes) : detail::parse_stl_text(bytes)));
    });
}
