#include <cstddef>
#include <cstdint>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_mesh.hpp>

#include "expect.hpp"
#include "io/gltf_looks.hpp"
#include "io/gltf_parser.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return skelgen::fuzz::run(data, size, [](std::string_view bytes) {
        using namespace skelgen;
        const auto no_companion = [](const std::string&) -> std::string {
            throw Error(ErrorCode::bad_input, "there are no other files");
        };
        const std::string first_animation =
            bytes.find("\"animations\"") == std::string_view::npos ? "" : "1"; // none would be wrong usage
        const io::ReadMeshOptions options{io::MeshFormat::glb, first_animation, 0.5};
        TriangleMesh<double> mesh;
        try {
            mesh = io::triangulate(io::detail::parse_gltf(bytes, options, no_companion));
        } catch (const Error& error) {
            if (error.code() == ErrorCode::usage) return; // its list of animations is empty
            throw;
        }
        fuzz::expect_sound(mesh);
        fuzz::expect_looks_of(mesh, io::detail::read_gltf_looks(bytes, options, no_companion));
    });
}
