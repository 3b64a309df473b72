#include <algorithm>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <skelgen/applications/animation.hpp>
#include <skelgen/applications/impl/bind.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/outward_faces.hpp>
#include <skelgen/applications/lowest_place.hpp>
#include <skelgen/applications/pose_transfer.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/shortest_turn.hpp>
#include <skelgen/extract.hpp>

#include "catch.hpp"
#include "human.hpp"
#include "mesh_changes.hpp"
#include "sample_body.hpp"
#include "shapes.hpp"
#include "weights.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using test::human;

template <typename Scalar>
KinematicSkeleton<Scalar> cast(const KinematicSkeleton<double>& skeleton) {
    KinematicSkeleton<Scalar> out;
    out.template_name = skeleton.template_name;
    for (const auto& joint : skeleton.joints)
        out.joints.push_back(
            {joint.name, joint.parent, joint.position.cast<Scalar>(), static_cast<Scalar>(joint.radius)});
    for (const auto& [name, place] : skeleton.end_points)
        out.end_points.emplace_back(name, place.template cast<Scalar>());
    out.frame = {skeleton.frame.origin.cast<Scalar>(), skeleton.frame.left.cast<Scalar>(),
                 skeleton.frame.forward.cast<Scalar>(), skeleton.frame.up.cast<Scalar>()};
    return out;
}

KinematicSkeleton<double> moved_by(KinematicSkeleton<double> skeleton, const test::Motion& motion) {
    for (auto& joint : skeleton.joints) {
        joint.position = motion.scale * (motion.rotation * joint.position) + motion.translation;
        joint.radius *= motion.scale;
    }
    for (auto& [name, place] : skeleton.end_points)
        place = motion.scale * (motion.rotation * place) + motion.translation;
    for (auto* direction : {&skeleton.frame.left, &skeleton.frame.forward, &skeleton.frame.up})
        *direction = motion.rotation * *direction;
    return skeleton;
}

TEST_CASE("characters and posed bodies look outwards, also those of a mesh that is inside out", "[applications][rig]") {
    const test::SampleBody& sample = test::sample_body();
    TriangleMesh<double> turned = sample.mesh;
    turned.faces.col(1).swap(turned.faces.col(2));
    const Rig<double> rig = make_rig(turned, sample.body, sample.skeleton, human());
    CHECK(rig.mesh.faces == sample.mesh.faces);
    CHECK(pose_like(turned, sample.body, sample.skeleton, sample.skeleton, human()).mesh.faces == sample.mesh.faces);

    // The same surface a little larger and inside out around it, as games draw outlines: that is how it is to be.
    TriangleMesh<double> outlined = test::side_by_side(sample.mesh, turned);
    outlined.vertices.bottomRows(turned.vertices.rows()) *= 1.02;
    CHECK(outward_faces(outlined, sample.body) == outlined.faces);
}

TEST_CASE("strays far below the feet, as scans have them, are nothing to stand on", "[applications][rig]") {
    const test::SampleBody& sample = test::sample_body();
    const Floor<double> floor = floor_of(sample.mesh, sample.skeleton, human());
    TriangleMesh<double> stray{Points<double>(3, 3), Triangles(1, 3)};
    stray.faces << 0, 1, 2;
    stray.vertices << 0, 0, 0, 0.01, 0, 0, 0, 0.01, 0;
    stray.vertices.rowwise() -= 3 * floor.up.transpose();
    const TriangleMesh<double> mesh = test::side_by_side(sample.mesh, stray);
    const Floor<double> same = floor_of(mesh, sample.skeleton, human());
    CHECK(same.is_stood_on);
    CHECK(same.height == floor.height);

    const Rig<double> rig = make_rig(mesh, sample.body, sample.skeleton, human());
    CHECK(rig.mesh.vertices.topRows(sample.mesh.vertices.rows()).col(1).minCoeff() == Approx(0).margin(1e-12));
    Animation<double> still;
    still.frames.push_back({rig.joints.front().position, {}});
    for (const RigJoint<double>& joint : rig.joints) still.frames.front().axes.push_back(joint.axes);
    CHECK((on_floor(rig, still).frames.front().root - rig.joints.front().position).norm() < 1e-9);

    // What the soles stand on counts, as soles of shoes that are pieces of their own do.
    stray.vertices.rowwise() += (3 + floor.height - 0.03) * floor.up.transpose();
    const Rig<double> shod = make_rig(test::side_by_side(sample.mesh, stray), sample.body, sample.skeleton, human());
    CHECK(shod.mesh.vertices.topRows(sample.mesh.vertices.rows()).col(1).minCoeff() > 0.01);

    // Faces that have no vertex in common, as those of an STL file, are one piece where they meet.
    const TriangleMesh<double> box = test::box({0.2, 1.7, 0.3}, 4);
    TriangleMesh<double> soup{Points<double>(box.faces.size(), 3), Triangles(box.faces.rows(), 3)};
    for (Eigen::Index i = 0; i < box.faces.size(); ++i) {
        soup.vertices.row(i) = box.vertices.row(box.faces.data()[i]);
        soup.faces.data()[i] = static_cast<int>(i);
    }
    const Points<double> near_top = box.vertices.colwise().maxCoeff().replicate(2, 1);
    CHECK(lowest_place<double>(soup, Eigen::Vector3d::UnitY(), near_top) == box.vertices.col(1).minCoeff());
}

