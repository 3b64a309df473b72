// What a skeleton shows by itself, in closed forms: on the template's own bones, as a curve, as tubes, as a skeleton.

#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/anatomy/complete.hpp>
#include <skelgen/anatomy/confidence.hpp>
#include <skelgen/anatomy/impl/equal_bones.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/search/evidence.hpp>

#include "anatomy/rest_skeleton.hpp"
#include "catch.hpp"
#include "embedding/human_curve.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::search;
using namespace skelgen::test;

namespace {

const SkeletonTemplate& human() { return builtin_template("human21"); }

/// The rest pose with a head that has an end, as files have it.
KinematicSkeleton<double> rest_pose() {
    KinematicSkeleton<double> skeleton = rest_skeleton();
    for (const TemplateJoint& joint : human().joints)
        if (joint.tip) skeleton.end_points.emplace_back(end_point_name(human(), joint), *joint.tip);
    skeleton.frame = {skeleton.joints.front().position, Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY()};
    for (Joint<double>& joint : skeleton.joints) joint.radius = 0.04;
    return skeleton;
}

anatomy::CompletedSkeleton<double> completed(const KinematicSkeleton<double>& skeleton) {
    return {skeleton, std::vector<double>(skeleton.joints.size(), 0), {}};
}

/// Tubes around the bones of a skeleton, as they stand.
Mesh tubes_around(const KinematicSkeleton<double>& skeleton, double radius = 0.04) {
    std::vector<std::array<Vec3, 2>> bones;
    for (const Joint<double>& joint : skeleton.joints)
        if (joint.parent >= 0)
            bones.push_back({skeleton.joints[static_cast<std::size_t>(joint.parent)].position, joint.position});
    return tubes(bones, radius, 0.03);
}

const Body<double>& resting_body() {
    static const Body<double> body = body_of(tubes_around(rest_pose()));
    return body;
}

embedding::Embedding embedded(const CurveSkeleton<double>& curve) {
    const auto found = embedding::embed(curve, human());
    REQUIRE(found);
    return *found;
}

constexpr double usual_diameter = 1.5;

/// As evidence_of, of a template that was laid into the curve so.
template <typename Scalar>
Evidence evidence_in(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve, const embedding::Embedding& laid,
                     const anatomy::CompletedSkeleton<Scalar>& skeleton, const SkeletonTemplate& wanted,
                     Scalar diameter) {
    return evidence_of(body, curve, &laid, skeleton, wanted, diameter);
}

/// Of a skeleton in the resting body and on the resting curve.
Evidence evidence_of_skeleton(const anatomy::CompletedSkeleton<double>& skeleton,
                              const SkeletonTemplate& wanted = human()) {
    const CurveSkeleton<double> curve = human_curve();
    return evidence_in(resting_body(), curve, embedded(curve), skeleton, wanted, usual_diameter);
}

Evidence evidence_of_pose(const KinematicSkeleton<double>& skeleton) {
    return evidence_of_skeleton(completed(skeleton));
}

/// Of a curve that the resting curve's embedding is laid into.
Evidence evidence_of_curve(const CurveSkeleton<double>& curve) {
    return evidence_in(resting_body(), curve, embedded(human_curve()), completed(rest_pose()), human(), usual_diameter);
}

/// The curve with a straight branch of five edges at the node of a joint.
CurveSkeleton<double> with_branch(CurveSkeleton<double> curve, const char* joint, const Vec3& way) {
    int last = find_joint(rest_skeleton(), joint);
    const Vec3 from = core::point(curve.nodes, last);
    for (int i = 1; i <= 5; ++i) {
        const auto node = static_cast<int>(curve.nodes.rows());
        curve.nodes.conservativeResize(node + 1, 3);
        curve.nodes.row(node) = (from + i / 5.0 * way).transpose();
        curve.edges.push_back({last, node});
        curve.regions.push_back({});
        curve.radii.push_back(0.02);
        last = node;
    }
    return curve;
}

double length_of_chains() {
    double length = 0;
    for (const embedding::Chain& chain : embedded(human_curve()).chains)
        length += core::path_length(human_curve(), chain.nodes);
    return length;
}

/// All joints from this one on moved.
void move_from(KinematicSkeleton<double>& skeleton, const std::string& first, const Vec3& way) {
    std::set<int> moved{find_joint(skeleton, first)};
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        if (moved.count(skeleton.joints[j].parent) > 0) moved.insert(static_cast<int>(j));
        if (moved.count(static_cast<int>(j)) > 0) skeleton.joints[j].position += way;
    }
}

