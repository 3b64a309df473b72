#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/io/curve_formats.hpp>

#include "catch.hpp"
#include "io/same_curve.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;
using Catch::Matchers::Contains;

namespace {

// ---- curves ----

template <typename Scalar>
CurveSkeleton<Scalar> curve_of(int nodes, std::vector<std::array<int, 2>> edges) {
    CurveSkeleton<Scalar> curve;
    curve.nodes.resize(nodes, 3);
    std::mt19937 random(7);
    std::uniform_real_distribution<Scalar> coordinate(-1, 1);
    for (Eigen::Index i = 0; i < curve.nodes.size(); ++i) curve.nodes.data()[i] = coordinate(random);
    for (int i = 0; i < nodes; ++i) curve.radii.push_back(std::abs(coordinate(random)));
    curve.edges = std::move(edges);
    return curve;
}

template <typename Scalar>
struct Named {
    std::string name;
    CurveSkeleton<Scalar> curve;
    bool keeps_order; ///< in SWC too
};

template <typename Scalar>
std::vector<Named<Scalar>> curves() {
    const auto limit = std::numeric_limits<Scalar>();
    std::vector<Named<Scalar>> all{
        {"tree", curve_of<Scalar>(7, {{0, 1}, {0, 4}, {1, 2}, {1, 3}, {4, 5}, {4, 6}}), true},
        {"tree numbered against its direction", curve_of<Scalar>(5, {{0, 4}, {1, 4}, {1, 2}, {2, 3}}), false},
        {"loop", curve_of<Scalar>(5, {{0, 1}, {0, 4}, {1, 2}, {2, 3}, {3, 4}}), true},
        {"loop out of order", curve_of<Scalar>(5, {{0, 3}, {1, 3}, {1, 4}, {2, 4}, {0, 2}}), false},
        {"every two of five",
         curve_of<Scalar>(5, {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 2}, {1, 3}, {1, 4}, {2, 3}, {2, 4}, {3, 4}}), true},
        {"two components, mixed", curve_of<Scalar>(6, {{0, 2}, {1, 3}, {2, 4}, {3, 5}}), true},
        {"two components, one of them a loop", curve_of<Scalar>(6, {{0, 1}, {2, 3}, {2, 5}, {3, 4}, {4, 5}}), true},
        {"single node", curve_of<Scalar>(1, {}), true},
        {"nodes without edges", curve_of<Scalar>(3, {}), true},
        {"radii of 0", curve_of<Scalar>(3, {{0, 1}, {1, 2}}), true},
        {"single node of radius 0", curve_of<Scalar>(1, {}), true},
        {"numbers at their limits", curve_of<Scalar>(3, {{0, 1}, {1, 2}}), true},
        {"no radii", curve_of<Scalar>(3, {{0, 1}, {1, 2}}), true},
    };
    all[9].curve.radii = {0, Scalar(0.5), 0};
    all[10].curve.radii = {0};
    all[11].curve.nodes << limit.max(), limit.lowest(), limit.min(), limit.denorm_min(), -limit.denorm_min(),
        Scalar(-0.0), Scalar(1) / 3, limit.epsilon(), Scalar(123456789);
    all[11].curve.radii = {limit.max(), limit.denorm_min(), limit.min()};
    all[12].curve.radii.clear();
    return all;
}

template <typename Scalar>
CurveSkeleton<Scalar> in_ascending_order(CurveSkeleton<Scalar> curve) {
    for (auto& edge : curve.edges) std::sort(edge.begin(), edge.end());
    std::sort(curve.edges.begin(), curve.edges.end());
    return curve;
}

/// `curve` with the nodes in the order of those of `other`, which are at the same places.
template <typename Scalar>
CurveSkeleton<Scalar> in_order_of(const CurveSkeleton<Scalar>& other, const CurveSkeleton<Scalar>& curve) {
    CurveSkeleton<Scalar> result = curve;
    for (Eigen::Index i = 0; i < curve.nodes.rows(); ++i) {
        Eigen::Index there = 0;
        while (there < other.nodes.rows() && other.nodes.row(there) != curve.nodes.row(i)) ++there;
        REQUIRE(there < other.nodes.rows());
        result.nodes.row(there) = curve.nodes.row(i);
        if (!curve.radii.empty())
            result.radii[static_cast<std::size_t>(there)] = curve.radii[static_cast<std::size_t>(i)];
        for (std::size_t e = 0; e < curve.edges.size(); ++e)
            for (const std::size_t end : {0, 1})
                if (curve.edges[e][end] == i) result.edges[e][end] = static_cast<int>(there);
    }
    return in_ascending_order(result);
}

