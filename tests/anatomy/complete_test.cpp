#include <limits>
#include <vector>

#include <skelgen/anatomy/complete.hpp>
#include <skelgen/anatomy/confidence.hpp>
#include <skelgen/anatomy/impl/equal_bones.hpp>
#include <skelgen/anatomy/impl/joint_offsets.hpp>
#include <skelgen/core/geometry.hpp>

#include "anatomy/rest_skeleton.hpp"
#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::anatomy;
using namespace skelgen::test;

namespace {

/// Tubes around the bones of human21, and a curve with a node at each joint.
Body<double> tube_body() {
    std::vector<std::array<Vec3, 2>> bones;
    for (const TemplateJoint& joint : builtin_template("human21").joints)
        if (joint.parent >= 0)
            bones.push_back({builtin_template("human21").joint(joint.parent).position, joint.position});
    return body_of(tubes(bones, 0.05, 0.03));
}

CurveSkeleton<double> curve_of_joints() {
    CurveSkeleton<double> curve;
    const KinematicSkeleton<double> rest = rest_skeleton();
    curve.nodes.resize(static_cast<Eigen::Index>(rest.joints.size()), 3);
    for (std::size_t j = 0; j < rest.joints.size(); ++j)
        curve.nodes.row(static_cast<Eigen::Index>(j)) = rest.joints[j].position.transpose();
    return curve;
}

} // namespace

TEST_CASE("a skeleton is completed: offsets, joints inside, radii, and doubts about where the joints then are") {
    const SkeletonTemplate& human = builtin_template("human21");
    const Body<double> body = tube_body();
    KinematicSkeleton<double> sided = rest_skeleton();
    at(sided, "head") += Vec3(0, 0, 0.12);
    const auto found = complete_skeleton(sided, body, curve_of_joints(), human);
    const KinematicSkeleton<double>& skeleton = found.skeleton;
    CHECK(at(skeleton, "left_knee") == at(apply_joint_offsets(sided, human), "left_knee"));
    for (const Joint<double>& joint : skeleton.joints) {
        INFO(joint.name);
        CHECK(core::winding_number(body.mesh, joint.position) == Approx(1));
        CHECK(joint.radius > 0.03);
        CHECK(joint.radius < 0.12);
    }
    CHECK(found.moved == std::vector<int>{find_joint(skeleton, "head")});
    REQUIRE(skeleton.quality.warnings.size() == 1);
    CHECK(skeleton.quality.warnings[0].find("head") != std::string::npos);
    CHECK(found.doubt == joint_doubts(skeleton, human, bone_lengths(apply_joint_offsets(sided, human))));
    CHECK(skeleton.frame.origin == at(skeleton, "crotch"));
}

TEST_CASE("a skeleton with unlikely bones all over is completed, and its joints are doubted") {
    const SkeletonTemplate& human = builtin_template("human21");
    KinematicSkeleton<double> sided = rest_skeleton();
    const std::vector<const char*> wrong{"left_elbow", "right_knee", "waist", "right_wrist", "left_ankle"};
    for (const char* name : wrong) { // to its parent's place
        const Joint<double>& joint = joint_named(sided, name);
        at(sided, name) = 0.9 * sided.joints[static_cast<std::size_t>(joint.parent)].position + 0.1 * joint.position;
    }
    const auto found = complete_skeleton(sided, tube_body(), curve_of_joints(), human);
    REQUIRE(found.doubt.size() == human.joints.size());
    for (const char* name : wrong) {
        INFO(name);
        CHECK(found.doubt[static_cast<std::size_t>(find_joint(sided, name))] > misplaced_from);
    }
}

TEST_CASE("a skeleton that lies beside its body is brought in, every joint of it") {
    KinematicSkeleton<double> sided = rest_skeleton();
    for (Joint<double>& joint : sided.joints) joint.position += Vec3(0, 0, 1);
    const Body<double> body = tube_body();
    const auto found = complete_skeleton(sided, body, curve_of_joints(), builtin_template("human21"));
    CHECK(found.moved.size() == 21);
    for (const Joint<double>& joint : found.skeleton.joints) CHECK(surface::is_inside(body, joint.position));
}

TEST_CASE("joints are put at other places: inside, as long on both sides, and the ends of limbs go along") {
    const SkeletonTemplate& human = builtin_template("human21");
    const Body<double> body = tube_body();
    KinematicSkeleton<double> before = complete_skeleton(rest_skeleton(), body, curve_of_joints(), human).skeleton;
    before.end_points = {{"left_fingertip", at(before, "left_hand")}, {"right_fingertip", at(before, "right_hand")}};
    before.joints[static_cast<std::size_t>(find_joint(before, "right_foot"))].is_present = false;
    Points<double> places(static_cast<Eigen::Index>(before.joints.size()), 3);
    for (std::size_t j = 0; j < before.joints.size(); ++j)
        places.row(static_cast<Eigen::Index>(j)) = before.joints[j].position.transpose();
    const Vec3 along = (at(before, "left_hand") - at(before, "left_wrist")) / 2;
    places.row(find_joint(before, "left_hand")) -= along.transpose();
    places.row(find_joint(before, "head")) += Vec3(0, 0, 0.5).transpose();
    places.row(find_joint(before, "right_foot")).setConstant(std::numeric_limits<double>::quiet_NaN());
    const KinematicSkeleton<double> after = with_joints_at(places, before, body, curve_of_joints(), human);

    for (const char* same : {"left_wrist", "right_hand", "left_knee", "right_ankle"}) {
        INFO(same);
        CHECK((at(after, same) - at(before, same)).norm() < 1e-12);
    }
    CHECK((at(after, "left_hand") - (at(before, "left_hand") - along)).norm() < 1e-12); // a third shorter: left alone
    CHECK(surface::is_inside(body, at(after, "head")));
    CHECK(after.quality.warnings.size() == 1); // of the head
    CHECK_FALSE(joint_named(after, "right_foot").is_present);
    CHECK(at(after, "right_foot") == at(before, "right_foot"));
    const Vec3 left_end = after.end_points[0].second;
    CHECK((left_end - at(after, "left_hand")).norm() < 0.12); // a corner of the tube around it
    CHECK((body.mesh.vertices.rowwise() - left_end.transpose()).rowwise().norm().minCoeff() < 1e-12);
    CHECK(after.end_points[1].second == before.end_points[1].second);

    const KinematicSkeleton<double> again = with_joints_at(places, after, body, curve_of_joints(), human);
    CHECK(again.quality.warnings.size() == 1); // what is known is not said again
}
