// Four-legged animals in curves that are drawn by hand: what is whose is known.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/template_rules.hpp>
#include <skelgen/quadruped/boosted_trees.hpp>
#include <skelgen/quadruped/impl/place_joints.hpp>
#include <skelgen/quadruped/joint_table.hpp>
#include <skelgen/quadruped/limbs.hpp>
#include <skelgen/quadruped/place_joints.hpp>

#include "catch.hpp"
#include "shapes.hpp"

using namespace skelgen;

namespace {

using Place = Vector3<double>;

/// A standing horse of lines: x to its left, y up, z forward.
struct DrawnAnimal {
    CurveSkeleton<double> curve;
    std::array<int, 4> feet{}; ///< nodes, by quadruped::Leg
    int head = 0, tail = 0;

    /// Draws a line of places on from a node. \returns its last node.
    int draw(int from, const std::vector<Place>& places, double radius) {
        constexpr int steps = 12;
        for (const Place& to : places) {
            const Place start = core::point(curve.nodes, from);
            for (int i = 1; i <= steps; ++i) from = add(start + (to - start) * i / steps, from, radius);
        }
        return from;
    }

    int add(const Place& place, int before, double radius) {
        const auto node = static_cast<int>(curve.radii.size());
        curve.nodes.conservativeResize(node + 1, 3);
        curve.nodes.row(node) = place.transpose();
        curve.radii.push_back(radius);
        if (before >= 0) curve.edges.push_back({before, node});
        return node;
    }
};

DrawnAnimal horse(bool with_tail = true) {
    DrawnAnimal out;
    const int hips = out.add({0, 1.2, 0}, -1, 0.3);
    const int shoulders = out.draw(hips, {{0, 1.2, 1.1}}, 0.3);
    out.head = out.draw(shoulders, {{0, 1.75, 1.6}, {0, 1.55, 2.1}}, 0.16);
    if (with_tail) out.tail = out.draw(hips, {{0, 1.2, -0.25}, {0, 0.6, -0.4}}, 0.05);
    for (const int side : {1, -1}) {
        const double x = 0.2 * side;
        out.feet[side > 0 ? quadruped::left_fore : quadruped::right_fore] =
            out.draw(shoulders, {{x, 1.0, 1.2}, {x, 0.75, 1.1}, {x, 0.4, 1.15}, {x, 0.1, 1.15}, {x, 0, 1.2}}, 0.07);
        out.feet[side > 0 ? quadruped::left_hind : quadruped::right_hind] =
            out.draw(hips, {{x, 1.0, 0}, {x, 0.8, 0.15}, {x, 0.45, -0.15}, {x, 0.1, -0.05}, {x, 0, 0}}, 0.07);
    }
    return out;
}

CurveSkeleton<double> moved(CurveSkeleton<double> curve, const Eigen::Affine3d& by) {
    for (Eigen::Index v = 0; v < curve.nodes.rows(); ++v)
        curve.nodes.row(v) = (by * Place(curve.nodes.row(v).transpose())).transpose();
    return curve;
}

/// A turn, a scale of 40 and a shift.
Eigen::Affine3d somewhere() {
    Eigen::Affine3d out = Eigen::Affine3d::Identity();
    out.translate(Place(7, -3, 12)).rotate(Eigen::AngleAxisd(2.1, Place(1, 2, -0.5).normalized())).scale(40);
    return out;
}

/// A box around the horse, as far as joints are concerned a body, wherever it was moved.
Body<double> box_around(const Eigen::Affine3d& by = Eigen::Affine3d::Identity()) {
    Body<double> out;
    out.mesh = test::box({1, 2.1, 3.1});
    for (Eigen::Index v = 0; v < out.mesh.vertices.rows(); ++v)
        out.mesh.vertices.row(v) =
            (by * Place(out.mesh.vertices.row(v).transpose() - Place(0.5, 0.1, 0.7))).transpose();
    out.tree = surface::FaceTree<double>(out.mesh);
    return out;
}

Place joint_of(const KinematicSkeleton<double>& skeleton, const std::string& name) {
    const int j = find_joint(skeleton, name);
    REQUIRE(j >= 0);
    return skeleton.joints[static_cast<std::size_t>(j)].position;
}

} // namespace