TEST_CASE("a rig in the T-pose: arms level, feet on the floor, metres, weights in order", "[applications][rig]") {
    const test::SampleBody& sample = test::sample_body();
    const Rig<double> rig = make_rig(sample.mesh, sample.body, sample.skeleton, human(), RestPose::t_pose);
    REQUIRE(rig.mesh.vertices.rows() == sample.mesh.vertices.rows());
    CHECK(rig.mesh.faces == sample.mesh.faces);
    CHECK(rig.mesh.vertices.col(1).minCoeff() == Approx(0).margin(1e-12));
    CHECK(rig.unit_is_known);
    CHECK(rig.metres_per_unit == 1);
    const auto joint = [&](const std::string& name) {
        return rig.joints[static_cast<std::size_t>(find_joint(sample.skeleton, name))];
    };
    CHECK(joint("crotch").position.x() == Approx(0).margin(1e-12));
    CHECK(joint("crotch").position.z() == Approx(0).margin(1e-12));
    for (const std::string side : {"left_", "right_"}) {
        const Eigen::Vector3d arm = joint(side + "wrist").position - joint(side + "shoulder").position;
        CHECK(std::abs(arm.normalized().y()) < 1e-9);
        CHECK((side == "left_") == (arm.x() > 0));
        CHECK((joint(side + "elbow").axes * Eigen::Vector3d::UnitY() - arm.normalized()).norm() < 1e-9);
    }

    int two_limbs = 0;
    for (Eigen::Index v = 0; v < rig.mesh.vertices.rows(); ++v) {
        CHECK(rig.skin.weights.row(v).sum() == Approx(1).margin(1e-12));
        two_limbs += test::limbs_followed(rig.skin, v, human(), 0.01) > 1 ? 1 : 0;
    }
    CHECK(two_limbs == 0);
    CHECK(test::islands(rig.skin, rig.mesh.faces) == 0);
}

