#include <cstddef>
#include <cstdint>

#include "expect.hpp"
#include "io/companion_file.hpp"
#include "io/mesh_parsers.hpp"
#include "io/obj_looks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return skelgen::fuzz::run(data, size, [](std::string_view bytes) {
        const auto mesh = skelgen::io::triangulate(skelgen::io::detail::parse_obj(bytes));
        skelgen::fuzz::expect_sound(mesh);
        if (const auto looks = skelgen::io::detail::read_obj_looks(bytes, skelgen::io::detail::refuse_companion))
            skelgen::fuzz::expect_looks_of(mesh, *looks);
    });
}
