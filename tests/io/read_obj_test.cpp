#include <string>

#include "mesh_expectations.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;
using Catch::Matchers::Contains;

namespace {

const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

} // namespace

TEST_CASE("OBJ: every way to write a corner", "[io][obj]") {
    check_is_tetrahedron(vertices + faces);
    check_is_tetrahedron(vertices +
                         "vt 0 0\nvn 0 0 1\nf 1/1 3/1 2/1\nf 1//1 2//1 4//1\nf 1/1/1 4/1/1 3/1/1\nf 2/ 3/ 4/\n");
    check_is_tetrahedron(vertices + "f -4 -2 -3\nf -4 -3 -1\nf -4/-1/-1 -1/-1/-1 -2/-1/-1\nf 2 -2 4\n");
}

TEST_CASE("OBJ: negative indices count back from the face's own line", "[io][obj]") {
    const auto mesh = parse_mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n");
    Triangles expected(2, 3);
    expected << 0, 1, 2, 3, 4, 5;
    CHECK(mesh.faces == expected);
}

TEST_CASE("OBJ: everything that is no vertex or face is skipped", "[io][obj]") {
    check_is_tetrahedron("# header\r\nmtllib a.mtl\no body\ng left right\ns off\nusemtl skin\n" + vertices +
                         "vn 0 0 nan\nvp 0 0\nl 1 2\np 1\ncstype bezier\n" + faces + "call x\n\n  \n# end");
}

TEST_CASE("OBJ: vertex colours and weights, continued lines, comments behind values", "[io][obj]") {
    check_is_tetrahedron(
        "v 0 0 0 1 0 0\nv 1 0 0 1.0\nv 0 1 \\\n 0\nv 0 0 1 # top\nf 1 \\\r\n 3 2\nf 1 2 4# base\n\tf 1 4 3\nf 2 3 4");
}

TEST_CASE("OBJ: lines that are skipped may be continued, too; comments and words may not", "[io][obj]") {
    check_is_tetrahedron("g left \\\nv 9 9 9\nv 0 0 0 1 0 \\\r\nv 9 9 9\n# to C:\\ \\\nv 1 0 0\nusemtl C:\\\nv 0 1 0\n"
                         "v 0 0 1\nvt 0 \\\n \\\nf 1 2 3\n" +
                         faces + "g \\");
}

TEST_CASE("OBJ: faces may come before their vertices", "[io][obj]") { check_is_tetrahedron(faces + vertices); }

TEST_CASE("OBJ: is known by its content or by its extension", "[io][obj]") {
    check_is_tetrahedron("o body\n" + vertices + faces, MeshFormat::stl);
    check_is_tetrahedron("unknown first word\n" + vertices + faces, MeshFormat::obj);
}

TEST_CASE("OBJ: what is wrong is named with its line", "[io][obj]") {
    CHECK_THAT(reading_error(vertices + "f 1 2 5\nf 1 2 3\n"), Contains("line 5: a face names vertex 5"));
    CHECK_THAT(reading_error(vertices + "f 1 2 0\n"), Contains("line 5: a face names vertex 0"));
    CHECK_THAT(reading_error(vertices + "f 1 2 -5\n"), Contains("vertex -5"));
    CHECK_THAT(reading_error(vertices + "f 1 2\n"), Contains("line 5: a face has 2 corners"));
    CHECK_THAT(reading_error(vertices + "f\n"), Contains("0 corners"));
    CHECK_THAT(reading_error(vertices + "f a b c\n"), Contains("no usable number: 'a'"));
    CHECK_THAT(reading_error(vertices + "f 1.5 2 3\n"), Contains("not of the form v/vt/vn"));
    CHECK_THAT(reading_error(vertices + "f 1 2 4000000000\n"), Contains("4000000000"));
    CHECK_THAT(reading_error("v 0 0\nv 1 0 0\n"), Contains("line 1: the z coordinate is missing"));
    CHECK_THAT(reading_error("v 0 inf 0\n"), Contains("'inf'"));
    CHECK_THAT(reading_error("v 0 0 0\nv 0 1 \\\n\nf 1 1 1\n"), Contains("the z coordinate is missing"));
    CHECK_THAT(reading_error(vertices), Contains("no faces"));
    CHECK_THAT(reading_error("f 1 2 3\n"), Contains("line 1"));
    CHECK_THAT(reading_error("any text at all\n", MeshFormat::obj), Contains("no vertices"));
}