// ---- errors ----

template <typename Parse>
std::string error_of(const Parse& parse, const std::string& text) {
    try {
        static_cast<void>(parse(text));
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        CHECK_THAT(error.what(), !Contains("mesh again"));
        return error.what();
    }
    return "no error";
}

std::string obj_error(const std::string& text) { return error_of(curve_from_obj<double>, text); }
std::string ply_error(const std::string& text) { return error_of(curve_from_ply<double>, text); }
std::string swc_error(const std::string& text) { return error_of(curve_from_swc<double>, text); }

/// PLY with these counts in the header, which ends with line 9.
std::string ply(const std::string& nodes, const std::string& edges, const std::string& rows) {
    return "ply\nformat ascii 1.0\nelement vertex " + nodes +
           "\nproperty double x\nproperty double y\nproperty double z\nproperty double radius\nelement edge " + edges +
           "\nproperty int vertex1\nproperty int vertex2\nend_header\n" + rows;
}

const std::string ply_nodes = "0 0 0 1\n1 0 0 1\n2 0 0 1\n";                    // lines 12 to 14
const std::string obj_nodes = "v 0 0 0\nv 1 0 0\nv 2 0 0\n";                    // lines 1 to 3
const std::string swc_nodes = "1 0 0 0 0 1 -1\n2 0 1 0 0 1 1\n3 0 2 0 0 1 2\n"; // lines 1 to 3

} // namespace

// ------------------------------------------------------------------------------------------------- round trips

TEMPLATE_TEST_CASE("every format reads back what it wrote, to the last bit", "[io][curve]", float, double) {
    using Scalar = TestType;
    for (const auto& [name, curve, keeps_order] : curves<Scalar>()) {
        INFO(name);
        const auto expected = in_ascending_order(curve);
        check_same(curve_from_json<Scalar>(curve_to_json(curve)), expected);
        check_same(curve_from_obj<Scalar>(curve_to_obj(curve)), expected);
        check_same(curve_from_ply<Scalar>(curve_to_ply(curve)), expected);
        const auto from_swc = curve_from_swc<Scalar>(curve_to_swc(curve));
        check_same(keeps_order ? from_swc : in_order_of(curve, from_swc), expected);
        // Once in the order of SWC, it stays so.
        check_same(curve_from_swc<Scalar>(curve_to_swc(from_swc)), from_swc);
    }
}

TEMPLATE_TEST_CASE("regions are kept by JSON alone", "[io][curve]", float, double) {
    using Scalar = TestType;
    auto curve = curve_of<Scalar>(3, {{0, 1}, {1, 2}});
    const auto bare = curve;
    curve.regions = {{4, 2}, {}, {0, 1, 3}};
    check_same(curve_from_json<Scalar>(curve_to_json(curve)), curve);
    check_same(curve_from_obj<Scalar>(curve_to_obj(curve)), bare);
    check_same(curve_from_ply<Scalar>(curve_to_ply(curve)), bare);
    check_same(curve_from_swc<Scalar>(curve_to_swc(curve)), bare);
}

TEMPLATE_TEST_CASE("numbers of any bits are read back", "[io][curve]", float, double) {
    using Scalar = TestType;
    using Bits = std::conditional_t<std::is_same_v<Scalar, float>, std::uint32_t, std::uint64_t>;
    std::mt19937_64 random(11);
    CurveSkeleton<Scalar> curve;
    curve.nodes.resize(2000, 3);
    for (Eigen::Index i = 0; i < curve.nodes.size(); ++i) {
        Scalar number = std::numeric_limits<Scalar>::infinity();
        while (!std::isfinite(number)) number = std::bit_cast<Scalar>(static_cast<Bits>(random()));
        curve.nodes.data()[i] = number;
    }
    curve.nodes(0, 0) = Scalar(7.038531e-26); // the one float that its text misses when it is rounded twice
    curve.nodes(0, 1) = -curve.nodes(0, 0);
    curve.nodes(0, 2) = Scalar(-0.0);
    check_same(curve_from_json<Scalar>(curve_to_json(curve)), curve);
    check_same(curve_from_obj<Scalar>(curve_to_obj(curve)), curve);
    check_same(curve_from_ply<Scalar>(curve_to_ply(curve)), curve);
    check_same(curve_from_swc<Scalar>(curve_to_swc(curve)), curve);
}

