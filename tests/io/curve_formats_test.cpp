#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/io/curve_formats.hpp>

#include "catch.hpp"
#include "io/same_curve.hpp"
#include "temporary_folder.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;
using Catch::Matchers::Contains;

namespace {

/// A triangle of nodes 0, 1, 3 with a tail to 2, and the separate edge 4-5.
CurveSkeleton<double> curve() {
    CurveSkeleton<double> result;
    result.nodes.resize(6, 3);
    result.nodes << 0, 0, 0, 1, 0.1, 0, 2, 0, -1e-7, 1, 1, 0, 5, 5, 5, 6, 5, 1.0 / 3;
    result.edges = {{0, 1}, {0, 3}, {1, 2}, {1, 3}, {4, 5}};
    result.radii = {0.5, 0.25, 0, 0.1, 1, 2};
    result.regions = {{0, 4}, {1}, {}, {2, 3}, {5}, {6}};
    return result;
}

CurveSkeleton<double> without_regions(CurveSkeleton<double> from) {
    from.regions.clear();
    return from;
}

template <typename Work>
std::string error_of(ErrorCode code, const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        CHECK(error.code() == code);
        return error.what();
    }
    return "no error";
}

std::string reading_error(const std::string& text) {
    return error_of(ErrorCode::bad_input, [&] { static_cast<void>(curve_from_json(text)); });
}

std::string writing_error(const CurveSkeleton<double>& bad) {
    const std::string error = error_of(ErrorCode::usage, [&] { static_cast<void>(curve_to_json(bad)); });
    CHECK(error_of(ErrorCode::usage, [&] { static_cast<void>(curve_to_obj(bad)); }) == error);
    CHECK(error_of(ErrorCode::usage, [&] { static_cast<void>(curve_to_ply(bad)); }) == error);
    CHECK(error_of(ErrorCode::usage, [&] { static_cast<void>(curve_to_swc(bad)); }) == error);
    return error;
}

} // namespace

TEST_CASE("curve JSON: gives everything back", "[io][curve]") {
    check_same(curve_from_json(curve_to_json(curve())), curve());
    CurveSkeleton<double> bare = curve();
    bare.radii.clear();
    bare.regions.clear();
    check_same(curve_from_json(curve_to_json(bare)), bare);
    CHECK_THAT(curve_to_json(bare), !Contains("radii") && !Contains("regions"));

    CurveSkeleton<float> single;
    single.nodes.resize(1, 3);
    single.nodes << 0.1F, 1e-45F, 3.4028235e38F;
    CHECK_THAT(curve_to_json(single), Contains("[0.1, 1e-45, 3.4028235e+38]"));
    CHECK(curve_from_json<float>(curve_to_json(single)).nodes == single.nodes);
}

TEST_CASE("curve JSON: has the documented members", "[io][curve]") {
    const auto document = nlohmann::json::parse(curve_to_json(curve()));
    CHECK(document["format"] == "skelgen-curve");
    CHECK(document["version"] == 1);
    CHECK(document["nodes"][1] == nlohmann::json::array({1, 0.1, 0}));
    CHECK(document["edges"][4] == nlohmann::json::array({4, 5}));
    CHECK(document["radii"].size() == 6);
    CHECK(document["regions"][2].empty());
    CHECK(document.size() == 6);
}