/// A limb below its first joint laid straight along a direction, its bones as long as they were.
void lay(KinematicSkeleton<double>& skeleton, const std::string& first, const Vec3& direction) {
    int last = find_joint(skeleton, first);
    const KinematicSkeleton<double> before = skeleton;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        if (skeleton.joints[j].parent != last) continue;
        const double length =
            (before.joints[j].position - before.joints[static_cast<std::size_t>(last)].position).norm();
        skeleton.joints[j].position = skeleton.joints[static_cast<std::size_t>(last)].position + length * direction;
        last = static_cast<int>(j);
    }
}

} // namespace

TEST_CASE("what hangs on the curve is told by how far it reaches, and a bulge does not") {
    for (const auto& [joint, way] : {std::pair("head", Vec3(0, 0, -0.5)), std::pair("left_wrist", Vec3(0, 0.4, 0.3)),
                                     std::pair("waist", Vec3(0, 0, -0.5))}) {
        INFO(joint);
        const Evidence evidence = evidence_of_curve(with_branch(human_curve(), joint, way));
        CHECK(evidence[Witness::unmatched_reach] == Approx(way.norm() / length_of_chains()));
    }
    CHECK(evidence_of_curve(human_curve())[Witness::unmatched_reach] == 0);
    CurveSkeleton<double> belly = human_curve(); // a branch within the ball around the waist
    belly.radii[static_cast<std::size_t>(find_joint(rest_skeleton(), "waist"))] = 0.2;
    CHECK(evidence_of_curve(with_branch(belly, "waist", Vec3(0, 0, 0.15)))[Witness::unmatched_reach] == 0);
}

TEST_CASE("reach is the logarithm of the diameter over an adult's") {
    const CurveSkeleton<double> curve = human_curve();
    for (const auto& [diameter, reach] :
         {std::pair(1.5, 0.0), std::pair(3.0, std::log(2.0)), std::pair(0.75, -std::log(2.0))})
        CHECK(evidence_in(resting_body(), curve, embedded(curve), completed(rest_pose()), human(),
                          diameter)[Witness::reach] == Approx(reach).margin(1e-12));
}

TEST_CASE("the proportions of the template's own rest pose are the usual ones") {
    const Evidence evidence = evidence_of_pose(rest_pose());
    for (const Witness witness : {Witness::arm_length, Witness::leg_length, Witness::hip_width}) {
        INFO(to_string(witness));
        CHECK(evidence[witness] == Approx(0).margin(1e-12));
    }
}

TEST_CASE("proportions are logarithms of how much longer limbs are beside the trunk") {
    KinematicSkeleton<double> skeleton = rest_pose();
    for (const std::string side : {"left_", "right_"}) {
        const Vec3 shoulder = at(skeleton, side + "shoulder"), hip = at(skeleton, side + "hip");
        for (const char* name : {"elbow", "wrist", "hand"})
            at(skeleton, side + name) = shoulder + 2 * (at(skeleton, side + name) - shoulder);
        for (const char* name : {"knee", "ankle", "foot"})
            at(skeleton, side + name) = hip + 0.5 * (at(skeleton, side + name) - hip);
    }
    const Evidence evidence = evidence_of_pose(skeleton);
    CHECK(evidence[Witness::arm_length] == Approx(std::log(2.0)));
    CHECK(evidence[Witness::leg_length] == Approx(-std::log(2.0)));
    CHECK(evidence[Witness::hip_width] == Approx(0).margin(1e-12));

    KinematicSkeleton<double> wide = rest_pose(); // hips three times as far apart, with their legs
    for (const char* name : {"left_hip", "right_hip"}) move_from(wide, name, Vec3(2 * at(wide, name).x(), 0, 0));
    CHECK(evidence_of_pose(wide)[Witness::hip_width] == Approx(std::log(3.0)));
    CHECK(evidence_of_pose(wide)[Witness::leg_length] == Approx(0).margin(1e-12));
}

TEST_CASE("a side that is absent leaves the proportions of the other one") {
    KinematicSkeleton<double> skeleton = rest_pose();
    for (const char* name : {"left_elbow", "left_wrist", "left_hand"})
        skeleton.joints[static_cast<std::size_t>(find_joint(skeleton, name))].is_present = false;
    CHECK(evidence_of_pose(skeleton)[Witness::arm_length] == Approx(0).margin(1e-12));
    CHECK(evidence_of_pose(skeleton)[Witness::leg_length] == Approx(0).margin(1e-12));
}

