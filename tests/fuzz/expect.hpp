#pragma once

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <skelgen/core/error.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/io/scene_looks.hpp>

#include "io/mesh_primitives.hpp"

/// What all fuzz targets share. A target is one reader: whatever the bytes, it gives a sound value or an Error about
/// the input; anything else ends the run as a finding.
namespace skelgen::fuzz {

inline void expect(bool condition) {
    if (!condition) std::abort();
}

inline void expect_sound(const TriangleMesh<double>& mesh) {
    expect(mesh.faces.rows() > 0 && mesh.vertices.allFinite());
    expect(mesh.faces.minCoeff() >= 0 && mesh.faces.maxCoeff() < mesh.vertices.rows());
}

/// Whether a mesh's looks can be written with it.
inline void expect_looks_of(const TriangleMesh<double>& mesh, const io::SceneLooks& looks) {
    if (mesh.vertices.cwiseAbs().maxCoeff() > 1e30) return; // beyond single precision, or near it
    io::detail::GltfBuffer buffer;
    const applications::VertexTurns<double> turns(static_cast<std::size_t>(mesh.vertices.rows()),
                                                  Eigen::Quaterniond::Identity());
    io::detail::Json scene;
    scene["meshes"] = {{{"primitives", io::detail::describe_primitives(buffer, {mesh, nullptr, turns, looks})}}};
    io::detail::add_materials(scene, buffer, looks);
    static_cast<void>(scene.dump()); // throws where a text is no UTF-8
}

/// Gives the bytes to `read`; the value is for libFuzzer.
template <typename Read>
int run(const std::uint8_t* data, std::size_t size, const Read& read) {
    try {
        read(std::string_view(reinterpret_cast<const char*>(data), size));
    } catch (const Error& error) {
        expect(error.code() == ErrorCode::bad_input);
    }
    return 0;
}

} // namespace skelgen::fuzz