TEST_CASE("curve JSON: what is wrong is named", "[io][curve]") {
    const auto document = [](const std::string& rest) {
        return reading_error(R"({"format": "skelgen-curve", "version": 1)" + rest + "}");
    };
    CHECK(document(R"(, "nodes": [[0, 0, 0]], "edges": [], "more": 1)") == "no error");
    CHECK_THAT(reading_error("{"), Contains("no valid JSON"));
    CHECK_THAT(reading_error(""), Contains("no valid JSON"));
    CHECK_THAT(reading_error("[]"), Contains("\"format\""));
    CHECK_THAT(reading_error(R"({"format": "skelgen-skeleton", "version": 1})"), Contains("\"format\""));
    CHECK_THAT(reading_error(R"({"format": "skelgen-curve", "version": 2})"), Contains("\"version\""));
    CHECK_THAT(document(""), Contains("'nodes'"));
    CHECK_THAT(document(R"(, "nodes": [])"), Contains("'edges'"));
    CHECK_THAT(document(R"(, "nodes": [], "edges": [])"), Contains("no nodes"));
    CHECK_THAT(document(R"(, "nodes": [[0, 0, 0], [1, 0]], "edges": [])"), Contains("nodes[1]"));
    CHECK_THAT(document(R"(, "nodes": [[0, 0, 1e999]], "edges": [])"), Contains("no valid JSON"));
    const std::string two = R"(, "nodes": [[0, 0, 0], [1, 0, 0]], "edges": )";
    CHECK(document(two + "[[1, 0]]") == "no error");
    CHECK_THAT(document(two + "[[0, 1], [1, 0]]"), Contains("edges[1]") && Contains("is there already"));
    CHECK_THAT(document(two + "[[1, 1]]"), Contains("edges[0]") && Contains("to itself"));
    CHECK_THAT(document(two + "[[0, 1, 1]]"), Contains("edges[0]: an edge is no list of 2"));
    CHECK_THAT(document(two + R"([], "radii": [1, -2])"), Contains("radii[1]") && Contains("negative"));
    CHECK_THAT(document(R"(, "nodes": [[0, 0]], "edges": [])"), Contains("a node is no list of 3"));
    CHECK_THAT(document(R"(, "nodes": [[0, 0, "0"]], "edges": [])"), Contains("no number"));
    CHECK_THAT(document(R"(, "nodes": [[0, 0, null]], "edges": [])"), Contains("no number"));
    CHECK_THAT(document(R"(, "nodes": [[0, 0, 0]], "edges": [[0, 1]])"), Contains("an edge names a node"));
    CHECK_THAT(document(R"(, "nodes": [[0, 0, 0]], "edges": [[0, -1]])"), Contains("negative"));
    CHECK_THAT(document(R"(, "nodes": [[0, 0, 0]], "edges": [[0, 18446744073709551615]])"), Contains("too large"));
    CHECK_THAT(document(R"(, "nodes": [[0, 0, 0]], "edges": [[0, 0.5]])"), Contains("no whole number"));
    CHECK_THAT(document(R"(, "nodes": [[0, 0, 0]], "edges": [], "radii": [])"), Contains("no error"));
    CHECK_THAT(document(R"(, "nodes": [[0, 0, 0]], "edges": [], "radii": [1, 2])"), Contains("one radius"));
    CHECK_THAT(document(R"(, "nodes": [[0, 0, 0]], "edges": [], "radii": [-1])"), Contains("a radius is negative"));
    CHECK_THAT(document(R"(, "nodes": [[0, 0, 0]], "edges": [], "regions": [[], []])"), Contains("one region"));
    CHECK_THAT(document(R"(, "nodes": [[0, 0, 0]], "edges": [], "regions": [0])"), Contains("a region is no list"));
}

TEST_CASE("curve OBJ: nodes with their radii, and lines", "[io][curve]") {
    CHECK(curve_to_obj(curve()) == "# skelgen curve skeleton\n"
                                   "v 0 0 0\n# radius 0.5\nv 1 0.1 0\n# radius 0.25\nv 2 0 -1e-07\n# radius 0\n"
                                   "v 1 1 0\n# radius 0.1\nv 5 5 5\n# radius 1\n"
                                   "v 6 5 0.3333333333333333\n# radius 2\n"
                                   "l 1 2\nl 1 4\nl 2 3\nl 2 4\nl 5 6\n");
    CurveSkeleton<double> bare = curve();
    bare.radii.clear();
    CHECK_THAT(curve_to_obj(bare), !Contains("radius") && Contains("v 5 5 5\nv 6 5"));
}

TEST_CASE("curve PLY: vertices and edges", "[io][curve]") {
    const std::string text = curve_to_ply(curve());
    CHECK_THAT(text, Catch::Matchers::StartsWith("ply\nformat ascii 1.0\n"));
    CHECK_THAT(text, Contains("element vertex 6\nproperty double x\nproperty double y\nproperty double z\n"
                              "property double radius\nelement edge 5\nproperty int vertex1\nproperty int vertex2\n"
                              "end_header\n0 0 0 0.5\n1 0.1 0 0.25\n"));
    CHECK_THAT(text, Catch::Matchers::EndsWith("6 5 0.3333333333333333 2\n0 1\n0 3\n1 2\n1 3\n4 5\n"));
    CurveSkeleton<double> bare = curve();
    bare.radii.clear();
    CHECK_THAT(curve_to_ply(bare), !Contains("radius") && Contains("end_header\n0 0 0\n1 0.1 0\n"));
}

TEST_CASE("curve SWC: trees with parents first, what they cannot hold in comments", "[io][curve]") {
    CHECK(curve_to_swc(curve()) == "# skelgen curve skeleton, in the unit of the mesh\n"
                                   "# left out, as it closes a cycle: the edge between 2 4\n"
                                   "# radius 0, a placeholder in its column: node 3\n"
                                   "# id type x y z radius parent\n"
                                   "1 0 0 0 0 0.5 -1\n"
                                   "2 0 1 0.1 0 0.25 1\n"
                                   "3 0 2 0 -1e-07 0.006 2\n"
                                   "4 0 1 1 0 0.1 1\n"
                                   "5 0 5 5 5 1 -1\n"
                                   "6 0 6 5 0.3333333333333333 2 5\n");
    CurveSkeleton<double> bare = curve();
    bare.radii.clear();
    CHECK_THAT(curve_to_swc(bare), Contains("\n# radii unknown, a placeholder in their column\n") &&
                                       Contains("\n6 0 6 5 0.3333333333333333 0.006 5\n") && !Contains("# radius 0"));
}

