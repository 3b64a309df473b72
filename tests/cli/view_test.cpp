#include <string>
#include <vector>

#include "catch.hpp"
#include "run_cli.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::test;

#if SKELGEN_WITH_VIEW

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST_CASE("view: a page that is whole in itself, with those that have no skeleton", "[cli][view]") {
    const TemporaryFolder folder;
    const CliResult alone = run_cli(folder.path(), {"view", sample_body, "-o", "body.html"});
    INFO(alone.err);
    REQUIRE(alone.status == 0);
    CHECK((alone.out + alone.err).empty());
    const std::string page = test::read_file(folder / "body.html");
    CHECK(page.rfind("<!doctype html>", 0) == 0);
    CHECK(count(page, "\"glb\":\"") == 1);
    CHECK(count(page, "\"name\":\"left_elbow\"") == 2); // once in the skeleton that the page saves
    REQUIRE(run_cli(folder.path(), {"extract", sample_body, "-o", "body.json"}).status == 0);
    REQUIRE(run_cli(folder.path(), {"view", sample_body, "--skeleton", "body.json", "-o", "given.html"}).status == 0);
    CHECK(count(test::read_file(folder / "given.html"), "\"sides_confidence\":1,") == 1); // for which its giver answers
    CHECK(count(page, "\"name\":\"left_index_2\"") == 1); // with digits, which the saved skeleton has none of
    REQUIRE(run_cli(folder.path(), {"view", sample_body, "--fingers", "off", "-o", "bare.html"}).status == 0);
    CHECK(count(test::read_file(folder / "bare.html"), "left_index_2") == 0);
    CHECK(run_cli(folder.path(), {"view", sample_body, "--toes", "-o", "toes.html"}).status == 0);
    CHECK(count(page, "<script") == count(page, "</script"));
    CHECK(count(page, "<script src") + count(page, "<link rel=\"stylesheet") + count(page, "@import") == 0);

    REQUIRE(run_cli(folder.path(), {"view", "--bvh", SKELGEN_DATA "/sample/walk.bvh", sample_body, "-o", "walk.html"})
                .status == 0);
    CHECK(test::read_file(folder / "walk.html").size() > page.size()); // by the motion

    test::write_file(folder / "cube.off", cube_off());
    const CliResult of_two = run_cli(folder.path(), {"view", sample_body, "cube.off", "--skeleton", "body.json"});
    CHECK(of_two.status == 2);
    CHECK(of_two.err.find("--skeleton: is of one mesh") != std::string::npos);
    const CliResult refused = run_cli(folder.path(), {"view", "cube.off"});
    CHECK(refused.status == 0);
    CHECK(refused.err.rfind("skelgen: warning: cube.off: no skeleton: ", 0) == 0);
    CHECK(count(refused.out, "\"failure\":\"no skeleton: ") == 1);

    test::write_file(folder / "torn.off", "OFF\n");
    const CliResult several = run_cli(folder.path(), {"view", "cube.off", "torn.off", "-o", "several.html", "-q"});
    CHECK(several.status == 5);
    CHECK(count(test::read_file(folder / "several.html"), "\"failure\":\"") == 2);
}

TEST_CASE("view: what cannot be done is one line and no page", "[cli][view]") {
    const TemporaryFolder folder;
    test::write_file(folder / "torn.off", "OFF\n");
    const std::vector<std::string> files = files_below(folder.path());
    const auto fails = [&](const std::vector<std::string>& arguments, int status) {
        const CliResult result = run_cli(folder.path(), arguments);
        CHECK(result.status == status);
        CHECK(result.err.rfind("skelgen: error: ", 0) == 0);
        CHECK(result.err.find('\n') == result.err.size() - 1);
        CHECK(files_below(folder.path()) == files);
    };
    fails({"view", "torn.off", "-o", "x.html"}, 3);
    fails({"view", "torn.off", "-o", "torn.off"}, 2);
    fails({"view", sample_body, "torn.off", "-o", "torn.off"}, 2);
    fails({"view", "-o", "x.html"}, 2);
    fails({"view", sample_body, "--bvh", "torn.off", "-o", "x.html"}, 3);
    fails({"view", sample_body, "--bvh", "torn.off", "-o", "torn.off"}, 2);
    fails({"view", sample_body, "-o", "no/such/folder/x.html"}, 2);
}

#else

TEST_CASE("view: a build without it says so", "[cli][view]") {
    const TemporaryFolder folder;
    const CliResult result = run_cli(folder.path(), {"view", sample_body, "-o", "x.html"});
    CHECK(result.status == 2);
    CHECK(result.err.find("not in this build of skelgen; build it with SKELGEN_BUILD_VIEW=ON") != std::string::npos);
    CHECK(files_below(folder.path()).empty());
}

#endif

} // namespace