TEMPLATE_TEST_CASE("SWC's rules hold: one tree for each component, parents first, positive radii, a header",
                   "[io][curve]", float, double) {
    using Scalar = TestType;
    for (const auto& [name, curve, keeps_order] : curves<Scalar>()) {
        INFO(name);
        const std::string text = curve_to_swc(curve);
        CHECK_THAT(text,
                   Catch::Matchers::StartsWith("# ") && Contains("skelgen") && Contains("in the unit of the mesh"));
        std::istringstream lines(text);
        std::string line;
        int last = 0, roots = 0, left_out = 0;
        while (std::getline(lines, line)) {
            left_out += line.rfind("# left out, as it closes a cycle: the edge between ", 0) == 0 ? 1 : 0;
            if (line[0] == '#') continue;
            CHECK(last < static_cast<int>(curve.nodes.rows()));
            std::istringstream fields(line);
            std::vector<std::string> words;
            for (std::string word; fields >> word;) words.push_back(word);
            REQUIRE(words.size() == 7);
            CHECK(std::stoi(words[0]) == ++last);
            CHECK(words[1] == "0");
            CHECK(words[5][0] != '-');
            CHECK(words[5] != "0");
            const int parent = std::stoi(words[6]);
            roots += parent == -1 ? 1 : 0;
            CHECK((parent == -1 || (parent >= 1 && parent < last)));
        }
        CHECK(last == curve.nodes.rows());
        CHECK(roots == core::component_count(curve));
        CHECK(left_out == static_cast<int>(curve.edges.size()) - last + roots);
    }
}

// ------------------------------------------------------------------------------------------- what others write

TEST_CASE("curve OBJ: what other programs write is read", "[io][curve]") {
    const auto curve =
        curve_from_obj("# made by hand\r\no curve\r\nv 0 0 0 1.0\r\nv 1 0 0 0.5 0.5 0.5\r\nl 1 2 3 # a row\r\n"
                       "v 2 0 0\r\nvt 0 0\r\nl -1/1 1/1\r\n\r\n");
    CHECK(curve.nodes.rows() == 3);
    CHECK(curve.edges == std::vector<std::array<int, 2>>{{0, 1}, {0, 2}, {1, 2}});
    CHECK(curve.radii.empty());
    CHECK(curve_from_obj("v 0 0 0 # radius 2\nv 1 0 0 # radius 3").radii == std::vector<double>{2, 3});
}

TEST_CASE("curve PLY: what other programs write is read, binary too", "[io][curve]") {
    const std::string header = "element edge 1\nproperty uchar kind\nproperty int vertex2\nproperty int vertex1\n"
                               "element face 0\nproperty list uchar int vertex_indices\n"
                               "element vertex 2\nproperty float x\nproperty float z\nproperty float y\nend_header\n";
    const std::vector<std::array<int, 2>> edges{{0, 1}};
    const auto text = curve_from_ply("ply\nformat ascii 1.0\ncomment c\n" + header + "9 0 1\n1 3 2\n4 6 5\n");
    CHECK(text.edges == edges);
    Points<double> nodes(2, 3);
    nodes << 1, 2, 3, 4, 5, 6;
    CHECK(text.nodes == nodes);
    CHECK(text.radii.empty());

    std::string rows("\x09\0\0\0\0\0\0\0\x01", 9);
    for (const float number : {1.0F, 3.0F, 2.0F, 4.0F, 6.0F, 5.0F}) {
        const auto bits = std::bit_cast<std::uint32_t>(number);
        for (int shift = 24; shift >= 0; shift -= 8) rows += static_cast<char>(bits >> shift & 255U);
    }
    const std::string binary = "ply\nformat binary_big_endian 1.0\n" + header + rows;
    CHECK(curve_from_ply(binary).nodes == nodes);
    CHECK(curve_from_ply(binary).edges == edges);
    CHECK_THAT(ply_error(binary.substr(0, binary.size() - 1)),
               Contains("cannot hold") || (Contains("byte") && Contains("too early")));
}

TEST_CASE("curve SWC: what other programs write is read", "[io][curve]") {
    const auto curve = curve_from_swc("# ORIGINAL_SOURCE x\r\n\r\n 1 1 0 0 0 1.5 -1 # soma\r\n\t2 3 1 0 0 0 1\r\n"
                                      "3 3 2e0 +0 -0 .5 1\r\n");
    CHECK(curve.edges == std::vector<std::array<int, 2>>{{0, 1}, {0, 2}});
    CHECK(curve.radii == std::vector<double>{1.5, 0, 0.5});
    CHECK(curve.nodes(2, 0) == 2);
}

