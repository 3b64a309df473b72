#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "catch.hpp"
#include "gltf_builder.hpp"
#include "mesh_expectations.hpp"
#include "temporary_folder.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;
using Json = GltfBuilder::Json;

namespace {

using Row = Eigen::RowVector3d;

GltfBuilder tetrahedron_scene() {
    GltfBuilder scene;
    scene.add_tetrahedron();
    return scene;
}

void check_near(const Row& point, const Row& expected) {
    INFO("found " << point << ", expected " << expected);
    CHECK((point - expected).norm() < 1e-6);
}

/// Three vertices on the x axis and one beside; a joint holds the first two, another one at x = 1 the last two.
GltfBuilder arm_scene() {
    GltfBuilder scene;
    const auto positions = scene.add<float>("VEC3", {0, 0, 0, 1, 0, 0, 2, 0, 0, 2, 1, 0});
    const auto indices = scene.add<std::uint8_t>("SCALAR", {0, 1, 3, 1, 2, 3});
    const auto joints = scene.add<std::uint8_t>("VEC4", {0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    const auto weights = scene.add<float>("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, .5, 0, 0, 0});
    const std::vector<float> binds{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,
                                   1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1};
    const auto inverse_binds = scene.add<float>("MAT4", binds);
    scene.json["meshes"] = {{{"primitives",
                              {{{"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
                                {"indices", indices}}}}}};
    scene.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {7, 7, 7}}}, // of a skinned mesh it is nothing
                           {{"children", {2}}},
                           {{"translation", {1, 0, 0}}}};
    scene.json["scenes"][0]["nodes"] = {0, 1};
    scene.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", inverse_binds}}};
    return scene;
}

/// A quarter turn about z, as a quaternion.
const double half_root = std::sqrt(0.5);
const Json quarter_turn = {0, 0, half_root, half_root};

} // namespace

TEST_CASE("read glTF: GLB, JSON with its data inside, and with a file beside", "[io][gltf]") {
    const GltfBuilder scene = tetrahedron_scene();
    check_is_tetrahedron(scene.glb());
    check_is_tetrahedron(scene.gltf(scene.data_uri()));
    check_is_tetrahedron("\n " + scene.gltf(scene.data_uri()), MeshFormat::obj); // content counts, not the name

    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "a folder");
    write_file_atomically(folder / "a folder/a.bin", scene.bytes);
    write_file_atomically(folder / "scene.gltf", scene.gltf("a%20folder/a.bin"));
    check_same(read_mesh(folder / "scene.gltf"), tetrahedron());
    write_file_atomically(folder / "scene.vrm", scene.glb());
    check_same(read_mesh(folder / "scene.vrm"), tetrahedron());
    CHECK_THAT(reading_error(scene.gltf("a.bin")), Catch::Matchers::Contains("a.bin"));
}

TEST_CASE("read glTF: files outside the scene's folder are not read", "[io][gltf]") {
    const GltfBuilder scene = tetrahedron_scene();
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "inner");
    write_file_atomically(folder / "secret.bin", scene.bytes);
    std::filesystem::create_symlink(folder / "secret.bin", folder / "inner/link.bin");
    std::filesystem::create_directory(folder / "inner2");
    write_file_atomically(folder / "inner2/a.bin", scene.bytes);
    for (const std::string& uri :
         {std::string("../secret.bin"), (folder / "secret.bin").string(), std::string("link.bin"),
          std::string("%2e%2e/secret.bin"), std::string("../inner2/a.bin"), std::string("x/../../secret.bin"),
          std::string("http://example.org/a.bin"), std::string(".")}) {
        INFO(uri);
        write_file_atomically(folder / "inner/scene.gltf", scene.gltf(uri));
        CHECK_THROWS_AS(read_mesh(folder / "inner/scene.gltf"), Error);
    }
}

