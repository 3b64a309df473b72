#include "catch.hpp"

#include <sys/wait.h>

#include <fstream>
#include <iterator>

#include <skelgen/io/coloured_ply.hpp>
#include <skelgen/io/curve_formats.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "scenes.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;
using namespace skelgen;
using namespace skelgen::render;
using namespace skelgen::test;

namespace {

std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

struct CommandResult {
    int status;
    std::string messages;
};

/// Runs `skelgen render ARGUMENTS` in `folder`, as typed into a shell.
CommandResult run_render(const std::string& arguments, const fs::path& folder) {
    const std::string line = "cd '" + folder.string() + "' && '" SKELGEN_CLI "' render " + arguments + " 2> messages";
    const int status = std::system(line.c_str());
    return {WEXITSTATUS(status), content(folder / "messages")};
}

std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

} // namespace

TEST_CASE("skelgen render draws what has no skeleton, and says so") {
    const TemporaryFolder folder;
    write_mesh(folder / "ball.off", sphere(12));
    const CommandResult outcome = run_render("ball.off -o ball.png --size 100x120", folder.path());
    CHECK(outcome.status == 0);
    CHECK(outcome.messages.rfind("skelgen: warning: ball.off: no skeleton: ", 0) == 0);
    CHECK(content(folder / "ball.png").substr(0, 8) == "\x89PNG\r\n\x1a\n");

    REQUIRE(run_render("ball.off --size 100x120 > piped.png", folder.path()).status == 0);
    CHECK(content(folder / "piped.png") == content(folder / "ball.png"));

    REQUIRE(run_render("ball.off -o ball.svg --background transparent --view 1,2,3", folder.path()).status == 0);
    CHECK(content(folder / "ball.svg").rfind("<svg ", 0) == 0);
}

TEST_CASE("skelgen render shows the colours that a PLY's vertices have") {
    const TemporaryFolder folder;
    const TriangleMesh<double> ball = sphere(12);
    write_mesh(folder / "ball.ply", ball);
    const auto pixel_of = [&](const std::string& mesh) {
        REQUIRE(run_render(mesh + " -o ball.png --size 100x120", folder.path()).status == 0);
        return content(folder / "ball.png");
    };
    const auto painted = [&](const io::ByteColour& colour) {
        io::MeshColours colours;
        colours.vertices.assign(static_cast<std::size_t>(ball.vertices.rows()), colour);
        io::write_coloured_ply(folder / "painted.ply", ball, colours);
        return pixel_of("painted.ply");
    };
    const std::string plain = pixel_of("ball.ply"), red = painted({250, 20, 20}), blue = painted({20, 20, 250});
    CHECK(red != plain);
    CHECK(blue != plain);
    CHECK(red != blue);
    CHECK(painted({250, 20, 20}) == red);
}

TEST_CASE("skelgen render shows a skeleton file and a truth file instead of extracting") {
    const TemporaryFolder folder;
    write_mesh(folder / "ball.off", sphere(12));
    std::ofstream(folder / "ball.json") << R"({"format": "skelgen-skeleton", "version": 1, "template": "t", "joints": [
               {"name": "root", "parent": null, "position": [0, 0, 0], "radius": 1},
               {"name": "left_hand", "parent": "root", "position": [0.5, 0, 0], "radius": 1}],
               "end_points": {}, "frame": {"origin": [0, 0, 0], "left": [1, 0, 0], "forward": [0, 0, 1], "up": [0, 1, 0]},
               "quality": {"sides_confidence": 1, "matched_nodes": 2, "warnings": []}})";
    std::ofstream(folder / "truth.json") << R"({"joints": {"left_hand": [0.4, 0, 0]}})";
    const CommandResult outcome =
        run_render("ball.off -o ball.svg --skeleton ball.json --truth truth.json --names", folder.path());
    CHECK(outcome.status == 0);
    CHECK(outcome.messages.empty());
    CHECK(content(folder / "ball.svg").find(">left_hand</text>") != std::string::npos);
}

