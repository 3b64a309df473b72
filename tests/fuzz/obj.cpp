#include <cstddef>
#include <cstdint>

#include "expect.hpp"
#include "io/mesh_parsers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return skelgen::fuzz::run(data, size, [](std::string_view bytes) {
        skelgen::fuzz::expect_sound(skelgen::io::triangulate(skelgen::io::detail::parse_obj(bytes)));
    });
}