TEST_CASE("curve SWC: a long chain, numbered against its direction", "[io][curve]") {
    CurveSkeleton<double> chain;
    constexpr int n = 1000;
    chain.nodes = Points<double>::Zero(n, 3);
    for (int i = 0; i + 1 < n; ++i) chain.edges.push_back({n - 2 - i, n - 1 - i});
    std::istringstream lines(curve_to_swc(chain));
    std::string line;
    int expected = 0;
    while (std::getline(lines, line)) {
        if (line[0] == '#') continue;
        int id = 0, type = 0, parent = 0;
        double x = 0, y = 0, z = 0, radius = 0;
        std::istringstream(line) >> id >> type >> x >> y >> z >> radius >> parent;
        CHECK(id == ++expected);
        CHECK(parent == (id == 1 ? -1 : id - 1));
    }
    CHECK(expected == n);
}

TEST_CASE("write_curve and read_curve: the extension chooses", "[io][curve]") {
    const TemporaryFolder folder;
    for (const char* name : {"c.json", "c.obj", "c.ply", "c.swc"}) write_curve(folder / name, curve());
    check_same(read_curve(folder / "c.json"), curve());
    for (const char* name : {"c.obj", "c.ply", "c.swc"})
        check_same(read_curve(folder / name), without_regions(curve()));
    for (const std::string_view extension : curve_extensions()) {
        INFO(extension);
        CHECK(std::filesystem::exists(folder / ("c" + std::string(extension))));
    }
    write_curve(folder / "upper.SWC", curve());
    CHECK(std::filesystem::file_size(folder / "upper.SWC") == curve_to_swc(curve()).size());
    check_same(read_curve(folder / "upper.SWC"), without_regions(curve()));
    std::ofstream(folder / "marked.swc") << "\xEF\xBB\xBF" << curve_to_swc(curve());
    check_same(read_curve(folder / "marked.swc"), without_regions(curve()));
    CHECK(std::filesystem::file_size(folder / "c.obj") == curve_to_obj(curve()).size());
    CHECK(std::filesystem::file_size(folder / "c.ply") == curve_to_ply(curve()).size());
    CHECK(std::filesystem::file_size(folder / "c.swc") == curve_to_swc(curve()).size());
    CHECK_THAT(error_of(ErrorCode::usage, [&] { write_curve(folder / "c.txt", curve()); }), Contains(".swc"));
    CHECK_THAT(error_of(ErrorCode::bad_input, [&] { static_cast<void>(read_curve(folder / "none.json")); }),
               Contains("No such file"));
    std::filesystem::copy_file(folder / "c.json", folder / "c.txt");
    CHECK_THAT(error_of(ErrorCode::bad_input, [&] { static_cast<void>(read_curve(folder / "c.txt")); }),
               Contains(".swc"));
    std::filesystem::copy_file(folder / "c.obj", folder / "no.json");
    CHECK_THAT(error_of(ErrorCode::bad_input, [&] { static_cast<void>(read_curve(folder / "no.json")); }),
               Contains("JSON"));
}

TEST_CASE("curve formats: unsound curves are refused", "[io][curve]") {
    CurveSkeleton<double> bad = curve();
    bad.nodes(2, 1) = std::numeric_limits<double>::infinity();
    CHECK_THAT(writing_error(bad), Contains("infinite"));
    bad = curve();
    bad.edges[0][1] = 6;
    CHECK_THAT(writing_error(bad), Contains("an edge names a node"));
    bad = curve();
    bad.radii.pop_back();
    CHECK_THAT(writing_error(bad), Contains("one radius"));
    bad = curve();
    bad.regions.pop_back();
    CHECK_THAT(writing_error(bad), Contains("one region"));
    bad = curve();
    bad.radii[0] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THAT(writing_error(bad), Contains("radius"));
    bad = curve();
    bad.edges.push_back({3, 1});
    CHECK_THAT(writing_error(bad), Contains("an edge is there twice"));
    bad = curve();
    bad.edges.push_back({3, 3});
    CHECK_THAT(writing_error(bad), Contains("to itself"));
    CHECK_THAT(writing_error(CurveSkeleton<double>()), Contains("no nodes"));
}
