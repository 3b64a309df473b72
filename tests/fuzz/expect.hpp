#pragma once

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <skelgen/core/error.hpp>
#include <skelgen/core/mesh.hpp>

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
