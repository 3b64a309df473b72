#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "mesh_expectations.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;
using Catch::Matchers::Contains;

namespace {

using Facet = std::array<std::array<float, 3>, 3>;

/// The facets of the tetrahedron.
std::vector<Facet> facets() {
    const TriangleMesh<double> mesh = tetrahedron();
    std::vector<Facet> result(4);
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::size_t axis = 0; axis < 3; ++axis)
                result[i][corner][axis] = static_cast<float>(
                    mesh.vertices(mesh.faces(static_cast<int>(i), static_cast<int>(corner)), static_cast<int>(axis)));
    return result;
}

template <typename T>
void append(std::string& bytes, T value) {
    static_assert(std::endian::native == std::endian::little, "this test's bytes would need reversing");
    const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    bytes.append(raw.data(), raw.size());
}

std::string binary_stl(const std::vector<Facet>& list, std::string head, std::uint32_t count) {
    std::string bytes = std::move(head);
    bytes.resize(80, ' ');
    append(bytes, count);
    for (const Facet& facet : list) {
        for (int axis = 0; axis < 3; ++axis) append(bytes, std::numeric_limits<float>::quiet_NaN()); // the normal
        for (const auto& corner : facet)
            for (const float coordinate : corner) append(bytes, coordinate);
        append(bytes, std::uint16_t{7});
    }
    return bytes;
}

std::string text_stl(const std::string& normal = "0 0 1") {
    std::string text = "solid a body\n";
    for (const Facet& facet : facets()) {
        text += "  facet normal " + normal + "\n    outer loop\n";
        for (const auto& corner : facet)
            text += "      vertex " + std::to_string(corner[0]) + " " + std::to_string(corner[1]) + " " +
                    std::to_string(corner[2]) + "\n";
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid a body\n";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
    return text;
}

/// STL numbers vertices as they appear: 0, then the third, then the second of the tetrahedron.
TriangleMesh<double> expected() {
    TriangleMesh<double> mesh;
    mesh.vertices.resize(4, 3);
    mesh.vertices << 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1;
    mesh.faces.resize(4, 3);
    mesh.faces << 0, 1, 2, 0, 2, 3, 0, 3, 1, 2, 1, 3;
    return mesh;
}

} // namespace

TEST_CASE("STL: corners at one position become one vertex", "[io][stl]") {
    check_same(parse_mesh(binary_stl(facets(), "made by hand", 4)), expected());
    check_same(parse_mesh(text_stl()), expected());
}

TEST_CASE("STL: 0 and -0 are one position, the next float is another", "[io][stl]") {
    std::vector<Facet> list = facets();
    list[0][0] = {-0.0F, 0.0F, -0.0F};
    CHECK(parse_mesh(binary_stl(list, "", 4)).vertices.rows() == 4);
    list[0][0] = {std::numeric_limits<float>::denorm_min(), 0.0F, 0.0F};
    CHECK(parse_mesh(binary_stl(list, "", 4)).vertices.rows() == 5);
}

TEST_CASE("STL: many vertices are merged as rightly as few", "[io][stl]") {
    constexpr int n = 120; // a grid of n x n squares
    std::vector<Facet> list;
    const auto at = [](int i, int j) { return std::array{static_cast<float>(i) / 7, static_cast<float>(j) * 3, 1.0F}; };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            list.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            list.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    const auto mesh = parse_mesh(binary_stl(list, "", static_cast<std::uint32_t>(list.size())));
    CHECK(mesh.vertices.rows() == (n + 1) * (n + 1));
    REQUIRE(mesh.faces.rows() == 2 * n * n);
    for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i)
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis)
                if (mesh.vertices(mesh.faces(i, corner), axis) !=
                    static_cast<double>(list[static_cast<std::size_t>(i)][static_cast<std::size_t>(corner)]
                                            [static_cast<std::size_t>(axis)]))
                    FAIL("facet " << i << " has moved");
}

TEST_CASE("STL: a binary header may say anything", "[io][stl]") {
    for (const char* head : {"solid binary", "solid facet endsolid", "OFF", "ply", "v 1 2 3", ""})
        check_same(parse_mesh(binary_stl(facets(), head, 4)), expected());
}

TEST_CASE("STL: text in any case, spacing and number of solids", "[io][stl]") {
    std::string upper = text_stl();
    for (char& c : upper)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    check_same(parse_mesh(upper), expected());
    check_same(parse_mesh(text_stl("-nan(ind) nan 1e")), expected());
    check_same(parse_mesh(replaced(text_stl(), "  endfacet\n", "endfacet endsolid\nsolid b\n")), expected());
    check_same(parse_mesh(replaced(text_stl(), "normal 0 0 1\n    outer loop\n", "outer loop ")), expected());
    check_same(parse_mesh(replaced(text_stl(), "solid a body", "solid")), expected());
}

TEST_CASE("STL: a few stray bytes behind a binary one are let pass", "[io][stl]") {
    check_same(parse_mesh(binary_stl(facets(), "", 4) + "\r\n", MeshFormat::stl), expected());
}

TEST_CASE("STL: facets without extent are left out", "[io][stl]") {
    std::vector<Facet> list = facets();
    list.push_back({list[0][0], list[0][1], list[0][0]});
    CHECK(parse_mesh(binary_stl(list, "", 5)).faces.rows() == 4);
    list = {list[4]};
    CHECK_THAT(reading_error(binary_stl(list, "", 1)), Contains("three different corners"));
}

TEST_CASE("STL: what is wrong is named", "[io][stl]") {
    const auto stl = MeshFormat::stl;
    CHECK_THAT(reading_error(binary_stl(facets(), "solid", 5), stl),
               Contains("promises 5 facets, but the file holds 4"));
    CHECK_THAT(reading_error(binary_stl(facets(), "solid", 3), stl),
               Contains("promises 3 facets, but the file holds 4"));
    CHECK_THAT(reading_error(binary_stl(facets(), "", 4000000000U), stl), Contains("4000000000 facets"));
    CHECK_THAT(reading_error(binary_stl({}, "", 0), stl), Contains("no vertices"));
    CHECK_THAT(reading_error("short", stl), Contains("ends too early"));
    std::vector<Facet> list = facets();
    list[2][1][1] = std::numeric_limits<float>::infinity();
    CHECK_THAT(reading_error(binary_stl(list, "", 4)), Contains("infinite"));

    const auto with = [](const std::string& what, const std::string& by) {
        return reading_error(replaced(text_stl(), what, by));
    };
    CHECK_THAT(with("endsolid a body\n", ""), Contains("cut short"));
    CHECK_THAT(with("    endloop\n  endfacet\n", ""), Contains("line 7: a facet begins before"));
    CHECK_THAT(with("    endloop\n", "vertex 1 1 1\n"), Contains("more than 3 vertices"));
    CHECK_THAT(with("vertex", "vertices"), Contains("line 4"));
    CHECK_THAT(with("vertex 0.0", "vertex nan 0.0"), Contains("line 4: the x coordinate is no usable number: 'nan'"));
    CHECK_THAT(with("      vertex 0.000000 0.000000 0.000000\n", ""), Contains("2 vertices; it must have 3"));
    CHECK_THAT(reading_error("solid\nendsolid\n"), Contains("no vertices"));
}
