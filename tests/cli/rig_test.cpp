#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/scene_looks.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "catch.hpp"
#include "io/gltf_builder.hpp"
#include "run_cli.hpp"
#include "shapes.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::test;
namespace fs = std::filesystem;

TEST_CASE("rig: characters and skeletons, the input's vertices in their order", "[cli][rig]") {
    const TemporaryFolder folder;
    const CliResult as_is = run_cli(folder.path(), {"rig", sample_body, "-o", "body.glb"});
    INFO(as_is.err);
    REQUIRE(as_is.status == 0);
    CHECK((as_is.out + as_is.err).empty());
    const auto mesh = read_mesh(sample_body), bound = read_mesh(folder / "body.glb");
    CHECK(bound.faces == mesh.faces);
    CHECK((bound.vertices.row(0) - bound.vertices.row(99)).norm() ==
          Approx((mesh.vertices.row(0) - mesh.vertices.row(99)).norm()).epsilon(1e-5));

    REQUIRE(run_cli(folder.path(), {"rig", sample_body, "-o", "body.vrm"}).status == 0);
    const auto t_pose = read_mesh(folder / "body.vrm");
    const double width = t_pose.vertices.col(0).maxCoeff() - t_pose.vertices.col(0).minCoeff();
    const double height = t_pose.vertices.col(1).maxCoeff() - t_pose.vertices.col(1).minCoeff();
    CHECK(width / height > 0.9); // arms to the sides

    REQUIRE(run_cli(folder.path(), {"rig", sample_body, "-o", "body.BVH", "--names", "mixamo", "--rest", "a-pose"})
                .status == 0);
    CHECK(test::read_file(folder / "body.BVH").find("JOINT LeftForeArm") != std::string::npos);
}

TEST_CASE("rig and pose: a character without its pictures loses these alone, which is said", "[cli][rig][pose]") {
    const auto mesh = read_mesh(sample_body);
    const TriangleMesh<float> single{mesh.vertices.cast<float>(), mesh.faces};
    GltfBuilder scene;
    scene.add_tetrahedron();
    scene.primitive()["attributes"]["POSITION"] =
        scene.add<float>("VEC3", {single.vertices.data(), single.vertices.data() + single.vertices.size()});
    scene.primitive()["indices"] =
        scene.add<std::uint32_t>("SCALAR", {mesh.faces.data(), mesh.faces.data() + mesh.faces.size()});
    scene.primitive()["material"] = 0;
    scene.json["materials"] = {{{"name", "skin"}}};
    scene.json["images"] = {{{"uri", "missing.png"}}};
    const TemporaryFolder folder;
    test::write_file(folder / "character.glb", scene.glb());
    for (const auto& arguments :
         {std::vector<std::string>{"rig", "character.glb", "-o", "out.glb"},
          std::vector<std::string>{"pose", "character.glb", "--like", sample_body, "-o", "out.glb"}}) {
        const CliResult result = run_cli(folder.path(), arguments);
        INFO(result.err);
        CHECK(result.status == 0);
        CHECK(result.err.rfind("skelgen: warning: character.glb: 1 picture is left out: ", 0) == 0);
        CHECK(result.err.find("missing.png") != std::string::npos);
        CHECK(read_mesh(folder / "out.glb").faces == mesh.faces);
        CHECK(io::read_looks(folder / "out.glb")->json.find("skin") != std::string::npos);
    }
    const CliResult piped = run_shell(folder.path(), "$skelgen rig - -o out.glb < character.glb");
    CHECK(piped.status == 0);
    CHECK(piped.err.rfind("skelgen: warning: -: 1 picture is left out: ", 0) == 0);
    CHECK(io::read_looks(folder / "out.glb")->json.find("skin") != std::string::npos);
    const CliResult batch = run_cli(folder.path(), {"batch", "character.glb", "-o", "batch", "--also", "rig", "-q"});
    INFO(batch.err);
    CHECK(batch.status == 0);
    CHECK(test::read_file(folder / "batch/summary.jsonl").find("1 picture is left out: ") != std::string::npos);
}

TEST_CASE("rig: what cannot be done is one line and no file", "[cli][rig]") {
    const TemporaryFolder folder;
    write_mesh(folder / "capsule.off", capsule(0.2, 2));
    const auto fails = [&](const std::vector<std::string>& arguments, int status) {
        std::vector<std::string> all{"rig"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const CliResult result = run_cli(folder.path(), all);
        CHECK(result.status == status);
        CHECK(result.err.rfind("skelgen: error: ", 0) == 0);
        CHECK(result.err.find('\n') == result.err.size() - 1);
        CHECK(files_below(folder.path()) == std::vector<std::string>{"capsule.off"});
    };
    fails({"capsule.off", "-o", "x.glb"}, 4);
    fails({"missing.off", "-o", "x.glb"}, 3);
    fails({"capsule.off", "-o", "x.fbx"}, 2);
    fails({"capsule.off"}, 2);
    fails({"capsule.off", "-o", "x.glb", "--names", "maya"}, 2);
    fails({"capsule.off", "-o", "x.vrm", "--rest", "a-pose"}, 2);
    fails({"capsule.off", "-o", "capsule.off"}, 2);
    fails({sample_body, "-o", "no/such/folder/x.glb"}, 2);
    const CliResult nowhere = run_cli(folder.path(), {"rig", sample_body, "-o", "no/such/folder/x.glb"});
    CHECK(nowhere.err.rfind("skelgen: error: no/such/folder/x.glb: cannot be written", 0) == 0); // it is not the mesh's
}

} // namespace
