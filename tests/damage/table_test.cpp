#include "damage/table.hpp"

#include <skelgen/core/error.hpp>
#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/skeleton_json.hpp>
#include <skelgen/io/truth_json.hpp>

#include "catch.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace skelgen;
namespace fs = std::filesystem;

/// A skeleton file with the sample's true joints, all of them moved.
void write_result(const fs::path& file, const Vector3<double>& shift, double sides_confidence) {
    KinematicSkeleton<double> skeleton;
    skeleton.template_name = "human21";
    for (const auto& [name, position] : io::read_ground_truth(SKELGEN_DATA "/sample/body.json").joints)
        skeleton.joints.push_back({name, -1, position + shift, 0.1, 1.0});
    skeleton.quality.sides_confidence = sides_confidence;
    fs::create_directories(file.parent_path());
    write_skeleton(file, skeleton);
}

std::string line(const std::string& file, const std::string& status, const std::string& error, double seconds) {
    return R"({"file":")" + file + R"(","status":")" + status + R"(","error":)" +
           (error.empty() ? "null" : "\"" + error + "\"") + R"(,"seconds":)" + std::to_string(seconds) + "}\n";
}

const damage::Row& row(const std::vector<damage::Row>& rows, const std::string& kind) {
    for (const damage::Row& each : rows)
        if (each.kind == kind) return each;
    throw Error(ErrorCode::internal, "no row " + kind);
}

TEST_CASE("the table says how many are solved, how well, how slowly, and which are wrong and sure") {
    const test::TemporaryFolder folder;
    const fs::path truth = folder / "truth", out = folder / "out";
    fs::create_directories(truth / "set");
    fs::copy_file(SKELGEN_DATA "/sample/body.json", truth / "set/a.json");
    fs::copy_file(SKELGEN_DATA "/sample/body.json", truth / "set/b.json");
    const double scale = io::read_ground_truth(truth / "set/a.json").scale;
    write_result(out / "clean/set/a.json", {0, 0, 0.01 * scale}, 1);
    write_result(out / "skeletons/fins/set/a.json", {0, 0, 0.02 * scale}, 1);
    write_result(out / "skeletons/fins/set/b.json", {scale, 0, 0}, 0.9); // far off, and sure
    write_result(out / "skeletons/mirrored/set/a.json", {0, 0, 0}, 0.5); // not mirrored: the sides are wrong
    io::write_file_atomically(out / "clean/summary.jsonl", line("set/a.off", "ok", "", 0.5));
    io::write_file_atomically(out / "skeletons/summary.jsonl",
                              line("fins/set/a.off", "ok", "", 0.5) + line("fins/set/b.off", "ok", "", 2) +
                                  line("mirrored/set/a.off", "ok", "", 1) +
                                  line("holes/set/a.off", "timeout", "took longer than 60 s", 60) +
                                  line("two-bodies/set/a.off", "no_skeleton", "there are 2 bodies", 1) +
                                  line("two-bodies/set/b.off", "no_skeleton", "it has 2 ends", 1) +
                                  line("fan/set/a.off", "bad_input", "no surface", 0) +
                                  line("fan/set/b.off", "timeout", "took longer than 60 s", 60));

    const std::vector<damage::Row> rows = damage::score(truth, out);
    REQUIRE(rows.size() == 6);
    CHECK(rows.front().kind == "clean");
    CHECK(rows.front().solved == 1);
    CHECK(rows.front().mean_error == Approx(0.01));
    CHECK(row(rows, "fins").meshes == 2);
    CHECK(row(rows, "fins").solved == 1);
    CHECK(row(rows, "fins").mean_error == Approx(0.02));
    CHECK(row(rows, "fins").wrong_sure == 1);
    CHECK(row(rows, "fins").worst_seconds == 2);
    CHECK(row(rows, "fins").slowest == "fins/set/b.off");
    CHECK(row(rows, "mirrored").solved == 0);
    CHECK(row(rows, "mirrored").wrong_sure == 0);
    CHECK(row(rows, "holes").failed == std::vector<std::string>{"holes/set/a.off: took longer than 60 s"});
    CHECK(row(rows, "two-bodies").solved == 1);
    CHECK(row(rows, "fan").solved == 1);
    CHECK(row(rows, "fan").failed == std::vector<std::string>{"fan/set/b.off: took longer than 60 s"});

    const std::string table = damage::to_table(rows);
    CHECK(table.find("\nfins                2       1      0.0200      2.00            1      2.00 s") !=
          std::string::npos);
}

TEST_CASE("a summary that is none, and a missing truth, are refused by name") {
    const test::TemporaryFolder folder;
    fs::create_directories(folder / "clean");
    io::write_file_atomically(folder / "clean/summary.jsonl", "hello\n");
    CHECK_THROWS_WITH(damage::score(folder.path(), folder.path()), Catch::Contains("clean/summary.jsonl"));
    io::write_file_atomically(folder / "clean/summary.jsonl", line("a.off", "ok", "", 1));
    CHECK_THROWS_WITH(damage::score(folder.path(), folder.path()), Catch::Contains("a.json: cannot be opened"));
}

} // namespace
