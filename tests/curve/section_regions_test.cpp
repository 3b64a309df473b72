#include <algorithm>
#include <cmath>

#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/impl/section_regions.hpp>

#include "catch.hpp"
#include "curve/branched_lines.hpp"
#include "curve/curve_expectations.hpp"
#include "curve/unit_body.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

constexpr double radius = 0.2, spacing = 0.1;

/// Branches where they are, with their sections.
CentredBranches<double> with_sections(const BranchedCurve<double>& branched, const Body<double>& body) {
    CentredBranches<double> out{branched, {}};
    for (const Branch<double>& branch : branched.branches)
        out.sections.push_back(sections_across(body, branch.line, 4 * spacing));
    return out;
}

/// All vertices from origin 2, which is that of the only branch of a curve.
std::vector<int> of_one_branch(const Mesh& mesh) {
    return std::vector<int>(static_cast<std::size_t>(mesh.vertices.rows()), 2);
}

} // namespace

TEST_CASE("each vertex of a tube comes into the region of a node that it is beside") {
    const Mesh mesh = capsule(radius, 4);
    const Body<double> body = body_of(mesh);
    const BranchedCurve<double> axis = straight_branches({{0, 0, -0.19}, {0, 0, 4.19}}, {{0, 1}}, spacing);
    const CurveSkeleton<double> curve = curve_with_regions(with_sections(axis, body), body, of_one_branch(mesh));
    check_is_curve(curve, mesh.vertices.rows());
    CHECK(curve.nodes.rows() == axis.branches[0].line.rows());
    const double edge = 4.0 / 40; // between two of the capsule's rings
    int along = 0;
    for (Eigen::Index k = 0; k < curve.nodes.rows(); ++k) {
        const double z = curve.nodes(k, 2);
        const std::vector<int>& region = curve.regions[static_cast<std::size_t>(k)];
        CHECK(std::is_sorted(region.begin(), region.end()));
        if (z < 0.3 || z > 3.7) continue;
        INFO("node at " << z);
        CHECK(!region.empty());
        for (const int v : region) CHECK(std::abs(mesh.vertices(v, 2) - z) <= spacing + edge);
        ++along;
    }
    CHECK(along > 30);
    // The poles belong to the ends.
    const auto lowest = static_cast<int>(mesh.vertices.rows()) - 2;
    REQUIRE(mesh.vertices(lowest, 2) == -radius);
    const int low_end = nearest_node(curve, Vec3(0, 0, -radius));
    CHECK(std::binary_search(curve.regions[static_cast<std::size_t>(low_end)].begin(),
                             curve.regions[static_cast<std::size_t>(low_end)].end(), lowest));
}

TEST_CASE("a node's radius is that of the ball around it that touches the surface") {
    const Mesh mesh = capsule(radius, 4, 64, 80);
    const Body<double> body = body_of(mesh);
    const BranchedCurve<double> axis = straight_branches({{0, 0, -0.19}, {0, 0, 4.19}}, {{0, 1}}, spacing);
    const CurveSkeleton<double> curve = curve_with_regions(with_sections(axis, body), body, of_one_branch(mesh));
    REQUIRE(curve.radii.size() == static_cast<std::size_t>(curve.nodes.rows()));
    for (Eigen::Index k = 0; k < curve.nodes.rows(); ++k) {
        const double z = curve.nodes(k, 2), beyond = std::max({-z, z - 4, 0.0});
        CHECK(curve.radii[static_cast<std::size_t>(k)] == Approx(radius - beyond).epsilon(0.01).margin(0.0002));
    }
}

TEST_CASE("sections take vertices only from where their branch was") {
    const Mesh mesh = three_tubes();
    const Body<double> body = body_of(mesh);
    const auto ends = three_tube_ends();
    const BranchedCurve<double> star =
        straight_branches({Vec3::Zero(), ends[0], ends[1], ends[2]}, {{0, 1}, {0, 2}, {0, 3}}, 0.05);
    std::vector<int> origin;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        std::array<double, 3> away{};
        for (std::size_t k = 0; k < 3; ++k) away[k] = segment_distance(point(mesh.vertices, v), Vec3::Zero(), ends[k]);
        origin.push_back(4 + static_cast<int>(std::min_element(away.begin(), away.end()) - away.begin()));
    }
    const CentredBranches<double> centred = with_sections(star, body);
    const CurveSkeleton<double> curve = curve_with_regions(centred, body, origin);
    check_is_curve(curve, mesh.vertices.rows());
    const JoinedCurve<double> joined = join_branches(star);
    CHECK(curve.nodes == joined.curve.nodes);
    CHECK(curve.edges == joined.curve.edges);
    for (std::size_t b = 0; b < 3; ++b)
        for (const int node : joined.nodes_of_branch[b]) {
            if (curve.nodes.row(node).norm() < 0.35) continue;
            for (const int v : curve.regions[static_cast<std::size_t>(node)])
                CHECK(origin[static_cast<std::size_t>(v)] == 4 + static_cast<int>(b));
        }
}

TEST_CASE("a curve of one node has all vertices") {
    const Mesh mesh = sphere(1, 3);
    const CentredBranches<double> point_alone{{{{0.1, 0, 0}}, {}}, {}};
    const CurveSkeleton<double> curve = curve_with_regions(point_alone, body_of(mesh), of_one_branch(mesh));
    check_is_curve(curve, mesh.vertices.rows());
    REQUIRE(curve.nodes.rows() == 1);
    CHECK(curve.regions[0].size() == static_cast<std::size_t>(mesh.vertices.rows()));
    CHECK(curve.radii[0] == Approx(0.9).epsilon(0.01));
}

TEST_CASE("regions are found in float, too") {
    const Mesh mesh = capsule(radius, 4);
    const Body<float> body = body_of(TriangleMesh<float>{mesh.vertices.cast<float>(), mesh.faces});
    const Points<float> line =
        straight_branches({{0, 0, -0.19}, {0, 0, 4.19}}, {{0, 1}}, spacing).branches[0].line.cast<float>();
    CentredBranches<float> centred{{{point(line, 0), point(line, line.rows() - 1)}, {{0, 1, line, {0, 1, 2}}}}, {}};
    centred.sections.push_back(sections_across(body, line, 0.4f));
    const CurveSkeleton<float> curve = curve_with_regions(centred, body, of_one_branch(mesh));
    check_is_curve(curve, mesh.vertices.rows());
    CHECK(curve.radii[static_cast<std::size_t>(nearest_node(curve, Vector3<float>(0, 0, 2)))] ==
          Approx(0.2f).epsilon(0.01));
}
