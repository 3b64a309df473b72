#include <filesystem>
#include <string>
#include <vector>

#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "catch.hpp"
#include "run_cli.hpp"
#include "shapes.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::test;

const std::string walk = SKELGEN_DATA "/sample/walk.bvh";

TEST_CASE("animate: a walk as the animation of a character, and one of its frames as a pose", "[cli][animate]") {
    const TemporaryFolder folder;
    const CliResult animated =
        run_cli(folder.path(), {"animate", sample_body, "--bvh", walk, "-o", "walking.glb", "--names", "mixamo"});
    INFO(animated.err);
    REQUIRE(animated.status == 0);
    CHECK((animated.out + animated.err).empty());
    const CliResult held =
        run_cli(folder.path(), {"pose", sample_body, "--bvh", walk, "--frame", "15", "-o", "held.off"});
    INFO(held.err);
    REQUIRE(held.status == 0);

    // The file's animation, as other readers see it, at the time of that frame: the same, but where skinning differs.
    io::ReadMeshOptions options;
    options.animation = "walk";
    options.time = 15.0 / 30;
    const auto mesh = read_mesh(sample_body), pose = read_mesh(folder / "held.off");
    const auto shown = read_mesh(folder / "walking.glb", options);
    REQUIRE(shown.faces == mesh.faces);
    REQUIRE(pose.faces == mesh.faces);
    CHECK((shown.vertices - pose.vertices).rowwise().norm().mean() < 0.003);
    CHECK((shown.vertices - pose.vertices).rowwise().norm().maxCoeff() < 0.05);
    CHECK(shown.vertices.col(1).minCoeff() == Approx(0).margin(0.03)); // feet on the floor
    CHECK(shown.vertices.col(2).mean() > 0.4);                         // half of the way
    CHECK(shown.vertices.col(2).mean() < 0.8);
    CHECK(shown.vertices.col(1).maxCoeff() > 1.6);
}

TEST_CASE("animate: FBX has what GLB has", "[cli][animate]") {
    const TemporaryFolder folder;
    for (const char* name : {"walking.glb", "walking.fbx"}) {
        const CliResult animated = run_cli(folder.path(), {"animate", sample_body, "--bvh", walk, "-o", name});
        INFO(animated.err);
        REQUIRE(animated.status == 0);
    }
    io::ReadMeshOptions options;
    options.animation = "walk";
    options.time = 0.5;
    const auto glb = read_mesh(folder / "walking.glb", options), fbx = read_mesh(folder / "walking.fbx", options);
    REQUIRE(fbx.vertices.rows() == glb.vertices.rows());
    REQUIRE(fbx.faces.rows() == glb.faces.rows());
    for (Eigen::Index i = 0; i < glb.faces.size(); i += 100)
        CHECK((fbx.vertices.row(fbx.faces.data()[i]) - 100 * glb.vertices.row(glb.faces.data()[i])).norm() < 1e-3);
}

TEST_CASE("animate and rig: with the bones that engines know all is shown as without", "[cli][animate][rig][engine]") {
    const TemporaryFolder folder;
    const auto animate = [&](const std::string& clip, const std::string& out, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"animate", sample_body, "--clip", clip, "-o", out};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CliResult animated = run_cli(folder.path(), arguments);
        INFO(animated.err);
        REQUIRE(animated.status == 0);
    };
    io::ReadMeshOptions options;
    options.animation = "1";
    options.time = 0.5;
    const auto shown = [&](const char* name) { return read_mesh(folder / name, options); };
    animate(walk, "plain.glb", {});
    animate(walk, "engine.glb", {"--bones", "engine"});
    animate(walk, "engine.fbx", {"--bones", "engine", "--names", "unreal"});
    animate("engine.glb", "again.glb", {}); // a clip whose skeleton has these bones
    const auto plain = shown("plain.glb"), engine = shown("engine.glb"), fbx = shown("engine.fbx");
    CHECK((engine.vertices - plain.vertices).cwiseAbs().maxCoeff() < 0.004); // a vertex has four joints of more
    for (Eigen::Index i = 0; i < plain.faces.size(); i += 100)
        CHECK((fbx.vertices.row(fbx.faces.data()[i]) - 100 * engine.vertices.row(engine.faces.data()[i])).norm() <
              1e-2);
    CHECK((shown("again.glb").vertices - plain.vertices).rowwise().norm().mean() < 0.02); // of 1.7 m

    for (const char* name : {"body.glb", "body.vrm", "body.fbx", "body.bvh"}) {
        const CliResult rigged =
            run_cli(folder.path(), {"rig", sample_body, "--bones", "engine", "--twist", "-q", "-o", name});
        INFO(rigged.err);
        REQUIRE(rigged.status == 0);
        const std::string text = test::read_file(folder / name);
        const bool is_vrm = std::string(name) == "body.vrm";
        CHECK(text.find(is_vrm ? "\"leftShoulder\"" : "left_clavicle") != std::string::npos);
        CHECK(text.find(is_vrm ? "\"upperChest\"" : "upper_chest") != std::string::npos);
        CHECK(text.find("left_forearm_twist") != std::string::npos);
    }
    CHECK(run_cli(folder.path(), {"rig", sample_body, "--bones", "motor", "-o", "x.glb"}).status == 2);
}