TEST_CASE("quadruped: a drawn horse has its feet, head, tail and sides", "[quadruped]") {
    const DrawnAnimal animal = horse();
    const auto found = quadruped::find_limbs(animal.curve, 1);
    REQUIRE(found.size() == 1);
    for (std::size_t leg = 0; leg < 4; ++leg) CHECK(found[0].legs[leg].front() == animal.feet[leg]);
    CHECK(found[0].neck.back() == animal.head);
    REQUIRE_FALSE(found[0].tail.empty());
    CHECK(found[0].tail.back() == animal.tail);
    CHECK(found[0].probability > 0.5);
    CHECK(found[0].frame.left.dot(Place::UnitX()) > 0.99);
    CHECK(found[0].frame.forward.dot(Place::UnitZ()) > 0.99);
    CHECK(found[0].frame.up.dot(Place::UnitY()) > 0.99);
}

TEST_CASE("quadruped: turned, scaled and moved the same is found", "[quadruped]") {
    const DrawnAnimal animal = horse();
    const auto before = quadruped::find_limbs(animal.curve, 1);
    CurveSkeleton<double> other = moved(animal.curve, somewhere());
    for (double& radius : other.radii) radius *= 40;
    const auto after = quadruped::find_limbs(other, 1);
    REQUIRE(after.size() == 1);
    CHECK(after[0].legs == before[0].legs);
    CHECK(after[0].tail == before[0].tail);
    CHECK(std::abs(after[0].probability - before[0].probability) < 1e-6);
    const SkeletonTemplate& wanted = builtin_template("quadruped");
    const auto here = quadruped::place_joints(box_around(), animal.curve, before[0], wanted),
               there = quadruped::place_joints(box_around(somewhere()), other, after[0], wanted);
    for (const Joint<double>& joint : here.joints)
        CHECK((somewhere() * joint.position - joint_of(there, joint.name)).norm() < 40 * 1e-9);
}

TEST_CASE("quadruped: a mirrored animal's left legs are those that were right", "[quadruped]") {
    const DrawnAnimal animal = horse();
    Eigen::Affine3d mirror = Eigen::Affine3d::Identity();
    mirror.linear()(0, 0) = -1;
    const auto found = quadruped::find_limbs(moved(animal.curve, mirror), 1);
    REQUIRE(found.size() == 1);
    CHECK(found[0].legs[quadruped::left_fore].front() == animal.feet[quadruped::right_fore]);
    CHECK(found[0].legs[quadruped::right_hind].front() == animal.feet[quadruped::left_hind]);
}

TEST_CASE("quadruped: joints lie in order along the limbs; without a tail its joints are absent", "[quadruped]") {
    const bool with_tail = GENERATE(true, false);
    const DrawnAnimal animal = horse(with_tail);
    const auto found = quadruped::find_limbs(animal.curve, 1);
    REQUIRE(found.size() == 1);
    const SkeletonTemplate& wanted = builtin_template("quadruped");
    const auto skeleton = quadruped::place_joints(box_around(), animal.curve, found[0], wanted);
    REQUIRE(skeleton.joints.size() == wanted.joints.size());
    for (const std::string side : {"left", "right"})
        for (const std::string pair : {"fore", "hind"}) {
            const auto height = [&](const char* part) {
                return joint_of(skeleton, side + "_" + pair + "_" + part).y();
            };
            CHECK(height("upper") > height("lower"));
            CHECK(height("lower") > height("ankle"));
            CHECK(height("ankle") > height("foot"));
            CHECK((joint_of(skeleton, side + "_" + pair + "_foot").x() > 0) == (side == "left"));
        }
    CHECK(joint_of(skeleton, "spine1").z() < joint_of(skeleton, "spine2").z());
    CHECK(joint_of(skeleton, "chest").z() < joint_of(skeleton, "head").z());
    const int tail = find_joint(skeleton, "tail4");
    REQUIRE(tail >= 0);
    CHECK(skeleton.joints[static_cast<std::size_t>(tail)].is_present == with_tail);
    const bool has_tip = std::any_of(skeleton.end_points.begin(), skeleton.end_points.end(),
                                     [](const auto& end) { return end.first == "tail_tip"; });
    CHECK(has_tip == with_tail);
}

