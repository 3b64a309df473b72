#pragma once

#include <string>
#include <string_view>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_mesh.hpp>

#include "catch.hpp"

namespace skelgen::test {

/// What the Error that reading `content` throws says, and that its code is bad_input.
inline std::string reading_error(std::string_view content, std::optional<io::MeshFormat> extension = std::nullopt) {
    try {
        static_cast<void>(io::parse_mesh(content, extension));
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        return error.what();
    }
    return "no error";
}

/// The unit tetrahedron that the tests of every format write in their own way: the origin and the unit vectors.
inline TriangleMesh<double> tetrahedron() {
    TriangleMesh<double> mesh;
    mesh.vertices.resize(4, 3);
    mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    mesh.faces.resize(4, 3);
    mesh.faces << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    return mesh;
}

inline void check_same(const TriangleMesh<double>& mesh, const TriangleMesh<double>& expected) {
    CHECK(mesh.vertices == expected.vertices);
    CHECK(mesh.faces == expected.faces);
}

inline void check_is_tetrahedron(std::string_view content, std::optional<io::MeshFormat> extension = std::nullopt) {
    INFO(content);
    check_same(io::parse_mesh(content, extension), tetrahedron());
}

} // namespace skelgen::test