TEST_CASE("read glTF: what GLB writes reads back", "[io][gltf]") {
    check_is_tetrahedron(format_mesh(tetrahedron(), MeshFormat::glb));
    TriangleMesh<double> mesh = tetrahedron();
    mesh.vertices *= 1e39;
    CHECK_THROWS_AS(format_mesh(mesh, MeshFormat::glb), Error);
    mesh = tetrahedron();
    mesh.faces.resize(0, 3);
    CHECK_THROWS_AS(format_mesh(mesh, MeshFormat::glb), Error);
    CHECK_THROWS_AS(format_mesh(tetrahedron(), MeshFormat::dae), Error);
}

TEST_CASE("read glTF: strips, fans and triangles without indices", "[io][gltf]") {
    GltfBuilder scene = tetrahedron_scene();
    scene.primitive().erase("indices");
    CHECK(parse_mesh(scene.glb()).faces == (Triangles(1, 3) << 0, 1, 2).finished());
    scene.primitive()["mode"] = 5;
    CHECK(parse_mesh(scene.glb()).faces == (Triangles(2, 3) << 0, 1, 2, 1, 3, 2).finished());
    scene.primitive()["mode"] = 6;
    CHECK(parse_mesh(scene.glb()).faces == (Triangles(2, 3) << 1, 2, 0, 2, 3, 0).finished());
    for (const int points_or_lines : {0, 1, 2, 3}) {
        scene.primitive()["mode"] = points_or_lines;
        CHECK_THAT(reading_error(scene.glb()), Catch::Matchers::Contains("surface"));
    }
}

TEST_CASE("read glTF: nodes move what is below them", "[io][gltf]") {
    GltfBuilder scene = tetrahedron_scene();
    scene.json["nodes"] = {{{"translation", {10, 0, 0}}, {"children", {1, 2}}},
                           {{"mesh", 0}, {"rotation", quarter_turn}, {"scale", {2, 1, 1}}},
                           {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 5, 1}}},
                           {{"mesh", 0}}}; // not in the scene
    const auto mesh = parse_mesh(scene.glb());
    REQUIRE(mesh.vertices.rows() == 8);
    check_near(mesh.vertices.row(0), {10, 0, 0});
    check_near(mesh.vertices.row(1), {10, 2, 0}); // x, twice as long, becomes y
    check_near(mesh.vertices.row(2), {9, 0, 0});
    check_near(mesh.vertices.row(3), {10, 0, 1});
    check_near(mesh.vertices.row(7), {10, 0, 4}); // mirrored at z = 0, then lifted
    CHECK(mesh.faces.row(0) == Eigen::RowVector3i(0, 2, 1));
    CHECK(mesh.faces.row(4) == Eigen::RowVector3i(4, 5, 6)); // turned round, or it would be inside out

    scene.json.erase("scenes"); // then all are shown
    scene.json.erase("scene");
    CHECK(parse_mesh(scene.glb()).vertices.rows() == 12);
}

TEST_CASE("read glTF: primitives of the same vertices share them", "[io][gltf]") {
    GltfBuilder scene = tetrahedron_scene();
    Json second = scene.primitive();
    second["indices"] = scene.add<std::uint32_t>("SCALAR", {3, 2, 1});
    scene.json["meshes"][0]["primitives"].push_back(second);
    const auto shared = parse_mesh(scene.glb());
    CHECK(shared.vertices.rows() == 4);
    CHECK(shared.faces.row(4) == Eigen::RowVector3i(3, 2, 1));
    scene.json["meshes"][0]["primitives"][1]["attributes"]["POSITION"] =
        scene.add<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    CHECK(parse_mesh(scene.glb()).vertices.rows() == 8);
}

