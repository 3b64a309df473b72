// Characters made of pieces: what one hand holds as a piece of its own does not count, and parts that do not touch
// are one body.

#include <algorithm>
#include <cmath>
#include <string>

#include <skelgen/extract.hpp>
#include <skelgen/surface/prepare.hpp>
#include <skelgen/synth/body.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::test;
using surface::Remedy;

namespace {

/// A person of 14 closed limbs.
const synth::SynthBody& person() {
    static const synth::SynthBody made = [] {
        synth::BodyPlan plan;
        plan.pose = synth::named_pose("a");
        plan.pieces.limbs = synth::LimbPieces::closed;
        return synth::synthesize_body(plan);
    }();
    return made;
}

Vec3 true_joint(synth::BodyJoint joint) { return person().truth.joints[static_cast<std::size_t>(joint)]; }

/// The person with a shield on the left forearm, as large as the trunk, that reaches from the hip to the head.
Mesh with_shield() {
    const Vec3 wrist = true_joint(synth::BodyJoint::left_wrist);
    return side_by_side(person().mesh, moved_by(box(Vec3(0.03, 0.9, 1.1), 4), wrist + Vec3(0.05, 0, 0.1)));
}

/// The farthest that one of these joints is from where it truly is, in metres.
double worst_error(const KinematicSkeleton<double>& skeleton) {
    double worst = 0;
    for (const Joint<double>& joint : skeleton.joints)
        for (const auto which :
             {synth::BodyJoint::left_knee, synth::BodyJoint::right_knee, synth::BodyJoint::left_elbow,
              synth::BodyJoint::right_elbow, synth::BodyJoint::left_ankle, synth::BodyJoint::right_ankle})
            if (joint.name == synth::joint_name(which))
                worst = std::max(worst, (joint.position - true_joint(which)).norm());
    return worst;
}

} // namespace

TEST_CASE("a shield that is a piece of its own is left out where the body is not found with it", "[extract][slow]") {
    const Mesh mesh = with_shield();
    const auto remedies = surface::gather(mesh).remedies;
    REQUIRE(std::find(remedies.begin(), remedies.end(), Remedy::alike_pieces) == remedies.begin() + 1);
    const auto found = extract(mesh);
    std::string tried;
    for (const auto& each : found.trail)
        tried +=
            std::string(search::to_string(each.hypothesis.surface)) + " " + std::to_string(each.probability) + "\n";
    INFO(tried);
    CHECK(worst_error(found.skeleton) < 0.06);
    CHECK(tried == "");
}
