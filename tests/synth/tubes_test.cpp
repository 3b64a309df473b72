#include <skelgen/synth/tubes.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

#include "catch.hpp"
#include "synth/surface_mesher.hpp"

using namespace skelgen;
using namespace skelgen::synth;

namespace {

TubePlan planned(const std::string& name) {
    for (const TubePlan& plan : tube_plans(1))
        if (plan.name == name) return plan;
    throw std::runtime_error("no plan " + name);
}

double distance_to_axis(const CurveSkeleton<double>& truth, const Vec3& place) {
    double nearest = 1e9;
    for (const auto& [a, b] : truth.edges)
        nearest = std::min(
            nearest,
            core::nearest_on_segment(place, core::point(truth.nodes, a), core::point(truth.nodes, b)).distance);
    return nearest;
}

void check_tube(const TubePlan& plan) {
    INFO(plan.name);
    const SynthTube tube = synthesize_tube(plan, plan.faces);
    CHECK(tube.mesh.faces.rows() == Approx(plan.faces).epsilon(0.02));
    const Topology topology = topology_of(tube.mesh);
    CHECK(topology.closed_manifold);
    CHECK(topology.components == 1);
    CHECK(topology.euler == 2 - 2 * plan.cycles);
    CHECK(core::enclosed_volume(tube.mesh) > 0);
    CHECK(core::end_count(tube.truth) == plan.ends);
    CHECK(core::cycle_count(tube.truth) == plan.cycles);
    // Free ends are poles, on the surface.
    for (const int end : core::nodes_of_degree(tube.truth, 1)) {
        const auto nearest = (tube.mesh.vertices.rowwise() - tube.truth.nodes.row(end)).rowwise().norm().minCoeff();
        CHECK(nearest < 0.03);
    }
}

} // namespace

TEST_CASE("the plans of tubes have distinct names and are the same for the same seed") {
    const auto plans = tube_plans(1), again = tube_plans(1), other = tube_plans(2);
    REQUIRE(plans.size() == 30);
    REQUIRE(other.size() == 30);
    std::set<std::string> names;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        INFO(plans[i].name);
        names.insert(plans[i].name);
        CHECK(plans[i].strokes[0].line == again[i].strokes[0].line);
        CHECK(plans[i].strokes[0].line != other[i].strokes[0].line); // turned another way
        CHECK(plans[i].strokes[0].radii == other[i].strokes[0].radii);
    }
    CHECK(names.size() == plans.size());
}

TEST_CASE("points of a tube's line are a quarter of the radius apart or closer") {
    for (const TubePlan& plan : tube_plans(1))
        for (const TubeStroke& stroke : plan.strokes) {
            INFO(plan.name);
            REQUIRE(stroke.radii.size() == stroke.line.size());
            if (!stroke.wide.empty()) REQUIRE(stroke.wide.size() == stroke.line.size());
            double widest_gap = 0;
            for (std::size_t i = 1; i < stroke.line.size(); ++i)
                widest_gap = std::max(widest_gap, (stroke.line[i] - stroke.line[i - 1]).norm() /
                                                      std::max(stroke.radii[i], stroke.radii[i - 1]));
            CHECK(widest_gap <= 0.26);
        }
}

TEST_CASE("the vertices of a straight tube lie at the radius from its axis") {
    const TubePlan plan = planned("straight");
    const SynthTube tube = synthesize_tube(plan, 5000);
    const std::vector<Vec3>& line = plan.strokes[0].line;
    CurveSkeleton<double> uncapped = tube.truth;
    uncapped.edges.clear();
    for (int i = 1; i < static_cast<int>(line.size()); ++i) uncapped.edges.push_back({i - 1, i}); // in order, no caps
    for (Eigen::Index v = 0; v < tube.mesh.vertices.rows(); ++v)
        REQUIRE(distance_to_axis(uncapped, core::point(tube.mesh.vertices, v)) == Approx(0.12).margin(1e-5));
}

TEST_CASE("elliptical sections have their two diameters") {
    const TubePlan plan = planned("ellipse-1.5");
    const SynthTube tube = synthesize_tube(plan, 5000);
    const TubeStroke& stroke = plan.strokes[0];
    const Vec3 middle = (stroke.line.front() + stroke.line.back()) / 2;
    const Vec3 along = (stroke.line.back() - stroke.line.front()).normalized(), wide = stroke.wide[0];
    const Vec3 narrow = wide.cross(along);
    double widest = 0, deepest = 0;
    for (Eigen::Index v = 0; v < tube.mesh.vertices.rows(); ++v) {
        const Vec3 off = core::point(tube.mesh.vertices, v) - middle;
        widest = std::max(widest, std::abs(off.dot(wide)));
        deepest = std::max(deepest, std::abs(off.dot(narrow)));
    }
    CHECK(widest == Approx(0.18).epsilon(0.005));
    CHECK(deepest == Approx(0.12).epsilon(0.005));
}

TEST_CASE("the same plan gives the same bytes") {
    const TubePlan plan = planned("branching-t");
    const SynthTube tube = synthesize_tube(plan, 5000), again = synthesize_tube(plan, 5000);
    CHECK(tube.mesh.vertices == again.mesh.vertices);
    CHECK(tube.mesh.faces == again.mesh.faces);
    CHECK(curve_truth_to_json(tube.truth, "x.off") == curve_truth_to_json(again.truth, "x.off"));
}

TEST_CASE("tubes are closed surfaces with the ends and the cycles of their plans") {
    for (const char* name : {"bent-90", "ring", "star-4", "ladder-3", "ellipse-bent"}) check_tube(planned(name));
}

TEST_CASE("all tubes are closed surfaces with the ends and the cycles of their plans", "[.slow]") {
    for (const TubePlan& plan : tube_plans(1)) check_tube(plan);
}

TEST_CASE("the truth of tubes holds the axis and what follows from it") {
    const SynthTube tube = synthesize_tube(planned("branching-t"), 5000);
    const auto json = nlohmann::json::parse(curve_truth_to_json(tube.truth, "tubes/branching-t.off"));
    CHECK(json["mesh"] == "tubes/branching-t.off");
    CHECK(json["axis"]["nodes"].size() == static_cast<std::size_t>(tube.truth.nodes.rows()));
    CHECK(json["axis"]["radii"].size() == tube.truth.radii.size());
    CHECK(json["axis"]["edges"].size() == tube.truth.edges.size());
    CHECK(json["ends"] == 3);
    CHECK(json["cycles"] == 0);
    const auto [thin, thick] = std::minmax_element(tube.truth.radii.begin(), tube.truth.radii.end());
    CHECK(*thin == 0.09);
    CHECK(*thick == 0.11);
}

TEST_CASE("numbers of faces out of range and plans that are not what they say are refused") {
    TubePlan plan = planned("straight");
    CHECK_THROWS_AS(synthesize_tube(plan, 10), Error);
    plan.ends = 3;
    CHECK_THROWS_AS(synthesize_tube(plan, 5000), Error);
}
