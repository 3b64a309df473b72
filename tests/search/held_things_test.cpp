// Bodies that hold long things in their hands: found without these.

#include <algorithm>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/find_curve.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/search/held_things.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "fixture_bodies.hpp"

using namespace skelgen;
using namespace skelgen::test;

TEST_CASE("a staff is taken out of the hand that holds it, and nothing else goes") {
    const FixtureBody shepherd = load_fixture_body("shepherd-raised");
    const Body<double> body = prepare(shepherd.mesh);
    const auto bare = search::without_held_things(body, find_curve(body).curve, builtin_template("human21"), {});
    REQUIRE(bare.size() == 2);
    const auto reach = [&](const Body<double>& each, const char* name) { // of the surface from a true joint
        const auto joint = std::find_if(shepherd.truth.joints.begin(), shepherd.truth.joints.end(),
                                        [&](const auto& known) { return known.first == name; });
        double nearest = 1e9;
        for (Eigen::Index v = 0; v < each.mesh.vertices.rows(); ++v)
            nearest = std::min(nearest,
                               (each.similarity.to_input(core::point(each.mesh.vertices, v)) - joint->second).norm());
        return nearest;
    };
    for (const Body<double>& each : bare) {
        CHECK(each.adjacency.minCoeff() >= 0);
        CHECK(each.repairs.back() == "what is held in one hand taken off");
        const double left = core::surface_area(each.mesh);
        CHECK(left < 0.99);
        CHECK(left > 0.9); // a staff's area is a twentieth
        for (const char* name : {"right_wrist", "left_wrist", "left_hand", "head", "left_foot"})
            CHECK(reach(each, name) == Approx(reach(body, name)).margin(1e-9));
    }
    CHECK(core::surface_area(bare.front().mesh) < core::surface_area(bare.back().mesh)); // by what passes for fingers
}

TEST_CASE("the skeleton of a body with a staff or a sword has its hands where they are, and says what was done") {
    // One stretches the hand out, of one little of the hand is left, one's hilt is too short for a branch of the curve,
    // one has an axe whose end lies where a hand may, one's legs do not go on from the trunk in one direction.
    for (const char* name : {"shepherd-raised", "shepherd-a", "fencer-a", "woodman-raised", "fencer-walk"}) {
        INFO(name);
        const FixtureBody armed = load_fixture_body(name);
        const Extraction<double> found = extract_skeleton(armed.mesh);
        for (const auto& [joint_name, place] : armed.truth.joints) {
            INFO(joint_name);
            const auto joint =
                std::find_if(found.skeleton.joints.begin(), found.skeleton.joints.end(),
                             [&name = joint_name](const Joint<double>& each) { return each.name == name; });
            REQUIRE(joint != found.skeleton.joints.end());
            CHECK(joint->is_present);
            CHECK((joint->position - place).norm() < 0.06 * armed.truth.scale);
        }
        const auto& warnings = found.skeleton.quality.warnings;
        CHECK(std::find(warnings.begin(), warnings.end(), "what is held in one hand taken off") != warnings.end());
        CHECK(std::any_of(found.trail.begin(), found.trail.end(),
                          [](const auto& each) { return each.hypothesis.held != search::Held::nothing; }));
    }
}

TEST_CASE("from empty hands nothing is taken") {
    for (const char* name : {"standing-man", "walking-woman", "figure"}) {
        const Body<double> body = prepare(load_fixture_body(name).mesh);
        CHECK(search::without_held_things(body, find_curve(body).curve, builtin_template("human21"), {}).empty());
    }
}
