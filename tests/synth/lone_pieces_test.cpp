// Characters made of pieces: what one hand holds as a piece of its own does not count.

#include <algorithm>
#include <cmath>
#include <vector>

#include <skelgen/extract.hpp>
#include <skelgen/search/trust.hpp>
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

/// The person with a chest in the left hand that reaches into the hip: hand and hip are one with it.
Mesh with_chest() {
    const Vec3 wrist = true_joint(synth::BodyJoint::left_wrist);
    return side_by_side(person().mesh, moved_by(box(Vec3(0.4, 0.4, 0.4), 4), wrist - Vec3(0.1, 0, 0)));
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

TEST_CASE("what one hand holds as a piece of its own is left out where no body is found with it", "[extract][slow]") {
    const Mesh mesh = with_chest();
    const std::vector<Remedy> remedies = surface::gather(mesh).remedies;
    REQUIRE(remedies.size() >= 3);
    CHECK(remedies[0] == Remedy::envelope);
    CHECK(remedies[1] == Remedy::alike_pieces);
    CHECK(remedies.back() == Remedy::largest_piece);
    const auto found = extract(mesh);
    REQUIRE(found.trail.size() >= 2);
    CHECK(found.trail[0].hypothesis.surface == Remedy::envelope);
    CHECK(found.trail[0].probability < search::sure_enough); // alone it has heard no dissent
    const auto likeliest = std::max_element(found.trail.begin(), found.trail.end(),
                                            [](const auto& a, const auto& b) { return a.probability < b.probability; });
    CHECK(likeliest->hypothesis.surface == Remedy::alike_pieces);
    CHECK(likeliest->probability > 0.9);
    CHECK(worst_error(found.skeleton) < 0.03);
}
