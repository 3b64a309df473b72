#include <limits>
#include <string>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/extract_hinted.hpp>
#include <skelgen/io/read_mesh.hpp>

#include "catch.hpp"
#include "fixture_bodies.hpp"
#include "shapes.hpp"

namespace {

using namespace skelgen;

/// human21 at rest.
KinematicSkeleton<double> skeleton_at_rest() {
    const SkeletonTemplate& human = builtin_template("human21");
    KinematicSkeleton<double> out;
    for (const TemplateJoint& joint : human.joints) {
        out.joints.push_back({joint.name, joint.parent, joint.position});
        if (joint.tip) out.end_points.emplace_back(end_point_name(human, joint), *joint.tip);
    }
    return out;
}

Vector3<double> place_of(const KinematicSkeleton<double>& skeleton, const char* joint) {
    return skeleton.joints.at(static_cast<std::size_t>(find_joint(skeleton, joint))).position;
}

TEST_CASE("bent_to: hinted joints are there, limbs follow as if drawn, the trunk stays", "[extract][hints]") {
    const auto rest = skeleton_at_rest();
    const SkeletonTemplate& human = builtin_template("human21");
    const Vector3<double> move(0.1, 0.3, -0.2);
    const auto bent = bent_to(rest, human, {{"left_hand", place_of(rest, "left_hand") + move}}, 2.0);
    CHECK((place_of(bent, "left_hand") - place_of(rest, "left_hand") - move).norm() < 1e-12);
    const auto moved = [&](const char* joint) { return (place_of(bent, joint) - place_of(rest, joint)).norm(); };
    CHECK(moved("left_wrist") > moved("left_elbow"));
    CHECK(moved("left_elbow") > moved("left_shoulder"));
    CHECK(moved("left_elbow") > 0.2 * move.norm());
    CHECK(moved("left_shoulder") < 0.15 * move.norm());
    CHECK(moved("right_knee") < 0.01 * move.norm());
    for (std::size_t e = 0; e < rest.end_points.size(); ++e)
        if (rest.end_points[e].first == "left_fingertip")
            CHECK((bent.end_points[e].second - rest.end_points[e].second - move).norm() < 1e-8);
    CHECK(bent_to(rest, human, {}, 2.0).joints.at(7).position == rest.joints.at(7).position);
}

TEST_CASE("bent_to: hints that say nothing of a joint are refused", "[extract][hints]") {
    const auto rest = skeleton_at_rest();
    const SkeletonTemplate& human = builtin_template("human21");
    const Vector3<double> nowhere(0, std::numeric_limits<double>::quiet_NaN(), 0);
    CHECK_THROWS_AS(bent_to(rest, human, {{"tail", {0, 0, 0}}}, 2.0), Error);
    CHECK_THROWS_AS(bent_to(rest, human, {{"head", nowhere}}, 2.0), Error);
    CHECK_THROWS_AS(bent_to(rest, human, {{"head", {0, 0, 0}}, {"head", {0, 1, 0}}}, 2.0), Error);
}

TEST_CASE("hints: what is no body's gets the skeleton that fits best, and hints exchange sides", "[extract][hints]") {
    const auto mesh = read_mesh(SKELGEN_DATA "/sample/body.off");
    const auto found = extract(mesh);
    const Vector3<double> left = place_of(found.skeleton, "left_hand"), right = place_of(found.skeleton, "right_hand");
    const auto same = extract_hinted(mesh, {{"left_hand", left}});
    CHECK((place_of(same.skeleton, "right_knee") - place_of(found.skeleton, "right_knee")).norm() < 0.05);
    const auto exchanged = extract_hinted(mesh, {{"left_hand", right}, {"right_hand", left}});
    CHECK(place_of(exchanged.skeleton, "left_hand") == right);
    CHECK((place_of(exchanged.skeleton, "left_foot") - place_of(found.skeleton, "right_foot")).norm() < 0.1);
    CHECK(exchanged.skeleton.frame.left.dot(found.skeleton.frame.left) < 0);
    const auto box = test::box({1, 1, 1}, 4);
    CHECK_THROWS_AS(extract(box), NoSkeleton);
    CHECK_THROWS_AS(extract_hinted(box, {{"left_hand", {100, 100, 100}}}), Error); // of another mesh
    const Vector3<double> corner(1, 1, 0);
    CHECK(place_of(extract_hinted(box, {{"left_hand", corner}}).skeleton, "left_hand") == corner);
}

TEST_CASE("hints: the other side's joint goes where the surface mirrors the hint, without its confidence",
          "[extract][hints]") {
    const auto mesh = test::load_fixture_body("kneeling-boy").mesh;
    const auto found = extract(mesh);
    // A little farther up the arms than elbows were found: near enough for what was found to be taken and bent.
    const double off = 0.06 * core::bounding_diagonal(mesh.vertices);
    const auto higher = [&](const std::string& side) -> Vector3<double> {
        const Vector3<double> elbow = place_of(found.skeleton, (side + "_elbow").c_str());
        return elbow + off * (place_of(found.skeleton, (side + "_shoulder").c_str()) - elbow).normalized();
    };
    const auto hinted = extract_hinted(mesh, {{"left_elbow", higher("left")}}).skeleton;
    CHECK(place_of(hinted, "left_elbow") == higher("left"));
    CHECK((place_of(hinted, "right_elbow") - higher("right")).norm() < off / 2);
    CHECK(hinted.joints.at(static_cast<std::size_t>(find_joint(hinted, "right_elbow"))).confidence < 1);
}

TEST_CASE("hints: the other side's joint stays where a body that is not the same on both sides has it",
          "[extract][hints]") {
    const auto mesh = test::load_fixture_body("walking-woman").mesh;
    const auto found = extract(mesh).skeleton;
    const double size = core::bounding_diagonal(mesh.vertices);
    const Vector3<double> hand = place_of(found, "left_hand"), wrist = place_of(found, "left_wrist");
    const Vector3<double> hint = hand + 0.03 * size * (wrist - hand).normalized();
    const auto hinted = extract_hinted(mesh, {{"left_hand", hint}}).skeleton;
    CHECK(place_of(hinted, "left_hand") == hint);
    CHECK((place_of(hinted, "right_hand") - place_of(found, "right_hand")).norm() < 0.01 * size);
}

} // namespace
