#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>

#include "mesh_expectations.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;
using Catch::Matchers::Contains;

namespace {

template <typename T>
void append(std::string& bytes, T value, std::endian order) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
}

/// The tetrahedron as binary PLY with these C++ types for coordinates, list lengths and vertex indices, other
/// properties around them and other elements before, between and behind.
template <typename Coordinate, typename Length, typename Index>
std::string binary_ply(std::endian order, const std::string& coordinate, const std::string& length,
                       const std::string& index, const std::string& line_end = "\n") {
    const TriangleMesh<double> mesh = tetrahedron();
    std::string bytes;
    const auto line = [&](const std::string& text) { bytes += text + line_end; };
    line("ply");
    line(order == std::endian::little ? "format binary_little_endian 1.0" : "format binary_big_endian 1.0");
    line("comment property int x");
    line("obj_info none");
    line("element camera 2");
    line("property double focus");
    line("property list ushort short lens");
    line("element vertex 4");
    line("property uchar red");
    line("property " + coordinate + " z");
    line("property list uint8 float weights");
    line("property " + coordinate + " x");
    line("property " + coordinate + " y");
    line("element nothing 12345678901");
    line("element face 4");
    line("property short material");
    line("property list " + length + " " + index + " vertex_indices");
    line("property list char double texcoord");
    line("element edge 1");
    line("property int vertex1");
    line("end_header");
    for (int i = 0; i < 2; ++i) {
        append(bytes, 1.5, order);
        append(bytes, static_cast<std::uint16_t>(i), order);
        for (int k = 0; k < i; ++k) append(bytes, std::int16_t{-1}, order);
    }
    for (Eigen::Index i = 0; i < 4; ++i) {
        append(bytes, std::uint8_t{200}, order);
        append(bytes, static_cast<Coordinate>(mesh.vertices(i, 2)), order);
        append(bytes, static_cast<std::uint8_t>(i), order);
        for (int k = 0; k < i; ++k) append(bytes, 0.5F, order);
        append(bytes, static_cast<Coordinate>(mesh.vertices(i, 0)), order);
        append(bytes, static_cast<Coordinate>(mesh.vertices(i, 1)), order);
    }
    for (Eigen::Index i = 0; i < 4; ++i) {
        append(bytes, std::int16_t{-2}, order);
        append(bytes, static_cast<Length>(3), order);
        for (int k = 0; k < 3; ++k) append(bytes, static_cast<Index>(mesh.faces(i, k)), order);
        append(bytes, static_cast<std::int8_t>(i), order);
        for (int k = 0; k < i; ++k) append(bytes, 0.25, order);
    }
    append(bytes, std::int32_t{0}, order);
    return bytes;
}

const std::string header =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
    return text;
}

} // namespace

TEST_CASE("PLY: text", "[io][ply]") {
    check_is_tetrahedron(header + vertices + faces);
    check_is_tetrahedron(replaced(header, "vertex_indices", "vertex_index") + vertices + faces, MeshFormat::off);
    check_is_tetrahedron(
        "ply\r\nformat ascii 1.0\r\ncomment by hand\r\nelement face 4\r\nproperty list int uint vertex_index\r\n"
        "property uchar red\r\nelement vertex 4\r\nproperty double y\r\nproperty list uchar int more\r\n"
        "property double x\r\nproperty double z\r\nproperty float confidence\r\nend_header\r\n"
        "3 0 2 1 255\r\n3 0 1 3 255\r\n3 0 3 2 255\r\n3 1 2 3 255\r\n"
        "0 2 7 8 0 0 nan\r\n0 0 1 0 1\r\n1 0 0 0 1\r\n0 1 9 0 1 1\r\n");
}

TEMPLATE_TEST_CASE_SIG("PLY: binary, every type in both byte orders", "[io][ply]", ((std::endian Order), Order),
                       std::endian::little, std::endian::big) {
    check_is_tetrahedron(binary_ply<float, std::uint8_t, std::int32_t>(Order, "float", "uchar", "int"));
    check_is_tetrahedron(binary_ply<double, std::int32_t, std::uint32_t>(Order, "double", "int", "uint"));
    check_is_tetrahedron(binary_ply<double, std::uint32_t, std::uint16_t>(Order, "float64", "uint32", "uint16"));
    check_is_tetrahedron(binary_ply<std::int16_t, std::int16_t, std::int16_t>(Order, "short", "int16", "short"));
    check_is_tetrahedron(binary_ply<std::uint8_t, std::int8_t, std::uint8_t>(Order, "uint8", "int8", "uchar"));
    check_is_tetrahedron(binary_ply<std::int8_t, std::uint16_t, std::int8_t>(Order, "char", "ushort", "char"));
    check_is_tetrahedron(binary_ply<float, std::uint8_t, std::int32_t>(Order, "float32", "uint8", "int32", "\r\n"));
}

