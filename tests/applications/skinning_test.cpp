#include <skelgen/applications/skinning.hpp>

#include "catch.hpp"
#include "shapes.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;

TEMPLATE_TEST_CASE("strongest influences: four at most, falling, summing to 1", "[applications][skinning]", float,
                   double) {
    Eigen::MatrixX<TestType> weights(4, 6);
    weights << 1, 0, 0, 0, 0, 0,                              //
        TestType(0.1), TestType(0.2), 0, TestType(0.7), 0, 0, //
        TestType(0.3), TestType(0.25), TestType(0.2), TestType(0.15), TestType(0.1), 0, TestType(0.2), TestType(0.2),
        TestType(0.2), TestType(0.2), TestType(0.2), 0;
    const auto skin = strongest_influences<TestType>(weights);
    CHECK(skin.joints(0, 0) == 0);
    CHECK(skin.weights(0, 0) == 1);
    CHECK(skin.joints(1, 0) == 3);
    CHECK(skin.joints(1, 3) == 0);                  // no weight, no joint
    CHECK(skin.weights(2, 0) == Approx(0.2 / 0.5)); // all less the fifth strongest
    CHECK(skin.weights(2, 3) == Approx(0.05 / 0.5));
    for (int v = 0; v < 4; ++v) {
        CHECK(skin.weights.row(v).sum() == Approx(1));
        CHECK(skin.weights.row(v).minCoeff() >= 0);
    }
    const auto two = strongest_influences<TestType>(weights.leftCols(2).bottomRows(3));
    CHECK(two.weights(0, 0) == Approx(2.0 / 3));
}

TEST_CASE("strongest influences: what a float would lose follows no joint", "[applications][skinning]") {
    Eigen::MatrixXd weights(2, 3);
    weights << 1e-50, 1e-9, 1, //
        0, 1e-20, 3e-20;       // small as a whole is not small beside the strongest
    const auto skin = strongest_influences<double>(weights);
    CHECK(skin.joints.row(0) == Eigen::RowVector4i(2, 0, 0, 0));
    CHECK(skin.weights.row(0) == Eigen::RowVector4d(1, 0, 0, 0));
    CHECK(skin.joints.row(1) == Eigen::RowVector4i(2, 1, 0, 0));
    CHECK(skin.weights(1, 1) == Approx(0.25));
}

/// Two joints at the origin, the second turned by `degrees` about z; a point on each and one between them.
struct Bend {
    Points<double> points{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}};
    Skin<double> skin;
    std::vector<RigidMotion<double>> motions{2};

    explicit Bend(double degrees) {
        skin.joints.setZero(3, 4);
        skin.weights.setZero(3, 4);
        skin.joints.col(1).setOnes();
        skin.weights.leftCols(2) << 1, 0, 0.5, 0.5, 0, 1;
        motions[1].rotation = Eigen::AngleAxisd(degrees * test::pi / 180, Eigen::Vector3d::UnitZ());
    }
};

TEST_CASE("dual quaternions: what lies between two joints turns by half, and keeps its length",
          "[applications][skinning]") {
    for (const double degrees : {-170.0, 60.0, 90.0, 179.0}) {
        const Bend bend(degrees);
        const Points<double> moved = skinned(bend.points, bend.skin, bend.motions);
        for (int v = 0; v < 3; ++v) {
            const double angle = degrees * test::pi / 180 * v / 2;
            CHECK((moved.row(v).transpose() - Eigen::Vector3d(std::cos(angle), std::sin(angle), 0)).norm() < 1e-12);
        }
    }
    const Bend bend(90);
    const Points<double> linear = skinned_linearly(bend.points, bend.skin, bend.motions);
    CHECK((linear.row(1) - Eigen::RowVector3d(0.5, 0.5, 0)).norm() < 1e-12); // shortened
    CHECK((linear.row(2) - Eigen::RowVector3d(0, 1, 0)).norm() < 1e-12);
}

TEST_CASE("dual quaternions: one motion of all joints moves all points by it", "[applications][skinning]") {
    Bend bend(0);
    RigidMotion<double> motion;
    motion.rotation = Eigen::Quaterniond(1, 2, -3, 0.5).normalized();
    motion.translation = {4, -5, 6};
    bend.motions = {motion, motion};
    bend.motions[1].rotation.coeffs() *= -1; // the same rotation
    const Points<double> moved = skinned(bend.points, bend.skin, bend.motions);
    for (int v = 0; v < 3; ++v)
        CHECK((moved.row(v).transpose() - motion(bend.points.row(v).transpose())).norm() < 1e-12);
}

} // namespace