// ---------------------------------------------------------------------------------------------------- bad files

TEST_CASE("curve OBJ: what is wrong is named, with its line", "[io][curve]") {
    const auto after_nodes = [](const std::string& more) { return obj_error(obj_nodes + more); };
    CHECK(after_nodes("l 1 2\nl 2 3\n") == "no error");
    CHECK_THAT(obj_error(""), Contains("no nodes"));
    CHECK_THAT(obj_error("# nothing\n"), Contains("no nodes"));
    CHECK_THAT(obj_error("v 0 0 0\nv 1 0\n"), Contains("line 2") && Contains("z coordinate is missing"));
    CHECK_THAT(obj_error("v 0 0 0 0 0\n"), Contains("line 1") && Contains("weight"));
    CHECK_THAT(obj_error("v 0 0 0\nv 1 0 nan\n"), Contains("line 2") && Contains("no usable number: 'nan'"));
    CHECK_THAT(obj_error("v 0 0 inf\n"), Contains("'inf'"));
    CHECK_THAT(obj_error("v 0 0 1e999\n"), Contains("'1e999'"));
    CHECK_THAT(error_of(curve_from_obj<float>, "v 0 0 1e39\n"), Contains("'1e39'"));
    CHECK_THAT(obj_error("v 0 x 0\n"), Contains("'x'"));
    CHECK_THAT(after_nodes("l 1 2\nl 1 4\n"), Contains("line 5") && Contains("does not exist: 4"));
    CHECK_THAT(after_nodes("l 0 1\n"), Contains("line 4") && Contains("does not exist: 0"));
    CHECK_THAT(after_nodes("l 1 -4\n"), Contains("line 4") && Contains("does not exist"));
    CHECK_THAT(after_nodes("l 1 99999999999999999999\n"), Contains("line 4"));
    CHECK_THAT(after_nodes("l 1 999999999999999999\n"), Contains("line 4") && Contains("does not exist"));
    CHECK_THAT(after_nodes("l 1 2\nl 3 2\nl 2 1\n"), Contains("line 6") && Contains("is there already"));
    CHECK_THAT(after_nodes("l 1 2 1\n"), Contains("line 4") && Contains("is there already"));
    CHECK_THAT(after_nodes("l 2 2\n"), Contains("line 4") && Contains("to itself: 2"));
    CHECK_THAT(after_nodes("l 2\n"), Contains("line 4") && Contains("one node"));
    CHECK_THAT(after_nodes("l\n"), Contains("line 4") && Contains("missing"));
    CHECK_THAT(after_nodes("l 1 2.5\n"), Contains("line 4"));
    CHECK_THAT(after_nodes("f 1 2 3\n"), Contains("line 4") && Contains("this is a mesh"));
    CHECK_THAT(after_nodes("line 1 2\n"), Contains("line 4") && Contains("no word that OBJ knows"));
    CHECK_THAT(obj_error("v 0 0 0\n# radius -1\n"), Contains("line 2") && Contains("negative"));
    CHECK_THAT(obj_error("v 0 0 0\n# radius nan\n"), Contains("line 2") && Contains("'nan'"));
    CHECK_THAT(obj_error("v 0 0 0\n# radius \n"), Contains("line 2") && Contains("missing"));
    CHECK_THAT(obj_error("v 0 0 0\n# radius 1 2\n"), Contains("line 2") && Contains("more than a number"));
    CHECK_THAT(obj_error("# radius 1\nv 0 0 0\n"), Contains("line 1") && Contains("without a node"));
    CHECK_THAT(obj_error("v 0 0 0\n# radius 1\n# radius 1\n"), Contains("line 3"));
    CHECK_THAT(obj_error("v 0 0 0\n# radius 1\nv 0 0 0\nv 0 0 0\n"), Contains("line 4") && Contains("no radius"));
    CHECK_THAT(obj_error("v 0 0 0\n# radius 1\nv 0 0 0\n"), Contains("last node has no radius"));
    CHECK_THAT(obj_error("v 0 0 0\nv 0 0 0\n# radius 1\n"), Contains("line 3") && Contains("others have none"));
}