TEST_CASE("doubts and joints that were outside are means over the joints that are there") {
    auto skeleton = completed(rest_pose());
    skeleton.doubt[3] = std::exp(2.0) - 1;
    skeleton.doubt[7] = anatomy::misplaced_from + 1;
    skeleton.moved = {7, 9, 11};
    const Evidence evidence = evidence_of_skeleton(skeleton);
    CHECK(evidence[Witness::doubt] == Approx((2 + std::log(anatomy::misplaced_from + 2)) / 21));
    CHECK(evidence[Witness::outside] == Approx(3.0 / 21));
}

TEST_CASE("what the template lacks is counted, the head apart") {
    const auto lacks = [](const SkeletonTemplate& wanted) {
        KinematicSkeleton<double> skeleton = rest_pose();
        for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
            skeleton.joints[j].is_present = !wanted.joints[j].is_absent;
        const Evidence evidence = evidence_of_skeleton(completed(skeleton), wanted);
        CHECK(evidence[Witness::cut_limbs] == 0);
        return std::pair(evidence[Witness::lacks_head], evidence[Witness::lacks_limbs]);
    };
    CHECK(lacks(human()) == std::pair(0.0, 0.0));
    const SkeletonTemplate headless = without_limb(human(), find_joint(human(), JointRole::head));
    CHECK(lacks(headless) == std::pair(1.0, 0.0));
    const SkeletonTemplate armless = without_limb(human(), find_joint(human(), JointRole::elbow, Side::left));
    CHECK(lacks(armless) == std::pair(0.0, 1.0));
    CHECK(lacks(without_limb(armless, find_joint(human(), JointRole::knee, Side::right))) == std::pair(0.0, 2.0));
}

TEST_CASE("limbs whose ends the surface shows to be cut off are counted apart from those that the template lacks") {
    KinematicSkeleton<double> skeleton = rest_pose();
    for (const char* name : {"left_hand", "right_foot"})
        skeleton.joints[static_cast<std::size_t>(find_joint(skeleton, name))].is_present = false;
    const Evidence evidence = evidence_of_pose(skeleton);
    CHECK(evidence[Witness::cut_limbs] == 2);
    CHECK(evidence[Witness::lacks_limbs] == 0);
    CHECK(evidence[Witness::lacks_head] == 0);
}

TEST_CASE("where no template was laid into the curve, the curve is no witness") {
    const CurveSkeleton<double> curve = with_branch(human_curve(), "head", Vec3(0, 0, -0.5));
    const Evidence evidence =
        evidence_of<double>(resting_body(), curve, nullptr, completed(rest_pose()), human(), usual_diameter);
    const Evidence expected = evidence_of_pose(rest_pose());
    CHECK(evidence[Witness::unmatched_reach] == 0);
    for (const Witness witness : {Witness::unexplained, Witness::arm_length, Witness::pairs_girths})
        CHECK(evidence[witness] == expected[witness]);
}

TEST_CASE("a limb's joint in another limb or in the trunk lies there as deep as it is near that one's bone") {
    CHECK(evidence_of_pose(rest_pose())[Witness::apart] == 0);

    KinematicSkeleton<double> knees = rest_pose();
    const Vec3 thigh = 0.5 * (at(knees, "right_hip") + at(knees, "right_knee"));
    at(knees, "left_knee") = thigh;
    CHECK(evidence_of_pose(knees)[Witness::apart] == Approx(1));
    at(knees, "left_knee") = thigh + Vec3(0, 0, 0.01); // of a radius of 0.04
    CHECK(evidence_of_pose(knees)[Witness::apart] == Approx(0.75));

    KinematicSkeleton<double> elbow = rest_pose();
    at(elbow, "right_elbow") = 0.5 * (at(elbow, "waist") + at(elbow, "chest"));
    CHECK(evidence_of_pose(elbow)[Witness::apart] == Approx(1));
    elbow.joints[static_cast<std::size_t>(find_joint(elbow, "right_elbow"))].is_present = false;
    CHECK(evidence_of_pose(elbow)[Witness::apart] == 0);
}