TEST_CASE("animate and rig: a body of no person's height is said to have an unknown unit", "[cli][animate][rig]") {
    const TemporaryFolder folder;
    auto giant = read_mesh(sample_body);
    giant.vertices *= 20;
    write_mesh(folder / "giant.off", giant);
    for (const auto& arguments : {std::vector<std::string>{"rig", "giant.off", "-o", "giant.glb"},
                                  std::vector<std::string>{"animate", "giant.off", "--bvh", walk, "-o", "giant.glb"}}) {
        const CliResult result = run_cli(folder.path(), arguments);
        CHECK(result.status == 0);
        CHECK_THAT(result.err, Catch::Matchers::StartsWith("skelgen: warning: giant.off: its unit is unknown"));
    }
}

TEST_CASE("animate and pose: what cannot be done is one line and no file", "[cli][animate]") {
    const TemporaryFolder folder;
    write_mesh(folder / "capsule.off", capsule(0.2, 2));
    test::write_file(folder / "odd.bvh", "HIERARCHY\n");
    test::write_file(folder / "arm.bvh",
                     "HIERARCHY ROOT arm\n{ OFFSET 0 0 0 CHANNELS 1 Xrotation }\nMOTION\nFrames: 1\n"
                     "Frame Time: 0.1\n0\n");
    const auto fails = [&](const std::vector<std::string>& arguments, int status, const std::string& reason) {
        const CliResult result = run_cli(folder.path(), arguments);
        INFO(result.err);
        CHECK(result.status == status);
        CHECK(result.err.rfind("skelgen: error: " + reason, 0) == 0);
        CHECK(result.err.find('\n') == result.err.size() - 1);
        CHECK(files_below(folder.path()) == std::vector<std::string>{"arm.bvh", "capsule.off", "odd.bvh"});
    };
    fails({"animate", "capsule.off", "--bvh", walk, "-o", "x.glb"}, 4, "capsule.off: ");
    fails({"animate", sample_body, "--bvh", "missing.bvh", "-o", "x.glb"}, 3, "missing.bvh: ");
    fails({"animate", sample_body, "--bvh", "odd.bvh", "-o", "x.glb"}, 3, "odd.bvh: line 2: the file ends too early");
    fails({"animate", sample_body, "--bvh", "arm.bvh", "-o", "x.glb"}, 3, "arm.bvh: the clip's skeleton is not known");
    fails({"animate", sample_body, "--bvh", walk, "-o", "x.bvh"}, 2, "x.bvh: its name must end in .glb");
    // What is wrong with the clip is said before the body is looked for.
    fails({"animate", "capsule.off", "--bvh", "arm.bvh", "-o", "x.glb"}, 3,
          "arm.bvh: the clip's skeleton is not known");
    fails({"pose", "capsule.off", "--bvh", walk, "--frame", "30", "-o", "x.off"}, 2, walk + ": has no frame 30");
    fails({"animate", "capsule.off", "--bvh", walk, "-o", "no/x.glb"}, 2, "no/x.glb: cannot be written: its folder");
    fails({"pose", "capsule.off", "--bvh", walk, "-o", "no/x.off"}, 2, "no/x.off: cannot be written: its folder");
    fails({"animate", sample_body, "-o", "x.glb"}, 2, "animate: --clip is required");
    fails({"animate", sample_body, "--bvh", "arm.bvh", "-o", "arm.bvh"}, 2, "arm.bvh: is the input");
    fails({"pose", sample_body, "--bvh", walk, "--frame", "30", "-o", "x.off"}, 2, walk + ": has no frame 30");
    fails({"pose", sample_body, "--bvh", "odd.bvh", "-o", "x.off"}, 3, "odd.bvh: ");
    fails({"pose", sample_body, "--like", "capsule.off", "--frame", "1", "-o", "x.off"}, 2,
          "pose: --frame requires --clip");
    fails({"pose", sample_body, "--bvh", walk, "--frame", "-1", "-o", "x.off"}, 2, "pose: ");
}

} // namespace
