#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>

#include <skelgen/core/parallel.hpp>

#include "mesh_expectations.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;
using Catch::Matchers::Contains;

namespace {

const std::string rows = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

void append_big_endian(std::string& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += static_cast<char>((value >> static_cast<unsigned>(shift)) & 255U);
}

/// Geomview's binary layout, with `extra` floats behind each vertex and one colour component behind each face.
std::string binary_off(const std::string& keyword, int extra) {
    const TriangleMesh<double> mesh = tetrahedron();
    std::string bytes = keyword + " BINARY\n";
    for (const std::uint32_t count : {4U, 4U, 6U}) append_big_endian(bytes, count);
    for (Eigen::Index i = 0; i < 4; ++i) {
        for (int axis = 0; axis < 3; ++axis)
            append_big_endian(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(mesh.vertices(i, axis))));
        for (int k = 0; k < extra; ++k) append_big_endian(bytes, std::bit_cast<std::uint32_t>(0.5F));
    }
    for (Eigen::Index i = 0; i < 4; ++i) {
        append_big_endian(bytes, 3);
        for (int k = 0; k < 3; ++k) append_big_endian(bytes, static_cast<std::uint32_t>(mesh.faces(i, k)));
        append_big_endian(bytes, 1);
        append_big_endian(bytes, std::bit_cast<std::uint32_t>(0.5F));
    }
    return bytes;
}

} // namespace

TEST_CASE("OFF: every way to write the header", "[io][off]") {
    check_is_tetrahedron("OFF\n4 4 6\n" + rows);
    check_is_tetrahedron("OFF 4 4 6\n" + rows);
    check_is_tetrahedron("OFF4 4 6\n" + rows);
    check_is_tetrahedron("OFF\n4 4\n" + rows);
    check_is_tetrahedron("\xEF\xBB\xBFOFF\n4 4 6\n" + rows);
    check_is_tetrahedron("# a comment\n\nOFF # here too\n# and here\n\n4 4 0\n" + rows);
    check_is_tetrahedron("4 4 6\n" + rows, MeshFormat::off);
    for (const char* keyword : {"COFF", "NOFF", "CNOFF", "STOFF", "STCOFF", "STCNOFF"})
        check_is_tetrahedron(std::string(keyword) + "\n4 4 6\n" + rows);
}

TEST_CASE("OFF: ends of lines, comments and blanks", "[io][off]") {
    std::string windows = "OFF\n4 4 6\n" + rows, macintosh = windows;
    for (std::size_t i = 0; (i = windows.find('\n', i)) != std::string::npos; i += 2) windows.replace(i, 1, "\r\n");
    for (char& c : macintosh)
        if (c == '\n') c = '\r';
    check_is_tetrahedron(windows);
    check_is_tetrahedron(macintosh);
    check_is_tetrahedron("OFF\n4 4 6\n" + rows.substr(0, rows.size() - 1)); // no end of the last line
    check_is_tetrahedron("OFF\n4 4 6\n\n" + rows + "\n# the end\n\n");
    check_is_tetrahedron(
        "OFF\n4 4 6\n 0\t0 0#origin\n+1 0.0 0e3\n\n# y\n0 1. 0\n0 -0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3");
}

TEST_CASE("OFF: colours, normals and texture coordinates are skipped", "[io][off]") {
    check_is_tetrahedron("CNOFF\n4 4 6\n0 0 0 1 0 0 255 0 0 255\n1 0 0 1 0 0 255 0 0 255\n0 1 0 1 0 0 1 1 1 1\n"
                         "0 0 1 nan nan nan 1 1 1 1\n3 0 2 1 255 0 0\n3 0 1 3 0.5 0.5 0.5 1\n3 0 3 2 7\n3 1 2 3\n");
}

TEST_CASE("OFF: Geomview's binary form", "[io][off]") {
    check_is_tetrahedron(binary_off("OFF", 0));
    check_is_tetrahedron(binary_off("CNOFF", 7));
    const std::string bytes = binary_off("OFF", 0);
    for (std::size_t size = 11; size < bytes.size(); ++size) CHECK(reading_error(bytes.substr(0, size)) != "no error");
}

TEST_CASE("OFF: numbers are read to the last bit", "[io][off]") {
    const auto mesh = parse_mesh(
        "OFF\n3 1 0\n0.1 1e-320 -1.7976931348623157e308\n1e-400 123456789012345678901234567890 0.30000000000000004\n"
        "4.9e-324 2.2250738585072014e-308 9007199254740993\n3 0 1 2\n");
    CHECK(mesh.vertices(0, 0) == 0.1);
    CHECK(mesh.vertices(0, 1) == 1e-320);
    CHECK(mesh.vertices(0, 2) == -1.7976931348623157e308);
    CHECK(mesh.vertices(1, 0) == 0);
    CHECK(mesh.vertices(1, 1) == 123456789012345678901234567890.0);
    CHECK(mesh.vertices(1, 2) == 0.1 + 0.2);
    CHECK(mesh.vertices(2, 2) == 9007199254740992.0);
}

