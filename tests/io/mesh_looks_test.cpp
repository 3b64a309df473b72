#include <fstream>
#include <limits>
#include <string>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/scene_looks.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "catch.hpp"
#include "gltf_builder.hpp"
#include "temporary_folder.hpp"

// How OBJ and PLY files look, and the normals of all.
namespace {

using namespace skelgen;
using Catch::Matchers::Contains;

const std::string png = "\x89PNG\r\n\x1A\n";

/// A square of two triangles and a quad on it; its diagonal's ends have two texture coordinates each, and one has two
/// normals.
const std::string painted_obj = "mtllib my paints.mtl\n"
                                "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 2 0\nv 1 2 0\n"
                                "vt 0 0\nvt 0.25 0.75\nvt 1 1\nvt 0.5 0.5\nvt 0 0\n"
                                "vn 0 0 1\nvn 0 3 4\nvn 0 0 nan\n"
                                "usemtl my skin\nf 1/1/1 2/2/1 3/3/1\n"
                                "usemtl cloth\nf 1/5/1 3/4/2 4/4/3\n"
                                "usemtl my skin\nf -3/-2 3/4/99 6/99 5\n";

const std::string paints = "# by hand\nnewmtl my skin\nKd 0.5 0.25 0\nd 0.5\nNs 250\n"
                           "newmtl cloth\nKd 0 0 0\nmap_Kd -s 2 2 -bm 0.5 .\\a picture.png\nTr 0\nPr 0.75\nPm 1\n";

void write(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

nlohmann::json json_of(const io::SceneLooks& looks) { return nlohmann::json::parse(looks.json); }

TEST_CASE("OBJ: materials, texture coordinates and normals; corners that differ are copies", "[io][looks]") {
    const test::TemporaryFolder folder;
    write(folder / "body.obj", painted_obj);
    write(folder / "my paints.mtl", paints);
    write(folder / "a picture.png", png);
    const auto mesh = io::read_mesh(folder / "body.obj");
    const auto looks = io::read_looks(folder / "body.obj");
    REQUIRE(looks);
    CHECK(looks->lost_materials.empty());
    CHECK(looks->lost_pictures.empty());
    CHECK(looks->pictures == std::vector<std::string>{png});
    const auto json = json_of(*looks);
    const auto& skin = json.at("materials").at(0);
    CHECK(skin.at("name") == "my skin");
    CHECK(skin.at("alphaMode") == "BLEND");
    CHECK(skin.at("pbrMetallicRoughness").at("baseColorFactor") == nlohmann::json({0.5, 0.25, 0, 0.5}));
    CHECK(skin.at("pbrMetallicRoughness").at("roughnessFactor") == 0.5);
    CHECK(skin.at("pbrMetallicRoughness").at("metallicFactor") == 0);
    const auto& cloth = json.at("materials").at(1);
    CHECK_FALSE(cloth.contains("alphaMode"));
    CHECK(cloth.at("pbrMetallicRoughness").at("baseColorTexture").at("index") == 0);
    CHECK_FALSE(cloth.at("pbrMetallicRoughness").contains("baseColorFactor")); // what is there would blacken it
    CHECK(cloth.at("pbrMetallicRoughness").at("metallicFactor") == 1);

    // Vertex 3 has three looks, vertex 1 one: equal texture coordinates are the same, whatever their numbers.
    REQUIRE(mesh.vertices.rows() == 6);
    CHECK(looks->copies == std::vector<int>{2, 2});
    REQUIRE(looks->parts.size() == 3);
    CHECK(looks->parts[2].same_as == 0);
    CHECK(looks->parts[2].material == 0);
    CHECK(looks->parts[0].texture_coordinates.at(0).row(1) == Eigen::RowVector2f(0.25F, 0.25F)); // from the top
    CHECK(looks->parts[0].normals.row(6) == Eigen::RowVector3f(0, 3, 4));

    // Written, faces of one material come together, and the input's own vertices first.
    const applications::VertexTurns<double> turns(6, Eigen::Quaterniond::Identity());
    io::write_mesh(folder / "out.glb", mesh, *looks, turns);
    const auto back = io::read_mesh(folder / "out.glb");
    REQUIRE(back.vertices.rows() == 8);
    CHECK(back.vertices.topRows(6) == mesh.vertices);
    CHECK(back.vertices.row(6) == mesh.vertices.row(2));
    CHECK(back.faces.rows() == mesh.faces.rows());
    const auto again = io::read_looks(folder / "out.glb");
    REQUIRE(again);
    REQUIRE(again->parts.size() == 2);
    CHECK(again->parts[0].faces == 3);
    CHECK(json_of(*again) == json); // keys may come in another order
    CHECK(again->pictures == looks->pictures);
    CHECK(again->parts[0].texture_coordinates == looks->parts[0].texture_coordinates);
    CHECK((again->parts[0].normals.row(6) - Eigen::RowVector3f(0, 0.6F, 0.8F)).norm() < 1e-6F); // of length 1
    CHECK((again->parts[0].normals.row(3) - Eigen::RowVector3f(0, 0, 1)).norm() < 1e-6F);       // no number: computed
    CHECK((again->parts[0].normals.row(7) - Eigen::RowVector3f(0, 0, 1)).norm() < 1e-6F);       // there is no normal 99
}

TEST_CASE("OBJ: files of materials and pictures that are missing cost these alone", "[io][looks]") {
    const test::TemporaryFolder folder;
    write(folder / "body.obj", painted_obj);
    auto looks = io::read_looks(folder / "body.obj");
    REQUIRE(looks);
    REQUIRE(looks->lost_materials.size() == 1);
    CHECK_THAT(looks->lost_materials[0], Contains("my paints.mtl"));
    CHECK(json_of(*looks).at("materials").at(0).at("name") == "my skin");
    CHECK(json_of(*looks).at("materials").size() == 2);
    CHECK(looks->parts.size() == 3);

    write(folder / "my paints.mtl", paints);
    looks = io::read_looks(folder / "body.obj");
    REQUIRE(looks);
    CHECK(looks->lost_materials.empty());
    REQUIRE(looks->lost_pictures.size() == 1);
    CHECK_THAT(looks->lost_pictures[0], Contains("a picture.png"));
    CHECK_FALSE(json_of(*looks).contains("textures"));
    CHECK(json_of(*looks).at("materials").at(1).at("pbrMetallicRoughness").at("baseColorFactor") ==
          nlohmann::json({0, 0, 0, 1}));

    write(folder / "a picture.png", "BM, a bitmap");
    looks = io::read_looks(folder / "body.obj");
    REQUIRE(looks);
    REQUIRE(looks->lost_pictures.size() == 1);
    CHECK_THAT(looks->lost_pictures[0], Contains("neither PNG nor JPEG"));

    looks = io::parse_looks(painted_obj); // nothing is beside it
    REQUIRE(looks);
    CHECK(looks->lost_materials.size() == 1);
    CHECK_FALSE(io::parse_looks("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
}

TEST_CASE("OBJ: libraries in folders, several in a line, pictures by their bare names", "[io][looks]") {
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "mats");
    write(folder / "mats/a.mtl",
          "newmtl a\nmap_Kd skin.png\nnewmtl b\nmap_Kd C:\\work\\skin.png\nmap_d C:\\work\\skin.png\n");
    write(folder / "c.mtl", "newmtl c\rKd 1 0 0\rKd 0 x 0\r");
    write(folder / "mats/skin.png", png);
    write(folder / "body.obj", "mtllib mats/a.mtl c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                               "vt 0 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n");
    const auto looks = io::read_looks(folder / "body.obj");
    REQUIRE(looks);
    CHECK(looks->lost_materials.empty());
    CHECK(looks->lost_pictures.empty());
    CHECK(looks->pictures.size() == 2);
    const auto json = json_of(*looks);
    CHECK_FALSE(json.at("materials").at(0).contains("alphaMode"));
    CHECK(json.at("materials").at(1).at("alphaMode") == "BLEND"); // the picture's own
    CHECK(json.at("materials").at(2).at("pbrMetallicRoughness").at("baseColorFactor") == nlohmann::json({1, 0, 0, 1}));
}

TEST_CASE("OBJ: materials that no file has are named; pictures take texture coordinates", "[io][looks]") {
    const test::TemporaryFolder folder;
    write(folder / "a.mtl", "newmtl a\nKd 1 0 0\nmap_Kd a.png\n");
    write(folder / "a.png", png);
    const std::string body =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl (null)\nf 1 2 3\n";
    write(folder / "body.obj", "mtllib a.mtl\n" + body);
    const auto looks = io::read_looks(folder / "body.obj");
    REQUIRE(looks);
    REQUIRE(looks->lost_materials.size() == 1);
    CHECK_THAT(looks->lost_materials[0], Contains("'b'"));
    CHECK(looks->pictures.empty());
    CHECK(json_of(*looks).at("materials").at(0).at("pbrMetallicRoughness").at("baseColorFactor") ==
          nlohmann::json({1, 0, 0, 1}));
    write(folder / "lost.obj", "mtllib lost.mtl\n" + body); // which says it all
    CHECK(io::read_looks(folder / "lost.obj")->lost_materials.size() == 1);
    CHECK(io::parse_looks("mtllib\n" + body)->lost_materials.size() == 2);
}

TEST_CASE("OBJ: looks are read from the lines that the shape is read from", "[io][looks]") {
    const std::string text = "mtllib a.mtl \\\nv 9 9 9\nv 0 0 0 1 \\\nv 9 9 9\nv 1 0 0 1 0 0 # \\\nv 0 1 0\n"
                             "vt 0 1#2 \\\nv 0 0 1\nusemtl C:\\\nvt 1 \\\n0.5\nvn 0 0 \\\nf 1 2 3\nvn 0 0\\\n"
                             "f 1/1 2/2 \\\n 4/2\nf 1/2 2 4\n";
    const auto mesh = io::parse_mesh(text);
    const auto looks = io::parse_looks(text);
    CHECK(mesh.vertices.rows() == 4);
    REQUIRE(looks);
    REQUIRE(looks->parts.size() == 1);
    CHECK(looks->parts[0].vertices == 4 + static_cast<Eigen::Index>(looks->copies.size()));
    CHECK(looks->faces.rows() == mesh.faces.rows());
    REQUIRE(looks->parts[0].texture_coordinates.size() == 1);
    CHECK(looks->parts[0].texture_coordinates[0].row(1) == Eigen::RowVector2f(1, 0.5F));
}

TEST_CASE("OBJ and PLY: colours of vertices are light, and get a material that shows them", "[io][looks]") {
    const std::string faces = "f 1 2 3\n";
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                            "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                            "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                            "0 0 0 255 0 0\n1 0 0 0 188 0\n0 1 0 255 255 255\n3 0 1 2\n";
    std::string real = ply, with_alpha = ply;
    for (std::size_t at = real.find("uchar red"); at < real.find("element face"); at = real.find("uchar ", at + 1))
        if (real.compare(at, 11, "uchar green") == 0 || real.compare(at, 9, "uchar red") == 0 ||
            real.compare(at, 10, "uchar blue") == 0)
            real.replace(at, 5, "float");
    real.replace(real.find("255 0 0"), 7, "1 0 0");
    real.replace(real.find("0 188 0"), 7, "0 0.737255 0");
    real.replace(real.find("255 255 255"), 11, "1 1 nan");
    for (const std::string& text : {"v 0 0 0 1 0 0\nv 1 0 0 0 0.737255 0\nv 0 1 0\n" + faces,
                                    "v 0 0 0 255 0 0\nv 1 0 0 0 188 0\nv 0 1 0\n" + faces, ply, real}) {
        INFO(text);
        const auto looks = io::parse_looks(text);
        REQUIRE(looks);
        REQUIRE(looks->parts.size() == 1);
        REQUIRE(looks->parts[0].colours.rows() == 3);
        CHECK(looks->parts[0].colours.row(0) == Eigen::RowVector4f(1, 0, 0, 1));
        CHECK(looks->parts[0].colours(1, 1) == Approx(0.5029).epsilon(1e-3)); // of sRGB's 188
        REQUIRE(looks->parts[0].material == 0);
        CHECK(json_of(*looks).at("materials").at(0).at("pbrMetallicRoughness").at("metallicFactor") == 0);
    }
    with_alpha.replace(with_alpha.find("property uchar blue\n"), 20, "property uchar blue\nproperty uchar alpha\n");
    with_alpha.replace(with_alpha.find("255 0 0"), 7, "255 0 0 51");
    with_alpha.replace(with_alpha.find("0 188 0"), 7, "0 188 0 0");
    with_alpha.replace(with_alpha.find("255 255 255"), 11, "255 255 255 255");
    const auto looks = io::parse_looks(with_alpha);
    REQUIRE(looks);
    CHECK(looks->parts[0].colours(0, 3) == Approx(0.2));
    CHECK_FALSE(io::parse_looks("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\n" + faces)); // weights
}

TEST_CASE("PLY: normals are kept; what is no number is left out", "[io][looks]") {
    const auto looks = io::parse_looks("ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\nproperty float x\n"
                                       "property float y\nproperty float z\nproperty float ny\nproperty float nz\n"
                                       "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                       "0 0 0 0 0 2\n0 1 0 0 nan 1\n1 0 1 0 0 0\n3 0 1 2\n");
    REQUIRE(looks);
    REQUIRE(looks->parts[0].normals.rows() == 3);
    CHECK(looks->parts[0].normals.row(0) == Eigen::RowVector3f(0, 0, 2));
    CHECK(looks->parts[0].normals.row(1) == Eigen::RowVector3f(0, 0, 1));
    CHECK_FALSE(looks->parts[0].material);
    CHECK(looks->json == "{}");
}

TEST_CASE("PLY: a picture is said to be lost", "[io][looks]") {
    const auto looks = io::parse_looks("ply\nformat ascii 1.0\ncomment made by hand\ncomment TextureFile my skin.png\n"
                                       "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                       "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                       "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    REQUIRE(looks);
    REQUIRE(looks->lost_pictures.size() == 1);
    CHECK_THAT(looks->lost_pictures[0], Contains("'my skin.png'"));
}

TEST_CASE("normals: of a glTF as its nodes and skin hold it, turned with the mesh", "[io][looks]") {
    test::GltfBuilder scene;
    scene.add_tetrahedron();
    scene.primitive()["attributes"]["NORMAL"] = scene.add<float>("VEC3", {1, 0, 0, 0, 1, 0, 0.6F, 0.8F, 0, 0, 0, 0});
    scene.json["nodes"][0] = {{"mesh", 0}, {"scale", {2, 1, 1}}};
    const test::TemporaryFolder folder;
    write(folder / "scene.glb", scene.glb());
    auto looks = io::read_looks(folder / "scene.glb");
    REQUIRE(looks);
    REQUIRE(looks->parts[0].normals.rows() == 4);
    CHECK(looks->parts[0].normals.row(0) == Eigen::RowVector3f(1, 0, 0));
    CHECK((looks->parts[0].normals.row(2) - Eigen::RowVector3f(0.3F, 0.8F, 0).normalized()).norm() < 1e-6F);
    CHECK(looks->parts[0].normals.row(3).isZero());

    // Half a turn about z takes x to -x; without turns the normals are computed.
    const auto mesh = io::read_mesh(folder / "scene.glb");
    auto turned = mesh;
    turned.vertices.leftCols<2>() *= -1;
    looks->parts[0].normals.row(1) = Eigen::RowVector3f::Constant(std::numeric_limits<float>::quiet_NaN());
    const Eigen::Quaterniond half(0, 0, 0, 1);
    io::write_mesh(folder / "held.glb", turned, *looks, applications::VertexTurns<double>(4, half));
    io::write_mesh(folder / "plain.glb", turned, *looks);
    const auto held = io::read_looks(folder / "held.glb")->parts[0].normals;
    const auto plain = io::read_looks(folder / "plain.glb")->parts[0].normals;
    REQUIRE(held.rows() == 4);
    const float side = held(0, 0); // of the mesh's inside and outside, most of the normals choose
    CHECK(std::abs(side) == Approx(1));
    CHECK((held.row(2) - side * Eigen::RowVector3f(0.3F, 0.8F, 0).normalized()).norm() < 1e-6F);
    CHECK((held.row(1) - plain.row(1)).norm() < 1e-6F);
    CHECK((held.row(3) - plain.row(3)).norm() < 1e-6F);
    CHECK_THROWS_WITH(io::write_mesh(folder / "x.glb", turned, *looks, applications::VertexTurns<double>(3, half)),
                      Contains("another mesh"));
}

} // namespace