TEST_CASE("curve PLY: what is wrong is named, with its line", "[io][curve]") {
    const auto edges = [](const std::string& count, const std::string& rows) {
        return ply_error(ply("3", count, ply_nodes + rows));
    };
    CHECK(edges("2", "0 1\n1 2\n") == "no error");
    CHECK_THAT(ply_error(""), Contains("'ply' does not come first"));
    CHECK_THAT(ply_error("ply\nformat ascii 1.0\n"), Contains("end_header"));
    CHECK_THAT(ply_error(ply("0", "0", "")), Contains("no nodes"));
    CHECK_THAT(ply_error("ply\nformat ascii 1.0\nend_header\n"), Contains("no nodes"));
    CHECK_THAT(ply_error(ply("-1", "0", "")), Contains("line 3") && Contains("negative"));
    CHECK_THAT(ply_error(ply("2000000000", "0", ply_nodes)), Contains("a file of this size cannot hold"));
    CHECK_THAT(ply_error(ply("999999999999999999", "0", ply_nodes)), Contains("a file of this size cannot hold"));
    CHECK_THAT(edges("2000000000", "0 1\n"), Contains("a file of this size cannot hold"));
    CHECK_THAT(ply_error(ply("1", "0", "0 0 0  \n")), Contains("line 12") && Contains("missing"));
    CHECK_THAT(ply_error(ply("1", "0", "0 0 0 1 2\n")), Contains("line 12") && Contains("more values"));
    CHECK_THAT(ply_error(ply("1", "0", "0 0 nan 1\n")), Contains("line 12") && Contains("'nan'"));
    CHECK_THAT(ply_error(ply("1", "0", "0 0 1e999 1\n")), Contains("line 12") && Contains("'1e999'"));
    CHECK_THAT(ply_error(ply("2", "0", "0 0 0 0\n1 0 0 -1\n")), Contains("line 13") && Contains("negative"));
    CHECK_THAT(edges("1", "0 3\n"), Contains("line 15") && Contains("does not exist: 3"));
    CHECK_THAT(edges("1", "-1 0\n"), Contains("line 15") && Contains("does not exist: -1"));
    CHECK_THAT(edges("2", "0 1\n1 0\n"), Contains("line 16") && Contains("is there already"));
    CHECK_THAT(edges("1", "1 1\n"), Contains("line 15") && Contains("to itself: 1"));
    CHECK_THAT(edges("1", "0\n"), Contains("line 15") && Contains("missing"));
    CHECK_THAT(edges("1", "0 1.5\n"), Contains("line 15"));
    CHECK_THAT(edges("2", "0 1   \n"), Contains("too early"));
    CHECK_THAT(edges("1", "0 1\n1 2\n"), Contains("line 16") && Contains("more rows"));

    const std::string start = "ply\nformat ascii 1.0\n",
                      node = "property float x\nproperty float y\nproperty float z\n";
    CHECK_THAT(ply_error(start + "element vertex 1\nproperty float x\nend_header\n0\n"), Contains("property y"));
    CHECK_THAT(ply_error(start + "element vertex 1\nend_header\n0\n"), Contains("property x"));
    CHECK_THAT(ply_error(start + "element vertex 1\n" + node + "element edge 1\nend_header\n0 0 0\n0 0\n"),
               Contains("property vertex1"));
    CHECK_THAT(ply_error(start + "element vertex 1\n" + node +
                         "element edge 1\nproperty float vertex1\nproperty int vertex2\nend_header\n0 0 0\n0 0\n"),
               Contains("integer type"));
    CHECK_THAT(
        ply_error(start + "element vertex 1\n" + node + "element vertex 1\n" + node + "end_header\n0 0 0\n0 0 0\n"),
        Contains("two elements"));
    CHECK_THAT(ply_error(start + "element vertex 3\n" + node +
                         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n0 0 0\n0 0 0\n"
                         "3 0 1 2\n"),
               Contains("this is a mesh"));
    // The header's word for how many nodes there are is not enough to have them.
    CHECK_THAT(ply_error(start + "element edge 1\nproperty int vertex1\nproperty int vertex2\nelement vertex 9\n" +
                         node + "end_header\n0 8\n0 0 0\n"),
               Contains("cannot hold") || Contains("too early"));
}