TEST_CASE("read glTF: skins bend as their joints do", "[io][gltf]") {
    GltfBuilder scene = arm_scene();
    const auto rest = parse_mesh(scene.glb());
    check_near(rest.vertices.row(3), {2, 1, 0}); // also where weights do not sum to 1

    scene.json["nodes"][2]["rotation"] = quarter_turn;
    const auto bent = parse_mesh(scene.glb());
    check_near(bent.vertices.row(0), {0, 0, 0});
    check_near(bent.vertices.row(1), {1, 0, 0});
    check_near(bent.vertices.row(2), {1, 1, 0});
    check_near(bent.vertices.row(3), {0, 1, 0});

    scene.json["skins"][0]["joints"] = {1};
    CHECK_THAT(reading_error(scene.glb()), Catch::Matchers::Contains("joints"));
}

TEST_CASE("read glTF: morph targets by the weights of node and mesh", "[io][gltf]") {
    GltfBuilder scene = tetrahedron_scene();
    const auto up = scene.add<float>("VEC3", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4});
    const auto right = scene.add<float>("VEC3", {8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    scene.primitive()["targets"] = {{{"POSITION", up}}, {{"POSITION", right}}};
    check_is_tetrahedron(scene.glb());
    scene.json["meshes"][0]["weights"] = {0.5, 0.25};
    check_near(parse_mesh(scene.glb()).vertices.row(3), {0, 0, 3});
    check_near(parse_mesh(scene.glb()).vertices.row(0), {2, 0, 0});
    scene.json["nodes"][0]["weights"] = {0, 1};
    check_near(parse_mesh(scene.glb()).vertices.row(3), {0, 0, 1});
    check_near(parse_mesh(scene.glb()).vertices.row(0), {8, 0, 0});
}

TEST_CASE("read glTF: sparse accessors", "[io][gltf]") {
    GltfBuilder scene = tetrahedron_scene();
    const auto indices = scene.add_view(GltfBuilder::raw<std::uint8_t>({1, 3}));
    const auto values = scene.add_view(GltfBuilder::raw<float>({5, 0, 0, 0, 0, 6}));
    Json& positions = scene.json["accessors"][0];
    positions["sparse"] = {{"count", 2},
                           {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                           {"values", {{"bufferView", values}}}};
    const auto mesh = parse_mesh(scene.glb());
    check_near(mesh.vertices.row(1), {5, 0, 0});
    check_near(mesh.vertices.row(2), {0, 1, 0});
    check_near(mesh.vertices.row(3), {0, 0, 6});

    positions.erase("bufferView"); // then the rest is zeros
    check_near(parse_mesh(scene.glb()).vertices.row(2), {0, 0, 0});
    check_near(parse_mesh(scene.glb()).vertices.row(3), {0, 0, 6});
    positions["count"] = 3;
    CHECK_THAT(reading_error(scene.glb()), Catch::Matchers::Contains("names a row that does not exist"));
    positions["count"] = 1000000000;
    CHECK_THAT(reading_error(scene.glb()), Catch::Matchers::Contains("glTF"));
}

TEST_CASE("read glTF: quantised positions, strides and offsets", "[io][gltf]") {
    GltfBuilder scene = tetrahedron_scene();
    // Four shorts a row, of which the last is not used, behind a row that is left out.
    const auto view = scene.add_view(
        GltfBuilder::raw<std::int16_t>({9, 9, 9, 9, 0, 0, 0, 9, 32767, 0, 0, 9, 0, -32768, 0, 9, 0, 0, 32767, 9}));
    scene.json["bufferViews"][view]["byteStride"] = 8;
    scene.json["accessors"][0] = {{"bufferView", view}, {"byteOffset", 8},    {"componentType", 5122},
                                  {"count", 4},         {"normalized", true}, {"type", "VEC3"}};
    scene.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    scene.json["nodes"][0]["scale"] = {3, 3, 3};
    const auto mesh = parse_mesh(scene.glb());
    check_near(mesh.vertices.row(1), {3, 0, 0});
    check_near(mesh.vertices.row(2), {0, -3, 0}); // -32768 is -1, not less
    check_near(mesh.vertices.row(3), {0, 0, 3});
    scene.json["accessors"][0]["normalized"] = false;
    check_near(parse_mesh(scene.glb()).vertices.row(2), {0, -3 * 32768.0, 0});
}

TEST_CASE("read glTF: animations", "[io][gltf]") {
    GltfBuilder scene = arm_scene();
    const auto times = scene.add<float>("SCALAR", {1, 3});
    const auto turns = scene.add<float>("VEC4", {0, 0, 0, 1, 0, 0, float(half_root), float(half_root)});
    const auto shifts = scene.add<float>("VEC3", {0, 0, 0, 0, 0, 8});
    // In tangent, value and out tangent of both keys: from 0 to 8, leaving and arriving at rest.
    const auto cubic = scene.add<float>("VEC3", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8, 0, 0, 0});
    const auto animation = [&](const std::string& name, int node, const char* path, std::size_t output,
                               const char* interpolation) {
        return Json{{"name", name},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}},
                    {"samplers", {{{"input", times}, {"output", output}, {"interpolation", interpolation}}}}};
    };
    scene.json["animations"] = {
        animation("bend", 2, "rotation", turns, "LINEAR"), animation("lift", 1, "translation", shifts, "LINEAR"),
        animation("jump", 1, "translation", shifts, "STEP"), animation("ease", 1, "translation", cubic, "CUBICSPLINE")};
    const auto vertex = [&](const std::string& name, double time, int row) -> Row {
        return parse_mesh(scene.glb(), ReadMeshOptions{std::nullopt, name, time}).vertices.row(row);
    };
    const double eighth = std::numbers::pi / 4;
    check_near(vertex("bend", 2, 2), {1 + std::cos(eighth), std::sin(eighth), 0});
    check_near(vertex("1", 2, 2), {1 + std::cos(eighth), std::sin(eighth), 0}); // by number
    check_near(vertex("bend", -5, 2), {2, 0, 0});
    check_near(vertex("bend", 99, 2), {1, 1, 0});
    check_near(vertex("lift", 1.5, 0), {0, 0, 2});
    check_near(vertex("jump", 2.999, 0), {0, 0, 0});
    check_near(vertex("jump", 3, 0), {0, 0, 8});
    check_near(vertex("ease", 1.5, 0), {0, 0, 8 * (3 * 0.0625 - 2 * 0.015625)});
    check_near(parse_mesh(scene.glb()).vertices.row(2), {2, 0, 0}); // none: as stored

    const auto error = [&](const std::string& name) -> std::string {
        try {
            static_cast<void>(vertex(name, 0, 0));
        } catch (const Error& failure) {
            CHECK(failure.code() == ErrorCode::usage);
            return failure.what();
        }
        return "none";
    };
    CHECK_THAT(error("walk"), Catch::Matchers::Contains("'bend', 'lift', 'jump', 'ease'"));
    CHECK_THAT(error("5"), Catch::Matchers::Contains("from 1 to 4"));
    CHECK_THROWS_AS(parse_mesh(format_mesh(tetrahedron(), MeshFormat::off), ReadMeshOptions{std::nullopt, "1", 0}),
                    Error);

    scene.json["accessors"][times]["count"] = 1; // two values and one time
    CHECK_THROWS_AS(vertex("jump", 0, 0), Error);
}