TEST_CASE("PLY: binary cut short anywhere is refused", "[io][ply]") {
    const auto bytes = binary_ply<float, std::uint8_t, std::int32_t>(std::endian::little, "float", "uchar", "int");
    for (std::size_t size = 0; size < bytes.size(); ++size) CHECK(reading_error(bytes.substr(0, size)) != "no error");
}

TEST_CASE("PLY: what is wrong is named", "[io][ply]") {
    const auto with = [](const std::string& what, const std::string& by) {
        return reading_error(replaced(header + vertices + faces, what, by));
    };
    CHECK_THAT(with("ascii", "utf8"), Contains("line 2: the format is none of"));
    CHECK_THAT(with("format ascii 1.0\n", ""), Contains("names no format"));
    CHECK_THAT(with("property float z\n", ""), Contains("lacks a property x, y or z"));
    CHECK_THAT(with("vertex_indices", "strips"), Contains("lacks a list vertex_indices"));
    CHECK_THAT(with("int vertex", "float vertex"), Contains("integer type"));
    CHECK_THAT(with("uchar int", "float int"), Contains("integer type"));
    CHECK_THAT(with("float y", "real y"), Contains("line 5: a property's type is none of PLY's"));
    CHECK_THAT(with("end_header\n", ""), Contains("no word that PLY knows"));
    CHECK_THAT(with("element vertex 4\n", ""), Contains("before the first element"));
    CHECK_THAT(with("vertex 4", "vertex 5"), Contains("more values than the header's properties"));
    CHECK_THAT(with("face 4", "face 5"), Contains("ends too early"));
    CHECK_THAT(with("face 4", "face 3"), Contains("line 17: there are more rows"));
    CHECK_THAT(with("vertex 4", "vertex 4000000000"), Contains("cannot hold"));
    CHECK_THAT(with("vertex 4", "vertex -4"), Contains("negative"));
    CHECK_THAT(with("vertex 4", "vertex many"), Contains("'many'"));
    CHECK_THAT(with("1 0 0\n", "1 0 nan\n"), Contains("line 11: the value is no usable number: 'nan'"));
    CHECK_THAT(with("1 0 0\n", "1 0\n"), Contains("line 11: the value is missing"));
    CHECK_THAT(with("3 0 2 1", "3 0 2 4"), Contains("line 14: a face names vertex 4"));
    CHECK_THAT(with("3 0 2 1", "2 0 2"), Contains("2 corners"));
    CHECK_THAT(with("3 0 2 1", "-1"), Contains("-1 corners"));
    CHECK_THAT(reading_error(replaced(header, "face 4", "face 0") + vertices), Contains("no faces"));
    CHECK_THAT(reading_error("ply\n"), Contains("end_header"));
    CHECK_THAT(reading_error("OFFply\n", MeshFormat::ply), Contains("'ply' does not come first"));
}

TEST_CASE("PLY: a binary coordinate that is no number is refused", "[io][ply]") {
    std::string bytes = replaced(header, "ascii", "binary_little_endian");
    for (int i = 0; i < 12; ++i) append(bytes, std::numeric_limits<float>::quiet_NaN(), std::endian::little);
    bytes.append(4 * 13, '\0');
    CHECK_THAT(reading_error(bytes), Contains("not a number"));
}

TEST_CASE("PLY: an endless list costs no memory and no time", "[io][ply]") {
    std::string bytes = replaced(header, "ascii", "binary_little_endian");
    bytes = replaced(bytes, "uchar int", "uint int");
    bytes.append(4 * 12, '\0');
    append(bytes, std::uint32_t{0xffffffffU}, std::endian::little);
    bytes.append(100, '\0');
    CHECK_THAT(reading_error(bytes), Contains("4294967295 corners"));
}
