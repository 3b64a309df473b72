#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "catch.hpp"
#include "io/gltf_builder.hpp"
#include "run_cli.hpp"
#include "shapes.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::test;
namespace fs = std::filesystem;

/// Runs a conversion that must fail, and gives its one line of error.
std::string conversion_error(const fs::path& folder, const std::vector<std::string>& arguments, int status) {
    std::vector<std::string> all{"convert"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const CliResult result = run_cli(folder, all);
    CHECK(result.status == status);
    CHECK(result.out.empty());
    CHECK(result.err.rfind("skelgen: error: ", 0) == 0);
    CHECK(result.err.find('\n') == result.err.size() - 1);
    return result.err;
}

TEST_CASE("convert: a mesh goes through all formats and keeps its vertices and faces", "[cli][convert]") {
    const TemporaryFolder folder;
    const auto mesh = read_mesh(sample_body);
    std::string last = sample_body;
    for (const std::string name : {"1.obj", "2.glb", "3.ply", "4.off"}) {
        CAPTURE(name);
        const CliResult result = run_cli(folder.path(), {"convert", last, name});
        REQUIRE(result.status == 0);
        CHECK((result.out + result.err).empty());
        last = name;
    }
    const auto back = read_mesh(folder / last);
    CHECK((back.faces == mesh.faces));
    CHECK((back.vertices - mesh.vertices).cwiseAbs().maxCoeff() < 1e-6); // GLB has floats
    REQUIRE(run_cli(folder.path(), {"convert", last, "5.stl"}).status == 0);
    REQUIRE(run_cli(folder.path(), {"convert", "-o", "6.stl", last}).status == 0); // as with other commands
    CHECK(test::read_file(folder / "6.stl") == test::read_file(folder / "5.stl"));
    CHECK(read_mesh(folder / "5.stl").faces.rows() == mesh.faces.rows());
}

TEST_CASE("convert: scenes as they are stored, and as an animation has them", "[cli][convert]") {
    GltfBuilder scene;
    scene.add_tetrahedron();
    const auto times = scene.add<float>("SCALAR", {0, 2});
    const auto shifts = scene.add<float>("VEC3", {0, 0, 0, 0, 0, 8});
    scene.json["animations"] = {{{"name", "lift"},
                                 {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
                                 {"samplers", {{{"input", times}, {"output", shifts}}}}}};
    const TemporaryFolder folder;
    test::write_file(folder / "scene.vrm", scene.glb());
    REQUIRE(run_cli(folder.path(), {"convert", "scene.vrm", "still.obj"}).status == 0);
    CHECK(read_mesh(folder / "still.obj").vertices(3, 2) == 1);
    REQUIRE(
        run_cli(folder.path(), {"convert", "scene.vrm", "moved.obj", "--animation", "lift", "--time", "0.5"}).status ==
        0);
    CHECK(read_mesh(folder / "moved.obj").vertices(3, 2) == 3);

    CHECK_THAT(conversion_error(folder.path(), {"scene.vrm", "x.obj", "--animation", "drop"}, 2),
               Catch::Matchers::Contains("scene.vrm: has no animation 'drop'; choose one of 'lift'"));
    CHECK_THAT(conversion_error(folder.path(), {"still.obj", "x.obj", "--animation", "lift"}, 2),
               Catch::Matchers::Contains("no animations"));
    CHECK_THAT(conversion_error(folder.path(), {"scene.vrm", "x.obj", "--time", "1"}, 2),
               Catch::Matchers::Contains("--animation"));
    CHECK_FALSE(fs::exists(folder / "x.obj"));
}

TEST_CASE("convert: what cannot be read or written", "[cli][convert]") {
    const TemporaryFolder folder;
    write_mesh(folder / "a.off", capsule(0.2, 2));
    CHECK_THAT(conversion_error(folder.path(), {"a.off", "a.dae"}, 2), Catch::Matchers::Contains(".glb"));
    CHECK_THAT(conversion_error(folder.path(), {"a.off", "a"}, 2), Catch::Matchers::Contains(".glb"));
    CHECK_THAT(conversion_error(folder.path(), {"a.off", "a.off"}, 2), Catch::Matchers::Contains("is the input"));
    CHECK_THAT(conversion_error(folder.path(), {"missing.off", "b.off"}, 3),
               Catch::Matchers::Contains("missing.off: "));
    test::write_file(folder / "points.ply",
                     "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                     "property float z\nend_header\n0 0 0\n1 1 1\n");
    CHECK_THAT(conversion_error(folder.path(), {"points.ply", "b.off"}, 3), Catch::Matchers::Contains("surface"));
    test::write_file(folder / "points.obj", "v 0 0 0\nv 1 1 1\n");
    CHECK_THAT(conversion_error(folder.path(), {"points.obj", "b.off"}, 3), Catch::Matchers::Contains("surface"));
    test::write_file(folder / "huge.off", "OFF\n");
    fs::resize_file(folder / "huge.off", std::uintmax_t{10} << 30U); // which the disk does not hold
    CHECK_THAT(conversion_error(folder.path(), {"huge.off", "b.off"}, 3), Catch::Matchers::Contains("2 GiB"));
}

TEST_CASE("meshes from standard input, their format told by content or by --format", "[cli][convert]") {
    const TemporaryFolder folder;
    fs::copy_file(sample_body, folder / "body.off");
    REQUIRE(run_shell(folder.path(), "$skelgen convert - body.glb < body.off").status == 0);
    CHECK(read_mesh(folder / "body.glb").faces.rows() == read_mesh(sample_body).faces.rows());

    const CliResult piped = run_shell(folder.path(), "cat body.off | $skelgen extract -");
    const CliResult named = run_cli(folder.path(), {"extract", "body.off"});
    REQUIRE(piped.status == 0);
    REQUIRE(named.status == 0);
    const auto from_pipe = nlohmann::json::parse(piped.out), from_file = nlohmann::json::parse(named.out);
    CHECK(from_pipe.at("joints") == from_file.at("joints"));
    CHECK(from_pipe.at("mesh").at("file") == "-");

    test::write_file(folder / "odd", "shading on\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK(run_shell(folder.path(), "$skelgen convert - odd.off < odd").status == 3);
    CHECK(run_shell(folder.path(), "$skelgen convert - odd.off --format OBJ < odd").status == 0);
    CHECK(run_cli(folder.path(), {"convert", "odd", "odd.off", "--format", "obj"}).status == 0);
    CHECK(run_cli(folder.path(), {"convert", "odd", "odd.off", "--format", "doc"}).status == 2);
    CHECK(run_shell(folder.path(), "$skelgen convert - empty.off < /dev/null").status == 3);
}

TEST_CASE("batch finds scenes and leaves their outputs apart from others'", "[cli][convert]") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "in");
    write_mesh(folder / "in/body.glb", read_mesh(sample_body));
    REQUIRE(run_cli(folder.path(), {"batch", "in", "-o", "out", "-q"}).status == 0);
    CHECK(fs::exists(folder / "out/body.json"));
}

} // namespace