TEST_CASE("skelgen render shows a curve file of any format, alone or in a folder") {
    const TemporaryFolder folder;
    write_mesh(folder / "ball.off", sphere(12));
    CurveSkeleton<double> curve;
    curve.nodes.resize(3, 3);
    curve.nodes << -0.5, 0, 0, 0, 0.25, 0, 0.5, 0, 0;
    curve.edges = {{0, 1}, {1, 2}};
    fs::create_directory(folder / "curves");
    REQUIRE(run_render("ball.off -o bare.svg", folder.path()).status == 0);
    for (const std::string extension : {"json", "obj", "ply", "swc"}) {
        CAPTURE(extension);
        write_curve(folder / ("c." + extension), curve);
        REQUIRE(run_render("ball.off --curve c." + extension + " -o " + extension + ".svg", folder.path()).status == 0);
        CHECK(content(folder / (extension + ".svg")) == content(folder / "json.svg"));
        CHECK(content(folder / (extension + ".svg")) != content(folder / "bare.svg"));

        const fs::path in_folder = folder / ("curves/ball." + extension);
        fs::copy_file(folder / ("c." + extension), in_folder);
        REQUIRE(run_render("ball.off --curve curves -o found.svg", folder.path()).status == 0);
        CHECK(content(folder / "found.svg") == content(folder / "json.svg"));
        fs::remove(in_folder);
    }
    std::ofstream(folder / "bad.swc") << "1 0 0 0 0 1 7\n";
    const CommandResult outcome = run_render("ball.off --curve bad.swc -o bad.svg", folder.path());
    CHECK(outcome.status == 3);
    CHECK(outcome.messages.rfind("skelgen: error: bad.swc: line 1: ", 0) == 0);
    CHECK_FALSE(fs::exists(folder / "bad.svg"));
}

TEST_CASE("skelgen render shows the curve of a body that has no file in the folder of skeletons") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "scans");
    fs::create_directories(folder / "found");
    fs::copy_file(SKELGEN_DATA "/sample/body.off", folder / "scans/body.off");
    const CommandResult outcome = run_render("scans -o sheet.svg --skeleton found", folder.path());
    CHECK(outcome.status == 0);
    CHECK(outcome.messages == "skelgen: warning: scans/body.off: no skeleton: there is no file found/body.json\n");
    // The picture has all the lines of a body's curve, and not the single one of another.
    CurveSkeleton<double> line;
    line.nodes.resize(2, 3);
    line.nodes << 0, 0, 1, 0, 0, 1.1;
    line.edges = {{0, 1}};
    write_curve(folder / "line.json", line);
    REQUIRE(run_render("scans/body.off -o one.svg --skeleton found", folder.path()).status == 0);
    REQUIRE(run_render("scans/body.off -o bare.svg --skeleton found --curve line.json", folder.path()).status == 0);
    CHECK(content(folder / "one.svg").size() > content(folder / "bare.svg").size());
}

TEST_CASE("skelgen render makes a contact sheet in which a bad file costs its own cell") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "scans");
    write_mesh(folder / "scans/ball.off", sphere(12));
    std::ofstream(folder / "scans/broken.off") << "nothing of the kind";
    const CommandResult outcome = run_render("scans -o sheet.svg --size 100x120 --columns 2", folder.path());
    CHECK(outcome.status == 5);
    CHECK(outcome.messages.find("skelgen: error: scans/broken.off: ") != std::string::npos);
    const std::string sheet = content(folder / "sheet.svg");
    CHECK(sheet.find("width=\"200\" height=\"120\"") != std::string::npos);
    CHECK(sheet.find(">ball.off</text>") != std::string::npos);
    CHECK(sheet.find(">broken.off</text>") != std::string::npos);
}

TEST_CASE("skelgen render refuses what makes no sense and leaves nothing behind") {
    const TemporaryFolder folder;
    write_mesh(folder / "ball.off", sphere(12));
    std::ofstream(folder / "broken.off") << "nothing of the kind";
    CHECK(run_render("broken.off -o a.png", folder.path()).status == 3);
    CHECK(run_render("absent.off -o a.png", folder.path()).status == 3);
    CHECK(run_render("ball.off -o a.jpg", folder.path()).status == 2);
    CHECK(run_render("ball.off -o a.png --size 100", folder.path()).status == 2);
    CHECK(run_render("ball.off -o a.png --size 4x4", folder.path()).status == 2);
    CHECK(run_render("ball.off -o a.png --view above", folder.path()).status == 2);
    CHECK(run_render("ball.off -o a.png --background pink", folder.path()).status == 2);
    CHECK(run_render("ball.off -o a.png --skeleton absent.json", folder.path()).status == 3);
    CHECK(run_render("ball.off -o a.png --truth ball.off", folder.path()).status == 3);
    CHECK(run_render("ball.off broken.off -o a.png --skeleton ball.off", folder.path()).status == 2);
    CHECK(run_render("ball.off -o absent/a.png", folder.path()).status == 2);
    CHECK(files_in(folder.path()) == 3); // the two meshes and `messages`
}