TEST_CASE("OFF: what is wrong is named with its line", "[io][off]") {
    const auto off = [](const std::string& body) { return reading_error("OFF\n" + body); };
    CHECK_THAT(off("3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n"), Contains("line 4: the z coordinate is missing"));
    CHECK_THAT(off("3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n"),
               Contains("line 4: the z coordinate is no usable number: 'x'"));
    CHECK_THAT(off("3 1 0\n0 0 0\n1 0 0.5mm\n0 1 0\n3 0 1 2\n"), Contains("'0.5mm'"));
    CHECK_THAT(off("3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"),
               Contains("line 4: the y coordinate is no usable number: 'nan'"));
    CHECK_THAT(off("3 1 0\n0 0 0\n-inf 0 0\n0 1 0\n3 0 1 2\n"), Contains("'-inf'"));
    CHECK_THAT(off("3 1 0\n0 0 0\n1e999 0 0\n0 1 0\n3 0 1 2\n"), Contains("'1e999'"));
    CHECK_THAT(off("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), Contains("line 6: a face names vertex 3"));
    CHECK_THAT(off("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"), Contains("vertex -1"));
    CHECK_THAT(off("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 99999999999999999999\n"), Contains("no usable number"));
    CHECK_THAT(off("3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n"), Contains("line 6: a face has 2 corners"));
    CHECK_THAT(off("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n"), Contains("line 6: the vertex index is missing"));
    CHECK_THAT(off("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1.5 2\n"), Contains("'1.5'"));
    CHECK_THAT(off("3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), Contains("ends after 1 of 2 faces"));
    CHECK_THAT(off("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n"), Contains("line 7: there are more rows"));
    CHECK_THAT(off("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1\n"), Contains("three different corners"));
    CHECK_THAT(off("3 0 0\n0 0 0\n1 0 0\n0 1 0\n"), Contains("no faces"));
    CHECK_THAT(off("0 0 0\n"), Contains("no vertices"));
    CHECK_THAT(off("-3 1 0\n"), Contains("-3 vertices"));
    CHECK_THAT(off(""), Contains("number of vertices is missing"));
    CHECK_THAT(reading_error("4OFF\n1 1 0\n", MeshFormat::off), Contains("begins neither"));
    CHECK_THAT(reading_error("OOPS\n1 1 0\n", MeshFormat::off), Contains("begins neither"));
    CHECK_THAT(reading_error("OOPS\n1 1 0\n"), Contains("no mesh in a known format"));
    CHECK_THAT(reading_error(""), Contains("empty"));
    CHECK(reading_error(" \n\n", MeshFormat::off) != "no error");
}

TEST_CASE("OFF: a count that no file of this size can hold costs no memory", "[io][off]") {
    for (const char* counts :
         {"2000000000 1 0", "3 2000000000 0", "999999999999999999 1 0", "99999999999999999999 1 0"})
        CHECK(reading_error(std::string("OFF\n") + counts + "\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n") != "no error");
}

TEST_CASE("OFF: coordinates that only a double can hold are refused as float", "[io][off]") {
    const std::string huge = "OFF\n3 1 0\n1e200 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    CHECK(parse_mesh<double>(huge).vertices(0, 0) == 1e200);
    CHECK_THROWS_AS(parse_mesh<float>(huge), Error);
    CHECK(parse_mesh<float>("OFF\n3 1 0\n0.1 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").vertices(0, 0) == 0.1F);
}

TEST_CASE("large text is read in blocks, by any number of threads, as in one", "[io]") {
    constexpr int side = 260; // of a grid of vertices, 7 bytes and more each: several blocks
    std::string text =
        "OFF # a comment\n" + std::to_string(side * side) + " " + std::to_string((side - 1) * (side - 1)) + " 0\n";
    for (int i = 0; i < side * side; ++i)
        text +=
            std::to_string(i % side) + " " + std::to_string(i / side) + " 0.125" + (i % 7 == 0 ? " # odd\n\n" : "\n");
    std::string faces;
    for (int y = 0; y + 1 < side; ++y)
        for (int x = 0; x + 1 < side; ++x) {
            const int i = y * side + x;
            const auto name = [](int v) { return " " + std::to_string(v); };
            faces +=
                "4" + name(i) + name(i + 1) + name(i + side + 1) + name(i + side) + (x % 5 == 0 ? " 1 0 0\n" : "\n");
        }
    const auto rows_of = [](const std::string& rows) { return std::count(rows.begin(), rows.end(), '\n'); };
    for (const int threads : {1, 2, 3}) {
        const core::ThreadScope scope(threads);
        const TriangleMesh<double> mesh = parse_mesh<double>(text + faces);
        REQUIRE(mesh.vertices.rows() == side * side);
        REQUIRE(mesh.faces.rows() == 2 * (side - 1) * (side - 1));
        for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
            REQUIRE(mesh.vertices.row(v) ==
                    Eigen::RowVector3d(static_cast<double>(v % side), static_cast<double>(v / side), 0.125));
        // The same on lines that go on, which is read in one.
        std::string continued = text + faces;
        continued.replace(continued.rfind(" "), 1, " \\\n");
        CHECK(parse_mesh<double>(continued).faces == mesh.faces);
        // Errors name their lines.
        CHECK_THROWS_WITH(parse_mesh<double>(text + faces + "4 0 1 2 x\n"), Contains("more rows"));
        std::string wrong = text + faces;
        wrong.replace(wrong.rfind("4 "), 1, "y");
        CHECK_THROWS_WITH(parse_mesh<double>(wrong), Contains("line " + std::to_string(rows_of(text + faces)) + ":"));
        CHECK_THROWS_WITH(parse_mesh<double>(text), Contains("the file ends after 0 of"));
    }
}