TEST_CASE("a rig does not depend on how the body is turned, scaled and moved", "[applications][rig]") {
    const test::SampleBody& sample = test::sample_body();
    const Rig<double> rig = make_rig(sample.mesh, sample.body, sample.skeleton, human());
    const auto rig_after = [&](const test::Motion& motion) {
        const TriangleMesh<double> mesh = test::moved(sample.mesh, motion);
        return make_rig(mesh, surface::prepare(mesh), moved_by(sample.skeleton, motion), human());
    };
    // It stands on a plane across an axis, whichever that is; where it stands on none, its trunk tells what is up.
    const Eigen::Matrix3d z_up = Eigen::AngleAxisd(test::pi / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
    const Rig<double> z_up_rig = rig_after({z_up, 1000, {5, -7, 9}});
    CHECK(z_up_rig.metres_per_unit == 0.001);
    CHECK((z_up_rig.mesh.vertices - rig.mesh.vertices).cwiseAbs().maxCoeff() < 1e-6);
    CHECK((z_up_rig.skin.weights - rig.skin.weights).cwiseAbs().maxCoeff() < 1e-6);
    const Rig<double> turned = rig_after({test::random_rotation(11), 1000, {5, -7, 9}});
    const Rig<double> other = rig_after({test::random_rotation(12), 1, {0, 0, 0}});
    CHECK((turned.mesh.vertices - other.mesh.vertices).cwiseAbs().maxCoeff() < 1e-6);
    CHECK((turned.skin.weights - rig.skin.weights).cwiseAbs().maxCoeff() < 1e-6);
    // As it is: no more than turned and put on the floor.
    const double edge = (sample.mesh.vertices.row(0) - sample.mesh.vertices.row(100)).norm();
    CHECK((rig.mesh.vertices.row(0) - rig.mesh.vertices.row(100)).norm() == Approx(edge));

    const TriangleMesh<float> single_mesh{sample.mesh.vertices.cast<float>(), sample.mesh.faces};
    const auto single = make_rig(single_mesh, surface::prepare(single_mesh), cast<float>(sample.skeleton), human());
    CHECK((single.mesh.vertices.cast<double>() - rig.mesh.vertices).cwiseAbs().maxCoeff() < 1e-4);
}

TEST_CASE("pieces and seams are bound like what they lie on", "[applications][rig]") {
    const test::SampleBody& sample = test::sample_body();
    const Skin<double> whole = bind(sample.mesh, sample.body, sample.skeleton, human());
    // Each face with corners of its own, as in files with seams; and a button in front of the belly.
    TriangleMesh<double> soup;
    soup.vertices.resize(sample.mesh.faces.size(), 3);
    soup.faces.resize(sample.mesh.faces.rows(), 3);
    for (int i = 0; i < static_cast<int>(sample.mesh.faces.size()); ++i) {
        soup.vertices.row(i) = sample.mesh.vertices.row(sample.mesh.faces.data()[i]);
        soup.faces.data()[i] = i;
    }
    const BodyFrame<double>& frame = sample.skeleton.frame;
    const auto waist = static_cast<std::size_t>(find_joint(sample.skeleton, "waist"));
    const Joint<double>& middle = sample.skeleton.joints[waist];
    TriangleMesh<double> button = test::sphere(0.01, 1);
    button.vertices.rowwise() += (middle.position + 1.05 * middle.radius * frame.forward).transpose();
    const TriangleMesh<double> pieces = test::side_by_side(soup, button);
    const Skin<double> skin = bind(pieces, extract(pieces).body, sample.skeleton, human());
    REQUIRE(skin.weights.rows() == soup.vertices.rows() + button.vertices.rows());
    // A soup is put right at places rounded to 6e-8: by up to 1e-5 of the length of an edge, and so of its bound.
    for (int i = 0; i < static_cast<int>(sample.mesh.faces.size()); ++i) {
        const int v = sample.mesh.faces.data()[i];
        if ((skin.weights.row(i) - whole.weights.row(v)).cwiseAbs().maxCoeff() > 2e-5) FAIL("corner " << i);
    }
    for (Eigen::Index v = soup.vertices.rows(); v < skin.weights.rows(); ++v)
        CHECK(part_of(human().joint(skin.joints(v, 0)).role) == BodyPart::trunk);
}

TEST_CASE("a flank stays with the trunk, also where an arm goes into it", "[applications][rig]") {
    const auto& [sample, found, in_sample, in_body] = test::sample_body();
    const KinematicSkeleton<double> skeleton = surface::to_body(in_body, in_sample);
    const auto at = [&](const char* name) { return static_cast<std::size_t>(find_joint(skeleton, name)); };
    const auto place = [&](const char* name) { return skeleton.joints[at(name)].position; };
    const Skin<double> skin = bind(sample, in_body, in_sample, human());
    std::vector<int> vertices(in_body.source.size());
    std::iota(vertices.begin(), vertices.end(), 0);

    // The arm points at the hip's outside.
    const Vector3<double> shoulder = place("left_shoulder");
    RigidMotion<double> inwards;
    inwards.rotation = core::shortest_turn<double>(
        place("left_elbow") - shoulder, place("left_hip") + (place("left_hip") - place("right_hip")) / 2 - shoulder);
    inwards.translation = shoulder - inwards.rotation * shoulder;
    std::vector<RigidMotion<double>> motions(skeleton.joints.size());
    const std::vector<bool> is_arm = joints_below(human(), static_cast<int>(at("left_shoulder")));
    for (std::size_t j = 0; j < motions.size(); ++j)
        if (is_arm[j]) motions[j] = inwards;
    const Skin<double> own{skin.joints(in_body.source, Eigen::all), skin.weights(in_body.source, Eigen::all)};
    TriangleMesh<double> mesh{skinned(in_body.mesh.vertices, own, motions), in_body.mesh.faces};
    const Body<double> body = surface::make_body(mesh, Similarity<double>{}, vertices, 0);
    const Skin<double> posed = bind(mesh, body, moved(skeleton, human(), motions), human());

    const auto share_of_arm = [&](const Skin<double>& of, Eigen::Index v) {
        double share = 0;
        for (int k = 0; k < 4; ++k)
            if (is_arm[static_cast<std::size_t>(of.joints(v, k))]) share += of.weights(v, k);
        return share;
    };
    int touched = 0, strayed = 0;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        if (share_of_arm(own, v) > 0.01) continue;
        const Vector3<double> elbow = inwards(place("left_elbow"));
        touched += core::nearest_on_segment<double, 3>(core::point(mesh.vertices, v), shoulder, elbow).distance <
                   skeleton.joints[at("left_elbow")].radius;
        strayed += share_of_arm(posed, v) > 0.5;
    }
    CHECK(touched > 5);
    CHECK(strayed < 20); // 37 where the arm warms whatever sees it; the rest is close to the armpit
}

