#include <cstddef>
#include <cstdint>
#include <string>

#include "expect.hpp"
#include "io/mesh_parsers.hpp"
#include "io/obj_looks.hpp"

/// The bytes are the file of materials of a mesh that is sound.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return skelgen::fuzz::run(data, size, [](std::string_view bytes) {
        const std::string_view obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 1\n"
                                     "usemtl a\nf 1/1 3/2 2/1\nf 1 2 4\nusemtl b\nf 1/2 4/1 3/1\nf 2 3 4\n";
        const auto looks =
            skelgen::io::detail::read_obj_looks(obj, [&](const std::string&) { return std::string(bytes); });
        skelgen::fuzz::expect(looks.has_value());
        skelgen::fuzz::expect_looks_of(skelgen::io::triangulate(skelgen::io::detail::parse_obj(obj)), *looks);
    });
}
