#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>

#include <skelgen/io/write_mesh.hpp>

#include "mesh_expectations.hpp"
#include "temporary_folder.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// Any finite number of any magnitude: random bits.
template <typename Scalar, typename Bits>
TriangleMesh<Scalar> random_mesh() {
    std::mt19937_64 random(11);
    TriangleMesh<Scalar> mesh;
    mesh.vertices.resize(500, 3);
    mesh.faces.resize(900, 3);
    for (Scalar& value : mesh.vertices.reshaped()) do
            value = std::bit_cast<Scalar>(static_cast<Bits>(random()));
        while (!std::isfinite(value));
    for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i) {
        const int first = static_cast<int>(random() % 497);
        mesh.faces.row(i) << first, first + 1 + static_cast<int>(random() % 2), first + 3;
    }
    return mesh;
}

template <typename Scalar>
void check_round_trip(const TriangleMesh<Scalar>& mesh, MeshFormat format) {
    const std::string bytes = format_mesh(mesh, format);
    const TriangleMesh<Scalar> again = parse_mesh<Scalar>(bytes);
    CHECK(again.vertices == mesh.vertices);
    CHECK(again.faces == mesh.faces);
    CHECK(format_mesh(again, format) == bytes);
}

std::string writing_error(const fs::path& path, const TriangleMesh<double>& mesh) {
    try {
        write_mesh(path, mesh);
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("write_mesh: OFF, OBJ and PLY give every bit back", "[io][write]") {
    for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj, MeshFormat::ply}) {
        check_round_trip(random_mesh<double, std::uint64_t>(), format);
        check_round_trip(random_mesh<float, std::uint32_t>(), format);
    }
}

TEST_CASE("write_mesh: numbers are as short as they can be", "[io][write]") {
    TriangleMesh<double> mesh = tetrahedron();
    mesh.vertices(1, 0) = 0.1;
    mesh.vertices(2, 1) = -1e-7;
    CHECK(format_mesh(mesh, MeshFormat::off) ==
          "OFF\n4 4 0\n0 0 0\n0.1 0 0\n0 -1e-07 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    CHECK(format_mesh(mesh, MeshFormat::obj) ==
          "v 0 0 0\nv 0.1 0 0\nv 0 -1e-07 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
}

TEST_CASE("write_mesh: STL keeps every corner in single precision, and normals point outwards", "[io][write]") {
    const std::string bytes = format_mesh(tetrahedron(), MeshFormat::stl);
    CHECK(bytes.size() == 84 + 4 * 50);
    const TriangleMesh<double> again = parse_mesh(bytes);
    REQUIRE(again.faces.rows() == 4);
    for (Eigen::Index i = 0; i < 4; ++i)
        for (int corner = 0; corner < 3; ++corner)
            CHECK(again.vertices.row(again.faces(i, corner)) ==
                  tetrahedron().vertices.row(tetrahedron().faces(i, corner)));
    std::array<float, 3> normal{};
    std::memcpy(normal.data(), bytes.data() + 84, sizeof(normal));
    CHECK(normal == std::array<float, 3>{0, 0, -1});
}

TEST_CASE("write_mesh: the extension chooses, in any case", "[io][write]") {
    const TemporaryFolder folder;
    for (const char* name : {"a.off", "b.OBJ", "c.Ply", "d.stl"}) {
        write_mesh(folder / name, tetrahedron());
        CHECK(read_mesh(folder / name).faces.rows() == 4);
        CHECK(fs::file_size(folder / name) == format_mesh(tetrahedron(), mesh_format_of(name).value()).size());
    }
    CHECK_THAT(writing_error(folder / "a.dae", tetrahedron()), Contains("must end in .off"));
    CHECK_THAT(writing_error(folder / "off", tetrahedron()), Contains("must end in .off"));
    CHECK_FALSE(mesh_format_of("a.json").has_value());
    CHECK_FALSE(mesh_format_of(".off").has_value()); // a hidden file without extension
}

TEST_CASE("write_mesh: meshes that no reader would take are refused, and nothing is written", "[io][write]") {
    const TemporaryFolder folder;
    TriangleMesh<double> bad = tetrahedron();
    bad.faces(0, 0) = 4;
    CHECK_THAT(writing_error(folder / "a.off", bad), Contains("does not exist"));
    bad.faces(0, 0) = -1;
    CHECK_THAT(writing_error(folder / "a.off", bad), Contains("does not exist"));
    bad = tetrahedron();
    bad.vertices(3, 2) = std::numeric_limits<double>::quiet_NaN();
    CHECK_THAT(writing_error(folder / "a.ply", bad), Contains("not a number"));
    bad.vertices(3, 2) = 1e39;
    CHECK_THAT(writing_error(folder / "a.stl", bad), Contains("too large for STL"));
    CHECK_THAT(writing_error(folder / "missing/a.off", tetrahedron()), Contains("its folder does not exist"));
    CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("read_mesh: files that cannot be read", "[io][read]") {
    const TemporaryFolder folder;
    const auto error_of = [](const fs::path& path) {
        try {
            static_cast<void>(read_mesh(path));
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::bad_input);
            return std::string(error.what());
        }
        return std::string("no error");
    };
    CHECK_THAT(error_of(folder / "missing.off"), Contains("No such file"));
    CHECK_THAT(error_of(folder.path()), Contains("is a folder"));
    std::ofstream(folder / "empty.off").close();
    CHECK_THAT(error_of(folder / "empty.off"), Contains("empty"));
    std::ofstream(folder / "text.txt") << "Lorem ipsum\n";
    CHECK_THAT(error_of(folder / "text.txt"), Contains("no mesh in a known format"));
}

TEST_CASE("read_mesh: what a file holds counts, not its name", "[io][read]") {
    const TemporaryFolder folder;
    write_mesh(folder / "a.ply", tetrahedron());
    for (const char* name : {"a.off", "a.obj", "a.stl", "a.txt", "a"}) {
        fs::copy_file(folder / "a.ply", folder / name);
        check_same(read_mesh(folder / name), tetrahedron());
    }
}