TEST_CASE("read glTF: animated morph targets, and nodes with a matrix", "[io][gltf]") {
    GltfBuilder scene = tetrahedron_scene();
    const auto up = scene.add<float>("VEC3", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4});
    scene.primitive()["targets"] = {{{"POSITION", up}}};
    const auto times = scene.add<float>("SCALAR", {0, 2});
    const auto weights = scene.add<float>("SCALAR", {0, 1});
    const auto scales = scene.add<float>("VEC3", {1, 1, 1, 1, 3, 1});
    scene.json["nodes"][0]["matrix"] = {0, 2, 0, 0, -1, 0, 0, 0,
                                        0, 0, 1, 0, 5,  0, 0, 1}; // x twice as long, a quarter turn
    scene.json["animations"] = {
        {{"channels",
          {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}},
           {{"sampler", 1}, {"target", {{"node", 0}, {"path", "scale"}}}}}},
         {"samplers", {{{"input", times}, {"output", weights}}, {{"input", times}, {"output", scales}}}}}};
    const auto mesh = parse_mesh(scene.glb(), ReadMeshOptions{std::nullopt, "1", 1.0});
    check_near(mesh.vertices.row(1), {5, 1, 0}); // scale 1, 2, 1 in place of 2, 1, 1
    check_near(mesh.vertices.row(2), {3, 0, 0});
    check_near(mesh.vertices.row(3), {5, 0, 3});
}