TEST_CASE("curve SWC: what is wrong is named, with its line", "[io][curve]") {
    CHECK(swc_error(swc_nodes) == "no error");
    CHECK_THAT(swc_error(""), Contains("no nodes"));
    CHECK_THAT(swc_error("# nothing\n"), Contains("no nodes"));
    CHECK_THAT(swc_error("1 0 0 0 0 1 -1\n2 0 1 0 0 1\n"), Contains("line 2") && Contains("parent is missing"));
    CHECK_THAT(swc_error("1 0 0 0 0\n"), Contains("line 1") && Contains("radius is missing"));
    CHECK_THAT(swc_error("1 0 0 0 0 1 -1 0\n"), Contains("line 1") && Contains("seven fields"));
    CHECK_THAT(swc_error("1 0 0 0 nan 1 -1\n"), Contains("line 1") && Contains("z coordinate") && Contains("'nan'"));
    CHECK_THAT(swc_error("1 0 0 0 -inf 1 -1\n"), Contains("'-inf'"));
    CHECK_THAT(swc_error("1 0 0 0 1e999 1 -1\n"), Contains("'1e999'"));
    CHECK_THAT(error_of(curve_from_swc<float>, "1 0 0 0 1e39 1 -1\n"), Contains("'1e39'"));
    CHECK_THAT(swc_error("1 0 0 0 0 inf -1\n"), Contains("radius") && Contains("'inf'"));
    CHECK_THAT(swc_error("1 0 0 0 0 -1 -1\n"), Contains("line 1") && Contains("negative"));
    CHECK_THAT(swc_error("1 dendrite 0 0 0 1 -1\n"), Contains("line 1") && Contains("type"));
    CHECK_THAT(swc_error("1 0 0 0 0 1 -1\n2 0 1 0 0 1 7\n"),
               Contains("line 2") && Contains("parent 7, which does not"));
    CHECK_THAT(swc_error("1 0 0 0 0 1 0\n"), Contains("line 1") && Contains("parent 0, which does not exist"));
    CHECK_THAT(swc_error("1 0 0 0 0 1 -2\n"), Contains("parent -2, which does not exist"));
    CHECK_THAT(swc_error("1 0 0 0 0 1 999999999999999999\n"), Contains("which does not exist"));
    CHECK_THAT(swc_error("1 0 0 0 0 1 -1\n2 0 1 0 0 1 3\n# c\n3 0 1 0 0 1 1\n"),
               Contains("line 2") && Contains("comes after it"));
    CHECK_THAT(swc_error("1 0 0 0 0 1 1\n"), Contains("line 1") && Contains("itself"));
    CHECK_THAT(swc_error("1 0 0 0 0 1 -1\n3 0 1 0 0 1 1\n"), Contains("line 2") && Contains("id 3 where 2"));
    CHECK_THAT(swc_error("1 0 0 0 0 1 -1\n1 0 1 0 0 1 1\n"), Contains("line 2") && Contains("id 1 where 2"));
    CHECK_THAT(swc_error("0 0 0 0 0 1 -1\n"), Contains("line 1") && Contains("id 0 where 1"));
    CHECK_THAT(swc_error("1.0 0 0 0 0 1 -1\n"), Contains("line 1") && Contains("id"));

    const auto with = [](const std::string& comment) { return swc_error("# " + comment + "\n" + swc_nodes); };
    const std::string left_out = "left out, as it closes a cycle: the edge between ";
    CHECK(with(left_out + "1 3") == "no error");
    CHECK(with("left out: something else") == "no error");
    CHECK_THAT(with(left_out + "1 2"), Contains("line 1") && Contains("is there already"));
    CHECK_THAT(swc_error(swc_nodes + "# " + left_out + "1 3\n# " + left_out + "3 1\n"),
               Contains("line 5") && Contains("is there already"));
    CHECK_THAT(with(left_out + "2 2"), Contains("line 1") && Contains("to itself: 2"));
    CHECK_THAT(with(left_out + "1 4"), Contains("line 1") && Contains("does not exist: 4"));
    CHECK_THAT(with(left_out + "0 1"), Contains("line 1") && Contains("does not exist: 0"));
    CHECK_THAT(with(left_out + "-999999999999999999 1"), Contains("line 1") && Contains("does not exist"));
    CHECK_THAT(with(left_out + "1"), Contains("line 1") && Contains("missing"));
    CHECK_THAT(with(left_out + "1 3 2"), Contains("line 1") && Contains("more than two"));
    CHECK_THAT(with("radius 0, a placeholder in its column: node 4"), Contains("line 1") && Contains("does not exist"));
    CHECK_THAT(with("radius 0, a placeholder in its column: node 0"), Contains("line 1") && Contains("does not exist"));
    CHECK_THAT(with("radius 0, a placeholder in its column: node x"), Contains("line 1") && Contains("'x'"));
}
