#include <skelgen/applications/alignment.hpp>

#include <cmath>

#include <Eigen/Geometry>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

#include "anatomy/rest_skeleton.hpp"
#include "catch.hpp"
#include "mesh_changes.hpp"
#include "sample_body.hpp"

using namespace skelgen;
using namespace skelgen::applications;
using namespace skelgen::test;

namespace {

/// The rest pose, turned, scaled and moved.
template <typename Scalar>
KinematicSkeleton<Scalar> moved_rest(const Motion& motion) {
    KinematicSkeleton<Scalar> skeleton = rest_skeleton<Scalar>();
    for (Joint<Scalar>& joint : skeleton.joints)
        joint.position = (motion.scale * motion.rotation * joint.position.template cast<double>() + motion.translation)
                             .template cast<Scalar>();
    return skeleton;
}

template <typename Scalar>
Points<Scalar> joints_of(const KinematicSkeleton<Scalar>& skeleton) {
    Points<Scalar> out(static_cast<Eigen::Index>(skeleton.joints.size()), 3);
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
        core::set_point<Scalar>(out, static_cast<Eigen::Index>(j), skeleton.joints[j].position);
    return out;
}

} // namespace

TEMPLATE_TEST_CASE("alignment: a body turned at random stands upright, faces +z, left at +x", "[applications]", float,
                   double) {
    using Scalar = TestType;
    const Scalar tolerance = sizeof(Scalar) == 4 ? Scalar(1e-4) : Scalar(1e-9);
    const Points<Scalar> expected = transformed<Scalar>(
        joints_of(rest_skeleton<Scalar>()), alignment(rest_skeleton<Scalar>(), joints_of(rest_skeleton<Scalar>())));
    const auto at = [&](const char* name) { return core::point(expected, find_joint(rest_skeleton<Scalar>(), name)); };
    CHECK(at("left_hip").x() > at("right_hip").x());
    CHECK(at("waist").y() > at("left_hip").y());
    CHECK(at("left_foot").z() > at("left_ankle").z());
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const KinematicSkeleton<Scalar> turned =
            moved_rest<Scalar>({random_rotation(seed), 1, Vector3<double>(3, -2, 1)});
        const Eigen::Matrix<Scalar, 4, 4> transform = alignment(turned, joints_of(turned));
        const Eigen::Matrix<Scalar, 3, 3> rotation = transform.template topLeftCorner<3, 3>();
        CHECK((rotation * rotation.transpose()).isIdentity(tolerance));
        CHECK(rotation.determinant() == Approx(1).margin(tolerance)); // no mirroring
        CHECK((transformed<Scalar>(joints_of(turned), transform) - expected).cwiseAbs().maxCoeff() < 10 * tolerance);
    }
}

TEST_CASE("alignment: the origin is in the crotch, or on the floor below it", "[applications]") {
    const KinematicSkeleton<double> turned = moved_rest<double>({random_rotation(5), 2, Vector3<double>(1, 2, 3)});
    const Points<double> points = joints_of(turned);
    const Points<double> crotch = transformed<double>(points, alignment(turned, points));
    CHECK(core::point(crotch, 0).norm() < 1e-12);
    AlignmentOptions on_floor;
    on_floor.origin = AlignedOrigin::floor;
    const Points<double> floor = transformed<double>(points, alignment(turned, points, on_floor));
    CHECK(floor.col(1).minCoeff() == Approx(0).margin(1e-12));
    CHECK(std::abs(floor(0, 0)) < 1e-12);
    CHECK(std::abs(floor(0, 2)) < 1e-12);
    on_floor.scale = 10;
    CHECK((transformed<double>(points, alignment(turned, points, on_floor)) - 10 * floor).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("alignment: what cannot be aligned", "[applications]") {
    const KinematicSkeleton<double> skeleton = rest_skeleton();
    CHECK_THROWS_AS(alignment(skeleton, Points<double>(0, 3)), Error);
    AlignmentOptions flat;
    flat.scale = 0;
    CHECK_THROWS_WITH(alignment(skeleton, joints_of(skeleton), flat), Catch::Matchers::Contains("alignment.scale"));
    KinematicSkeleton<double> headless = skeleton;
    headless.joints.resize(2);
    CHECK_THROWS_WITH(alignment(headless, joints_of(headless)), Catch::Matchers::Contains("left_hip"));
}

TEST_CASE("alignment: a pelvis's own back says where left is, whatever the hips say", "[applications]") {
    const SampleBody& sample = sample_body();
    const Vector3<double> left = pelvis_directions(sample.body, sample.skeleton).left;
    CHECK(left.norm() == Approx(1));
    CHECK(std::abs(left.dot(pelvis_directions(sample.body, sample.skeleton).up)) < 1e-9);
    // The man walks; his own x is his left, to a few degrees.
    CHECK(left.x() > std::cos(0.1));
    // Hips whose line is turned by 15 degrees: the back turns it back by most of that.
    KinematicSkeleton<double> twisted = sample.skeleton;
    Joint<double>& hip = twisted.joints[static_cast<std::size_t>(find_joint(twisted, "left_hip"))];
    const Vector3<double> other = twisted.joints[static_cast<std::size_t>(find_joint(twisted, "right_hip"))].position;
    hip.position = other + Eigen::AngleAxisd(0.26, Vector3<double>::UnitZ()) * (hip.position - other);
    const double before = std::acos(pelvis_directions(twisted).left.normalized().dot(left)),
                 after = std::acos(pelvis_directions(sample.body, twisted).left.dot(left));
    CHECK(before > 0.2);
    CHECK(after < before / 3);
    const Eigen::Matrix4d transform = alignment(sample.body, sample.skeleton, sample.mesh.vertices);
    CHECK((transform.topLeftCorner<3, 3>() * left - Vector3<double>::UnitX()).norm() < 1e-9);
}
