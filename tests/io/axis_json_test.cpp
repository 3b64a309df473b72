#include <skelgen/io/axis_json.hpp>

#include <fstream>
#include <string>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>

#include "catch.hpp"
#include "temporary_folder.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;
using Catch::Matchers::Contains;

namespace {

CurveSkeleton<double> read_text(const std::string& text) {
    const TemporaryFolder folder;
    std::ofstream(folder / "truth.json") << text;
    return read_axis_truth(folder / "truth.json");
}

/// The message with which the text is refused; empty when it is not.
std::string refusal(const std::string& text) {
    try {
        (void)read_text(text);
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        return error.what();
    }
    return {};
}

std::string axis(const std::string& nodes, const std::string& edges, const std::string& radii) {
    return R"({"axis": {"nodes": )" + nodes + R"(, "edges": )" + edges + R"(, "radii": )" + radii + "}}";
}

} // namespace

TEST_CASE("an axis comes with its radii, its ends and its cycles", "[io][truth]") {
    const CurveSkeleton<double> truth = read_text(
        axis("[[0, 0, 0], [1, 0, 0], [1, 1, 0], [2, 0, 0.5]]", "[[0, 1], [1, 2], [2, 0], [3, 1]]", "[1, 2, 3, 4]"));
    CHECK(truth.nodes.rows() == 4);
    CHECK(truth.nodes(3, 2) == 0.5);
    CHECK(truth.edges == std::vector<std::array<int, 2>>{{0, 1}, {0, 2}, {1, 2}, {1, 3}});
    CHECK(truth.radii == std::vector<double>{1, 2, 3, 4});
    CHECK(core::end_count(truth) == 1);
    CHECK(core::cycle_count(truth) == 1);
}

TEST_CASE("what the truth of an axis lacks is named", "[io][truth]") {
    const std::string two = "[[0, 0, 0], [1, 0, 0]]";
    CHECK(refusal(axis(two, "[[0, 1]]", "[1, 1], \"regions\": 5")).empty()); // not a key that it knows
    CHECK(refusal(axis(two, "[[0, 1]]", "[1, 1]")).empty());
    CHECK_THAT(refusal(""), Contains("no valid JSON"));
    CHECK_THAT(refusal("[]"), Contains("\"axis\" is missing"));
    CHECK_THAT(refusal(R"({"axis": {}})"), Contains("lacks the list 'nodes'"));
    CHECK_THAT(refusal(R"({"axis": {"nodes": []}})"), Contains("lacks the list 'edges'"));
    CHECK_THAT(refusal(axis("[[0, 0]]", "[]", "[1]")), Contains("nodes[0]"));
    CHECK_THAT(refusal(axis(two, "[[0, 2]]", "[1, 1]")), Contains("edges[0]"));
    CHECK_THAT(refusal(axis(two, "[[0, 0.5]]", "[1, 1]")), Contains("edges[0]"));
    CHECK_THAT(refusal(axis(two, "[[-1, 0]]", "[1, 1]")), Contains("edges[0]"));
    CHECK_THAT(refusal(axis(two, "[[1, 1]]", "[1, 1]")), Contains("edges[0]"));
    CHECK_THAT(refusal(axis(two, "[[0, 1], [1, 0]]", "[1, 1]")), Contains("edges[1]") && Contains("is there already"));
    CHECK_THAT(refusal(axis(two, "[[0, 1]]", "[]")), Contains("lacks the list 'radii'"));
    CHECK_THAT(refusal(R"({"axis": {"nodes": [[0, 0, 0], [1, 0, 0]], "edges": [[0, 1]]}})"),
               Contains("lacks the list 'radii'"));
    CHECK_THAT(refusal(axis(two, "[[0, 1]]", "[1, -1]")), Contains("radii[1]"));
    CHECK_THAT(refusal(axis(two, "[[0, 1]]", "[1]")), Contains("not one radius for each node"));
    CHECK_THAT(refusal(axis(two, "[[0, 1]]", "[1, 0]")), Contains("radii[1]"));
    CHECK_THAT(refusal(axis(two, "[[0, 1]]", "[1, \"2\"]")), Contains("radii[1]"));
    CHECK_THAT(refusal(axis(two, "[]", "[1, 1]")), Contains("not connected"));
    CHECK_THAT(refusal(axis("[]", "[]", "[]")), Contains("no nodes"));
}
