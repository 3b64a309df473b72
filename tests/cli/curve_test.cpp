#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/io/curve_formats.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "run_cli.hpp"
#include "shapes.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::test;
namespace fs = std::filesystem;

/// The curve that the program writes with these options.
CurveSkeleton<double> curve_by_cli(const fs::path& folder, const std::string& mesh, std::vector<std::string> options) {
    options.insert(options.begin(), {"curve", mesh, "-o", "out.json"});
    const CliResult result = run_cli(folder, options);
    CAPTURE(result.err);
    REQUIRE(result.status == 0);
    return read_curve(folder / "out.json");
}

TEST_CASE("curve: all formats are written and read back the same") {
    const TemporaryFolder folder;
    write_mesh(folder / "capsule.off", capsule(0.2, 2));
    const auto expected = curve_by_cli(folder.path(), "capsule.off", {});
    REQUIRE(expected.nodes.rows() > 10);
    for (const std::string name : {"c.obj", "c.ply", "c.swc", "c.json"}) {
        CAPTURE(name);
        const CliResult result = run_cli(folder.path(), {"curve", "capsule.off", "-o", name});
        CHECK(result.status == 0);
        CHECK(result.out.empty());
        CHECK(result.err.empty());
        const auto read = read_curve(folder / name);
        CHECK(read.nodes.rows() == expected.nodes.rows());
        CHECK(read.edges.size() == expected.edges.size());
        CHECK(read.radii.size() == expected.radii.size());
        if (name == "c.swc") continue; // may be in another order
        CHECK(read.nodes == expected.nodes);
        CHECK(read.edges == expected.edges);
        CHECK(read.radii == expected.radii);
    }
    const CliResult to_stdout = run_cli(folder.path(), {"curve", "capsule.off", "-o", "-"});
    CHECK(to_stdout.status == 0);
    CHECK(to_stdout.out == test::read_file(folder / "c.json"));
}

TEST_CASE("curve: twice the spacing gives half the nodes") {
    const TemporaryFolder folder;
    const auto nodes_at = [&](const std::string& spacing) {
        return static_cast<double>(curve_by_cli(folder.path(), sample_body, {"--spacing", spacing}).nodes.rows());
    };
    const double usual = nodes_at("0.01"), coarse = nodes_at("0.02");
    CHECK(coarse > 0.8 * usual / 2);
    CHECK(coarse < 1.2 * usual / 2);
    CHECK(static_cast<double>(curve_by_cli(folder.path(), sample_body, {}).nodes.rows()) == usual);
}

TEST_CASE("curve: more detail keeps more ends") {
    const TemporaryFolder folder;
    const auto ends_at = [&](const std::string& detail) {
        return core::end_count(curve_by_cli(folder.path(), sample_body, {"--detail", detail}));
    };
    const int limbs = ends_at("limbs"), digits = ends_at("digits"), all = ends_at("all");
    CHECK(limbs == 5);
    CHECK(digits >= limbs);
    CHECK(all >= digits);
    CHECK(core::end_count(curve_by_cli(folder.path(), sample_body, {})) == limbs);
}

TEST_CASE("curve: each component has its curve, the largest first; a ball has its centre, with a warning") {
    const TemporaryFolder folder;
    const Mesh ball = sphere(0.3, 3);
    Mesh tube = capsule(0.2, 4);
    tube.vertices.col(0).array() += 3;
    write_mesh(folder / "two.off", side_by_side(ball, tube));
    const CliResult result = run_cli(folder.path(), {"curve", "two.off", "-o", "two.json"});
    CHECK(result.status == 0);
    CHECK(result.out.empty());
    CHECK(result.err.rfind(
              "skelgen: warning: two.off: component 2 of 2 is too compact for a curve: its centre is given", 0) == 0);
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    const auto curve = read_curve(folder / "two.json");
    const Eigen::Index nodes = curve.nodes.rows();
    REQUIRE(nodes > 10);
    CHECK(static_cast<Eigen::Index>(curve.edges.size()) == nodes - 2);
    CHECK(curve.nodes.row(nodes - 1).norm() < 0.05);                  // the ball's centre, last
    CHECK((curve.nodes.topRows(nodes - 1).col(0).array() > 2).all()); // the capsule's axis
    std::size_t vertices = 0;
    for (const auto& region : curve.regions) vertices += region.size();
    CHECK(vertices == static_cast<std::size_t>(ball.vertices.rows() + tube.vertices.rows()));
}

TEST_CASE("curve: options out of their range end with status 2, one line, and no output") {
    const TemporaryFolder folder;
    const auto options =
        GENERATE(as<std::vector<std::string>>(), std::vector<std::string>{"--detail", "fingers"},
                 std::vector<std::string>{"--detail", "Limbs"}, std::vector<std::string>{"--detail"},
                 std::vector<std::string>{"--spacing", "0"}, std::vector<std::string>{"--spacing", "-0.01"},
                 std::vector<std::string>{"--spacing", "0.0004"}, std::vector<std::string>{"--spacing", "1.1"},
                 std::vector<std::string>{"--spacing", "nan"}, std::vector<std::string>{"--spacing", "wide"});
    CAPTURE(options);
    std::vector<std::string> arguments{"curve", sample_body, "-o", "out.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const CliResult result = run_cli(folder.path(), arguments);
    CHECK(result.status == 2);
    CHECK(result.err.rfind("skelgen: error: ", 0) == 0);
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    CHECK(files_below(folder.path()).empty());
}

TEST_CASE("curve: a mesh of loose triangles ends with status 3, and no output") {
    const TemporaryFolder folder;
    std::ofstream(folder / "soup.off") << "OFF 12 4 0\n0 0 0\n0 1 0\n0 0 1\n1 0 0\n1 1 0\n1 0 1\n2 0 0\n2 1 0\n2 0 1\n"
                                          "3 0 0\n3 1 0\n3 0 1\n3 0 1 2\n3 3 4 5\n3 6 7 8\n3 9 10 11\n";
    const CliResult result = run_cli(folder.path(), {"curve", "soup.off", "-o", "out.json"});
    CHECK(result.status == 3);
    CHECK(result.err.rfind("skelgen: error: soup.off: the mesh has no component that encloses anything", 0) == 0);
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    CHECK(files_below(folder.path()) == std::vector<std::string>{"soup.off"});
}

TEST_CASE("curve: a name that no format has ends with status 2") {
    const TemporaryFolder folder;
    write_mesh(folder / "capsule.off", capsule(0.2, 2));
    const CliResult result = run_cli(folder.path(), {"curve", "capsule.off", "-o", "out.txt"});
    CHECK(result.status == 2);
    CHECK(result.err.rfind("skelgen: error: out.txt: ", 0) == 0);
    CHECK(files_below(folder.path()) == std::vector<std::string>{"capsule.off"});
}

TEST_CASE("curve: the help tells of the options and has examples") {
    const TemporaryFolder folder;
    const CliResult result = run_cli(folder.path(), {"curve", "--help"});
    CHECK(result.status == 0);
    for (const char* text : {"--spacing", "--detail", "limbs", "digits", "bounding box", "Example", "skelgen curve "}) {
        CAPTURE(text);
        CHECK(result.out.find(text) != std::string::npos);
    }
}

} // namespace