TEST_CASE("read glTF: what does not hold together is refused, with its place", "[io][gltf]") {
    struct Fault {
        std::string told;
        std::function<void(GltfBuilder&)> make;
    };
    const auto primitive = [](auto change) { return [change](GltfBuilder& scene) { change(scene.primitive()); }; };
    const auto json = [](auto change) { return [change](GltfBuilder& scene) { change(scene.json); }; };
    const std::vector<Fault> faults{
        {"version 1.0", json([](Json& j) { j["asset"]["version"] = "1.0"; })},
        {"\"asset\"", json([](Json& j) { j.erase("asset"); })},
        {"EXT_unheard_of", json([](Json& j) { j["extensionsRequired"] = {"EXT_unheard_of"}; })},
        {"accessors[0]", json([](Json& j) { j["accessors"][0]["count"] = 5; })},
        {"larger", json([](Json& j) { j["accessors"][0]["count"] = 1099511627776; })},
        {"whole number", json([](Json& j) { j["accessors"][0]["count"] = -1; })},
        {"whole number", json([](Json& j) { j["accessors"][0]["count"] = 1.5; })},
        {"accessors[0]", json([](Json& j) { j["accessors"][0]["byteOffset"] = 1099511627776; })},
        {"accessors[0]", json([](Json& j) { j["accessors"][0]["componentType"] = 5124; })},
        {"VEC9", json([](Json& j) { j["accessors"][0]["type"] = "VEC9"; })},
        {"whose rows have 2 numbers", json([](Json& j) { j["accessors"][0]["type"] = "VEC2"; })},
        {"overlap", json([](Json& j) { j["bufferViews"][0]["byteStride"] = 4; })},
        {"accessors[0]", json([](Json& j) { j["bufferViews"][0]["byteStride"] = 1099511627776; })},
        {"bufferViews[0]", json([](Json& j) { j["bufferViews"][0]["byteLength"] = 1099511627776; })},
        {"bufferViews[0]", json([](Json& j) { j["bufferViews"][0]["byteOffset"] = 1099511627776; })},
        {"buffers", json([](Json& j) { j["bufferViews"][0]["buffer"] = 1; })},
        {"bufferViews", json([](Json& j) { j["accessors"][0]["bufferView"] = 77; })},
        {"accessors", primitive([](Json& p) { p["attributes"]["POSITION"] = 77; })},
        {"POSITION", primitive([](Json& p) { p["attributes"].erase("POSITION"); })},
        {"mode", primitive([](Json& p) { p["mode"] = 7; })},
        {"vertex that does not exist",
         [](GltfBuilder& s) {
             s.primitive()["indices"] = s.add<std::uint16_t>("SCALAR", {0, 1, 4});
         }},
        {"vertex that does not exist",
         [](GltfBuilder& s) {
             s.primitive()["indices"] = s.add<float>("SCALAR", {0, 1, NAN});
         }},
        {"not a number",
         [](GltfBuilder& s) {
             s.primitive()["attributes"]["POSITION"] = s.add<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, NAN});
         }},
        {"no mesh", json([](Json& j) { j["nodes"][0].erase("mesh"); })},
        {"no mesh", json([](Json& j) { j["scenes"][0]["nodes"] = Json::array(); })},
        {"meshes", json([](Json& j) { j["nodes"][0]["mesh"] = 1; })},
        {"nodes", json([](Json& j) { j["scenes"][0]["nodes"] = {4}; })},
        {"scenes", json([](Json& j) { j["scene"] = 4; })},
        {"ancestor", json([](Json& j) { j["nodes"][0]["children"] = {0}; })},
        {"ancestor", json([](Json& j) {
             j["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
         })},
        {"two parents", json([](Json& j) {
             j["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}};
         })},
        {"rotation", json([](Json& j) {
             j["nodes"][0]["rotation"] = {0, 0, 0, 0};
         })},
        {"translation", json([](Json& j) {
             j["nodes"][0]["translation"] = {0, 0};
         })},
        {"translation", json([](Json& j) {
             j["nodes"][0]["translation"] = {0, 0, "0"};
         })},
        {"skins", json([](Json& j) { j["nodes"][0]["skin"] = 0; })},
        {"not a number, infinite", json([](Json& j) {
             j["nodes"][0]["scale"] = {1e308, 1e308, 1e308};
             j["nodes"][0]["translation"] = {1e308, 0, 0};
         })},
    };
    for (const Fault& fault : faults) {
        GltfBuilder scene = tetrahedron_scene();
        fault.make(scene);
        const std::string error = reading_error(scene.glb());
        INFO(scene.json.dump() << "\n" << error);
        CHECK_THAT(error, Catch::Matchers::Contains(fault.told));
    }
    CHECK(reading_error("{\"asset\": \x81 \xff}").find('\x81') == std::string::npos); // messages are UTF-8
    CHECK_THAT(reading_error(std::string(1000000, '[') + "\"asset\"", MeshFormat::gltf),
               Catch::Matchers::Contains("nested"));
    CHECK_THAT(reading_error(tetrahedron_scene().gltf("data:text/plain,abc")), Catch::Matchers::Contains("base64"));
    CHECK_THAT(reading_error(tetrahedron_scene().gltf("data:;base64,%%%%")), Catch::Matchers::Contains("base64"));
}

