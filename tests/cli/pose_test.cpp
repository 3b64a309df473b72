#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "catch.hpp"
#include "run_cli.hpp"
#include "shapes.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::test;
namespace fs = std::filesystem;

TEST_CASE("pose: like another mesh, or like a skeleton", "[cli][pose]") {
    const TemporaryFolder folder;
    // The model is the same body, ten times as large and lying on its back: the body lies down, too.
    auto lying = read_mesh(sample_body);
    const auto mesh = lying;
    lying.vertices = 10 * mesh.vertices * Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
    write_mesh(folder / "lying.off", lying);
    const CliResult like = run_cli(folder.path(), {"pose", sample_body, "--like", "lying.off", "-o", "like.off"});
    INFO(like.err);
    REQUIRE(like.status == 0);
    CHECK((like.out + like.err).empty());
    REQUIRE(run_cli(folder.path(), {"extract", "lying.off", "-o", "lying.json"}).status == 0);
    REQUIRE(run_cli(folder.path(), {"pose", sample_body, "--pose", "lying.json", "-o", "pose.glb"}).status == 0);
    const auto from_mesh = read_mesh(folder / "like.off"), from_skeleton = read_mesh(folder / "pose.glb");
    REQUIRE(from_mesh.faces == mesh.faces);
    const auto spread = [](const TriangleMesh<double>& of) {
        return (of.vertices.rowwise() - of.vertices.colwise().mean()).eval();
    };
    CHECK((10 * spread(from_mesh) - spread(lying)).cwiseAbs().maxCoeff() < 1e-3);
    CHECK((spread(from_skeleton) - spread(from_mesh)).cwiseAbs().maxCoeff() < 1e-4); // GLB has floats
}

TEST_CASE("pose: a skeleton's file that shows no pose is what is to blame", "[cli][pose]") {
    const TemporaryFolder folder;
    REQUIRE(run_cli(folder.path(), {"extract", sample_body, "-o", "body.json"}).status == 0);
    const auto body = nlohmann::json::parse(test::read_file(folder / "body.json"));
    const auto is_refused = [&](const nlohmann::json& skeleton, const std::string& reason) {
        test::write_file(folder / "odd.json", skeleton.dump());
        const CliResult result = run_cli(folder.path(), {"pose", sample_body, "--pose", "odd.json", "-o", "x.off"});
        INFO(result.err);
        CHECK(result.status == 3);
        CHECK(result.err.rfind("skelgen: error: odd.json: " + reason, 0) == 0);
        CHECK_FALSE(fs::exists(folder / "x.off"));
    };
    auto odd = body;
    odd["joints"].erase(odd["joints"].size() - 1);
    is_refused(odd, "its joints are not those of the template human21");
    odd = body;
    for (auto& joint : odd["joints"]) joint["position"] = {1, 2, 3};
    is_refused(odd, "its bones have no length");
    odd = body;
    odd["joints"][7]["position"] = {0, 1e300, 0};
    const std::string name = odd["joints"][7]["name"];
    is_refused(odd, "its joint " + name + " has a position that is too large or not finite");
    odd["joints"][7]["position"] = {0, 1e20, 0};
    is_refused(odd, "the bone to its joint " + name + " is more than 100 times as long as the others");
    odd = body;
    odd["template"] = "pinocchio18";
    is_refused(odd, "is a skeleton of the template pinocchio18");
}

TEST_CASE("pose: what cannot be done is one line and no file", "[cli][pose]") {
    const TemporaryFolder folder;
    write_mesh(folder / "capsule.off", capsule(0.2, 2));
    test::write_file(folder / "odd.json", "{}");
    const auto fails = [&](const std::vector<std::string>& arguments, int status) {
        std::vector<std::string> all{"pose"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const CliResult result = run_cli(folder.path(), all);
        CHECK(result.status == status);
        CHECK(result.err.rfind("skelgen: error: ", 0) == 0);
        CHECK(result.err.find('\n') == result.err.size() - 1);
        CHECK(files_below(folder.path()) == std::vector<std::string>{"capsule.off", "odd.json"});
    };
    fails({sample_body, "--like", "capsule.off", "-o", "x.off"}, 4);
    fails({sample_body, "--like", "missing.off", "-o", "x.off"}, 3);
    fails({sample_body, "--pose", "odd.json", "-o", "x.off"}, 3);
    fails({sample_body, "-o", "x.off"}, 2);
    fails({sample_body, "--pose", "odd.json", "--like", "capsule.off", "-o", "x.off"}, 2);
    fails({sample_body, "--like", "capsule.off", "-o", "x.vrm"}, 2);
    fails({sample_body, "--like", "capsule.off", "-o", "capsule.off"}, 2);
}

} // namespace