TEST_CASE("heels follow feet", "[applications][rig]") {
    const test::SampleBody& sample = test::sample_body();
    const Skin<double> skin = bind(sample.mesh, sample.body, sample.skeleton, human());
    for (const Side side : {Side::left, Side::right}) {
        const int ankle = find_joint(human(), JointRole::ankle, side),
                  knee = find_joint(human(), JointRole::knee, side);
        const auto place = [&](int j) { return sample.skeleton.joints[static_cast<std::size_t>(j)].position; };
        const Eigen::Vector3d calf = (place(ankle) - place(knee)).normalized();
        const double sole = (bone_end(sample.skeleton, human(), ankle) - place(ankle)).dot(calf);
        REQUIRE(sole > 0.01);
        int heel = 0;
        for (Eigen::Index v = 0; v < sample.mesh.vertices.rows(); ++v) {
            const TemplateJoint& joint = human().joint(skin.joints(v, 0));
            const Eigen::Vector3d from_ankle = sample.mesh.vertices.row(v).transpose() - place(ankle);
            if (joint.side != side || part_of(joint.role) != BodyPart::leg || from_ankle.dot(calf) < sole / 2) continue;
            INFO(joint.name << ", vertex " << v);
            CHECK((joint.role == JointRole::ankle || joint.role == JointRole::foot));
            ++heel;
        }
        CHECK(heel > 20);
    }
}

/// An open tube of fine rings around a limb's joint.
TriangleMesh<double> tube_around(const Eigen::Vector3d& joint, const Eigen::Vector3d& along, double radius) {
    constexpr int rings = 41, around = 24;
    const Eigen::Vector3d across = along.unitOrthogonal();
    TriangleMesh<double> tube;
    tube.vertices.resize(rings * around, 3);
    tube.faces.resize(2 * (rings - 1) * around, 3);
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < around; ++k) {
            const Eigen::AngleAxisd turn(2 * std::numbers::pi * k / around, along);
            tube.vertices.row(i * around + k) =
                (joint + 0.004 * (i - rings / 2) * along + radius * (turn * across)).transpose();
            if (i == 0) continue;
            const int a = (i - 1) * around + k, b = (i - 1) * around + (k + 1) % around;
            tube.faces.row(2 * a) << a, b, a + around;
            tube.faces.row(2 * a + 1) << b, b + around, a + around;
        }
    return tube;
}

TEST_CASE("cloth of finer edges than the body's stretches no more than that", "[applications][rig]") {
    const test::SampleBody& sample = test::sample_body();
    const auto joint = [&](const char* name) -> const Joint<double>& {
        return sample.skeleton.joints[static_cast<std::size_t>(find_joint(sample.skeleton, name))];
    };
    const Eigen::Vector3d along = (joint("left_ankle").position - joint("left_hip").position).normalized();
    const TriangleMesh<double> dressed = test::side_by_side(
        sample.mesh, tube_around(joint("left_knee").position, along, 1.1 * joint("left_knee").radius));
    const Rig<double> rig = make_rig(dressed, extract(dressed).body, sample.skeleton, human(), RestPose::t_pose);
    const auto knee = static_cast<std::size_t>(find_joint(sample.skeleton, "left_knee"));
    const RigJoint<double>& bends = rig.joints[knee];
    RigidMotion<double> bend;
    bend.rotation = Eigen::AngleAxisd(std::numbers::pi / 2, bends.axes * Eigen::Vector3d::UnitX());
    bend.translation = bends.position - bend.rotation * bends.position;
    std::vector<RigidMotion<double>> motions(rig.joints.size());
    const std::vector<bool> below = joints_below(human(), static_cast<int>(knee));
    for (std::size_t j = 0; j < below.size(); ++j)
        if (below[j]) motions[j] = bend;
    const Points<double> bent = skinned_linearly(rig.mesh.vertices, rig.skin, motions);
    const double shortest = 0.001 * rig.mesh.vertices.col(1).maxCoeff();
    double most = 0;
    for (Eigen::Index f = 0; f < rig.mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = rig.mesh.faces(f, k), b = rig.mesh.faces(f, (k + 1) % 3);
            const double was = (rig.mesh.vertices.row(a) - rig.mesh.vertices.row(b)).norm();
            most = std::max(most, (bent.row(a) - bent.row(b)).norm() / std::max(shortest, was));
        }
    CHECK(most < 3);
}