TEST_CASE("read glTF: a small file does not make a huge mesh", "[io][gltf][slow]") {
    GltfBuilder scene = tetrahedron_scene();
    const std::vector<float> many(3 * 20000, 1.0F);
    scene.primitive()["attributes"]["POSITION"] = scene.add<float>("VEC3", many);
    for (int i = 0; i < 1000; ++i) {
        scene.json["nodes"].push_back({{"mesh", 0}});
        scene.json["scenes"][0]["nodes"].push_back(i + 1);
    }
    CHECK_THAT(reading_error(scene.glb()), Catch::Matchers::Contains("larger than its file"));

    const auto crowd = [](const char* list) { // 3000 nodes of one mesh, which has 10,000 of something
        GltfBuilder large = tetrahedron_scene();
        if (list == std::string("weights")) large.json["meshes"][0]["weights"] = std::vector<int>(10000, 0);
        if (list == std::string("primitives"))
            large.json["meshes"][0]["primitives"] =
                std::vector<Json>(10000, {{"attributes", Json::object()}, {"mode", 0}});
        if (list == std::string("joints")) large.json["skins"] = {{{"joints", std::vector<int>(10000, 0)}}};
        for (int i = 1; i <= 3000; ++i) {
            large.json["nodes"].push_back({{"mesh", 0}});
            if (list == std::string("joints")) large.json["nodes"].back()["skin"] = 0;
            large.json["scenes"][0]["nodes"].push_back(i);
        }
        return large.glb();
    };
    for (const char* const list : {"weights", "primitives", "joints"}) {
        INFO(list);
        CHECK_THAT(reading_error(crowd(list)), Catch::Matchers::Contains("larger than its file"));
    }
}