TEST_CASE("a limb that comes back to its own upper bone is folded as far as it is near") {
    CHECK(evidence_of_pose(rest_pose())[Witness::folded] == 0);
    for (const auto& [root, middle, outer] : {std::array{"left_shoulder", "left_elbow", "left_wrist"},
                                              std::array{"right_hip", "right_knee", "right_ankle"}}) {
        INFO(outer);
        KinematicSkeleton<double> skeleton = rest_pose();
        const Vec3 from = at(skeleton, root), bone = at(skeleton, middle) - from;
        at(skeleton, outer) = from + 0.3 * bone;
        CHECK(evidence_of_pose(skeleton)[Witness::folded] == Approx(1));
        const Vec3 across = bone.cross(Vec3(1, 2, 3)).normalized();
        at(skeleton, outer) += 0.125 * bone.norm() * across; // a quarter of half the bone
        CHECK(evidence_of_pose(skeleton)[Witness::folded] == Approx(0.75));
        skeleton.joints[static_cast<std::size_t>(find_joint(skeleton, outer))].is_present = false;
        CHECK(evidence_of_pose(skeleton)[Witness::folded] == 0);
    }
}

TEST_CASE("the legs of who stands go on from the trunk, those of an animal or of who sits do not") {
    CHECK(evidence_of_pose(rest_pose())[Witness::legs_go_on] > 0.99);
    KinematicSkeleton<double> across = rest_pose();
    for (const std::string side : {"left_", "right_"}) lay(across, side + "hip", Vec3::UnitZ());
    CHECK(evidence_of_pose(across)[Witness::legs_go_on] < 0.1);
}

TEST_CASE("bones inside the body explain its surface, those beside it do not; like limbs are as thick") {
    CHECK(evidence_of_pose(rest_pose())[Witness::unexplained] < 0.1);
    CHECK(evidence_of_pose(rest_pose())[Witness::pairs_girths] < 0.1);
    KinematicSkeleton<double> beside = rest_pose();
    for (Joint<double>& joint : beside.joints) joint.position += Vec3(0, 0, 1);
    for (auto& [name, place] : beside.end_points) place += Vec3(0, 0, 1);
    CHECK(evidence_of_pose(beside)[Witness::unexplained] > 0.9);
}

TEST_CASE("how a body is turned, and its unit, are no evidence") {
    const Motion motion{random_rotation(5), 3, {10, -20, 30}};
    KinematicSkeleton<double> skeleton = rest_pose();
    const Evidence expected = evidence_of_pose(skeleton);
    CurveSkeleton<double> curve = human_curve();
    const embedding::Embedding embedding = embedded(curve);
    for (Joint<double>& joint : skeleton.joints) {
        joint.position = motion.apply(joint.position);
        joint.radius *= motion.scale;
    }
    for (auto& [name, place] : skeleton.end_points) place = motion.apply(place);
    skeleton.frame = {motion.apply(skeleton.frame.origin), motion.rotation * skeleton.frame.left,
                      motion.rotation * skeleton.frame.forward, motion.rotation * skeleton.frame.up};
    for (Eigen::Index v = 0; v < curve.nodes.rows(); ++v)
        curve.nodes.row(v) = motion.apply(core::point(curve.nodes, static_cast<int>(v))).transpose();
    for (double& radius : curve.radii) radius *= motion.scale;
    const Evidence found = evidence_in(body_of(moved(tubes_around(rest_pose()), motion)), curve, embedding,
                                       completed(skeleton), human(), usual_diameter);
    for (std::size_t w = 0; w < witness_count; ++w) {
        INFO(to_string(static_cast<Witness>(w)));
        CHECK(found.values[w] == Approx(expected.values[w]).margin(1e-6));
    }
}

TEST_CASE("single precision sees the same evidence") {
    const KinematicSkeleton<double> rest = rest_pose();
    KinematicSkeleton<float> skeleton = rest_skeleton<float>();
    skeleton.end_points.emplace_back("head_top", rest.end_points.front().second.cast<float>());
    skeleton.frame = {rest.frame.origin.cast<float>(), Vector3<float>::UnitX(), Vector3<float>::UnitZ(),
                      Vector3<float>::UnitY()};
    for (Joint<float>& joint : skeleton.joints) joint.radius = 0.04F;
    const auto curve = in_precision<float>(human_curve());
    const anatomy::CompletedSkeleton<float> complete{skeleton, std::vector<double>(21, 0), {}};
    const Evidence found = evidence_in(body_of<float>(tubes_around(rest)), curve, embedded(human_curve()), complete,
                                       human(), static_cast<float>(usual_diameter));
    const Evidence expected = evidence_of_pose(rest);
    for (std::size_t w = 0; w < witness_count; ++w) {
        INFO(to_string(static_cast<Witness>(w)));
        CHECK(found.values[w] == Approx(expected.values[w]).margin(1e-3));
    }
}