TEST_CASE("quadruped: no animal in fewer than five ends, in pieces, or in nothing", "[quadruped]") {
    CHECK(quadruped::find_limbs(CurveSkeleton<double>{}, 1).empty());
    DrawnAnimal line;
    line.draw(line.add({0, 0, 0}, -1, 0.1), {{0, 0, 1}}, 0.1);
    CHECK(quadruped::find_limbs(line.curve, 1).empty());
    DrawnAnimal pieces = horse();
    pieces.add({5, 5, 5}, -1, 0.1);
    CHECK(quadruped::find_limbs(pieces.curve, 1).empty());
}

TEST_CASE("quadruped: a mirrored animal's joints are the mirrored ones of the other side", "[quadruped]") {
    const DrawnAnimal animal = horse();
    Eigen::Affine3d mirror = Eigen::Affine3d::Identity();
    mirror.linear()(0, 0) = -1;
    CurveSkeleton<double> bent = animal.curve; // no side like the other
    bent.nodes.row(animal.feet[quadruped::left_fore]) += Eigen::RowVector3d(0.05, 0.1, 0.2);
    const CurveSkeleton<double> mirrored = moved(bent, mirror);
    const auto found = quadruped::find_limbs(bent, 1), other = quadruped::find_limbs(mirrored, 1);
    REQUIRE(found.size() == 1);
    REQUIRE(other.size() == 1);
    const SkeletonTemplate& wanted = builtin_template("quadruped");
    const auto here = quadruped::place_joints(box_around(), bent, found[0], wanted),
               there = quadruped::place_joints(box_around(mirror), mirrored, other[0], wanted);
    for (int j = 0; j < static_cast<int>(here.joints.size()); ++j) {
        const Joint<double>& joint = here.joints[static_cast<std::size_t>(j)];
        const Place expected = mirror * joint.position;
        CHECK((expected - joint_of(there, mirrored_name(joint.name))).norm() < 1e-9);
    }
}

TEST_CASE("quadruped: where all of an animal is one place, so are its joints", "[quadruped]") {
    const DrawnAnimal animal = horse();
    auto found = quadruped::find_limbs(animal.curve, 1);
    REQUIRE(found.size() == 1);
    CurveSkeleton<double> shrunk = animal.curve;
    shrunk.nodes.setConstant(3);
    std::fill(shrunk.radii.begin(), shrunk.radii.end(), 0.0);
    found[0].size = 0;
    const auto skeleton = quadruped::place_joints(box_around(), shrunk, found[0], builtin_template("quadruped"));
    for (const Joint<double>& joint : skeleton.joints) CHECK((joint.position - Place::Constant(3)).norm() < 1e-12);
}

TEST_CASE("quadruped: every joint of the template has a row of its own in the table", "[quadruped]") {
    const SkeletonTemplate& wanted = builtin_template("quadruped");
    CHECK_NOTHROW(validate_template(wanted));
    std::size_t tails = 0;
    for (const TemplateJoint& joint : wanted.joints) {
        const bool is_tail = joint.role == JointRole::tail;
        const auto& place = quadruped::place_of(joint.role, is_tail ? static_cast<int>(tails++) : 0);
        CHECK(place.role == joint.role);
        if (is_tail) CHECK(place.ordinal == static_cast<int>(tails) - 1);
    }
    CHECK(tails == 4);
}

TEST_CASE("trees answer by their questions, from one to the next, and their voices add up") {
    const quadruped::QuestionTree tree{{0, 1, 2, 0, 0, 0, 0}, {1, 2, 3, 9, 9, 9, 9}, {1, 10, 2, 20, 3, 30, 4, 40}};
    const std::array<quadruped::QuestionTree, 1> one{tree};
    const std::array<quadruped::QuestionTree, 2> two{tree, tree};
    const auto said = [&](double a, double b, double c) {
        const std::array<double, 3> numbers{a, b, c};
        CHECK(quadruped::voices_of(two, numbers) == 2 * quadruped::voices_of(one, numbers));
        return quadruped::voices_of(one, numbers);
    };
    CHECK(said(0, 0, 0) == 1);   // no, no, no
    CHECK(said(0, 3, 0) == 2);   // no, yes, no
    CHECK(said(2, 0, 0) == 3);   // yes, no, no
    CHECK(said(2, 0, 4) == 4);   // yes, yes, no
    CHECK(said(10, 0, 4) == 40); // yes, yes, yes
    CHECK(said(1, 2, 0) == 1);   // as far as a bound is not above it
}
