#include <cstddef>
#include <cstdint>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_mesh.hpp>

#include "expect.hpp"
#include "io/gltf_parser.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return skelgen::fuzz::run(data, size, [](std::string_view bytes) {
        using namespace skelgen;
        const auto no_companion = [](const std::string&) -> std::string {
            throw Error(ErrorCode::bad_input, "there are no other files");
        };
        const std::string first_animation =
            bytes.find("\"animations\"") == std::string_view::npos ? "" : "1"; // none would be wrong usage
        try {
            fuzz::expect_sound(io::triangulate(
                io::detail::parse_gltf(bytes, {io::MeshFormat::glb, first_animation, 0.5}, no_companion)));
        } catch (const Error& error) {
            if (error.code() != ErrorCode::usage) throw; // its list of animations is empty
        }
    });
}