TEST_CASE("edges stretch no more than that from the pose that bends begin in", "[applications][rig]") {
    const test::SampleBody& sample = test::sample_body();
    const auto now = bone_orientations(sample.skeleton, human());
    auto wanted = orientations_in<double>(RestPose::t_pose, human(), now, Eigen::Quaterniond::Identity());
    const auto knee = static_cast<std::size_t>(find_joint(sample.skeleton, "left_knee"));
    const std::vector<bool> below = joints_below(human(), static_cast<int>(knee));
    const auto about = [](double angle) { return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()); };
    for (std::size_t j = 0; j < below.size(); ++j)
        if (below[j]) wanted[j] = about(std::numbers::pi / 3) * wanted[j];
    const auto to_rest = motions<double>(sample.skeleton, now, wanted, Eigen::Vector3d::Zero());
    const Eigen::Vector3d joint = to_rest[knee](sample.skeleton.joints[knee].position);

    const auto largest_stretch = [&](const Skin<double>& skin) {
        const Points<double> rest = skinned(sample.mesh.vertices, skin, to_rest);
        const double shortest = 0.001 * (rest.col(1).maxCoeff() - rest.col(1).minCoeff());
        std::vector<RigidMotion<double>> bend(below.size());
        const auto quarter = about(std::numbers::pi / 2);
        for (std::size_t j = 0; j < below.size(); ++j)
            if (below[j]) bend[j] = {Eigen::Quaterniond(quarter), joint - quarter * joint};
        const Points<double> bent = skinned_linearly(rest, skin, bend);
        double most = 0;
        for (Eigen::Index f = 0; f < sample.mesh.faces.rows(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int a = sample.mesh.faces(f, k), b = sample.mesh.faces(f, (k + 1) % 3);
                most = std::max(most, (bent.row(a) - bent.row(b)).norm() /
                                          std::max(shortest, (rest.row(a) - rest.row(b)).norm()));
            }
        return most;
    };
    StartOfBends<double> start{to_rest, test::human_axes()};
    for (std::size_t j = 0; j < start.axes.size(); ++j) start.axes[j] = wanted[j] * start.axes[j];
    CHECK(largest_stretch(bind(sample.mesh, sample.body, sample.skeleton, human(), start)) < 1.95);
    CHECK(largest_stretch(bind(sample.mesh, sample.body, sample.skeleton, human())) > 2.5);
}

TEST_CASE("what cannot be bound is refused", "[applications][rig]") {
    const test::SampleBody& sample = test::sample_body();
    const test::Motion away{Eigen::Matrix3d::Identity(), 1, {50, 0, 0}};
    const auto code = [](const auto& call) -> std::optional<ErrorCode> {
        try {
            static_cast<void>(call());
        } catch (const Error& error) {
            return error.code();
        }
        return std::nullopt;
    };
    CHECK(code([&] { return bind(sample.mesh, sample.body, moved_by(sample.skeleton, away), human()); }) ==
          ErrorCode::no_skeleton);
    CHECK(code([&] {
              return bind(sample.mesh, sample.body, sample.skeleton, human(), {{}, test::human_axes()});
          }) == ErrorCode::usage);
    CHECK(code([&] { return bind(sample.mesh, sample.body, sample.skeleton, builtin_template("pinocchio18")); }) ==
          ErrorCode::usage);
    CHECK(code([&] { return make_rig(TriangleMesh<double>{}, sample.body, sample.skeleton, human()); }) ==
          ErrorCode::usage);
}

TEST_CASE("the unit is known by a person's height", "[applications][rig]") {
    CHECK(metres_per_unit(1.7) == 1);
    CHECK(metres_per_unit(170) == 0.01);
    CHECK(metres_per_unit(1700) == 0.001);
    CHECK(metres_per_unit(0.2) == 0);
    CHECK(metres_per_unit(20) == 0);
    CHECK(metres_per_unit(1e6) == 0);
}

} // namespace
