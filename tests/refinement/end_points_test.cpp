#include <cmath>

#include <skelgen/core/geodesics.hpp>
#include <skelgen/refinement/end_points.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"
#include "stick_figure.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;

TEMPLATE_TEST_CASE("limbs end in the tips of a stick figure, as far from the other end of the body as they go", "",
                   float, double) {
    const SkeletonTemplate& human = builtin_template("human21");
    const StickFigure<TestType> figure;
    const auto ends = find_end_points(figure.body, figure.curve, figure.embedding, human);
    REQUIRE(ends.size() == 5);
    std::vector<int> joints;
    for (const auto& end : ends) {
        joints.push_back(end.joint);
        const TemplateJoint& joint = human.joint(end.joint);
        INFO(joint.name);
        const Vec3 place = figure.body.mesh.vertices.row(end.vertex).transpose().template cast<double>();
        CHECK((place - *joint.tip).norm() < figure.radius(joint.role) + 1.5 * StickFigure<TestType>::step);
        CHECK((place - *joint.tip).dot(*joint.tip - joint.position) > 0); // beyond the end of the bone
        CHECK(end.distance.size() == figure.body.mesh.vertices.rows());
        CHECK(end.distance[end.vertex] == 0);
        CHECK(end.distance.minCoeff() == 0);
        for (const auto& other : ends)
            CHECK(end.distance[other.vertex] == Approx(other.distance[end.vertex]).epsilon(1e-5));
    }
    std::sort(joints.begin(), joints.end());
    CHECK(joints == std::vector<int>{joint_of(JointRole::head), joint_of(JointRole::hand, Side::left),
                                     joint_of(JointRole::hand, Side::right), joint_of(JointRole::foot, Side::left),
                                     joint_of(JointRole::foot, Side::right)});
    CHECK(geodesic_diameter(ends) == Approx(core::geodesic_diameter(figure.body.graph)).epsilon(0.01));
}

TEST_CASE("where limbs end depends on the surface, not on how far the curve goes") {
    const SkeletonTemplate& human = builtin_template("human21");
    const StickFigure<double> figure;
    const auto ends = find_end_points(figure.body, figure.curve, figure.embedding, human);
    const double by = GENERATE_COPY(0.03, 0.08 * embedding::matched_diameter(figure.curve, figure.embedding));
    CurveSkeleton<double> shorter = figure.curve;
    for (std::size_t j = 0; j < human.joints.size(); ++j)
        if (const TemplateJoint& joint = human.joints[j]; joint.tip) {
            const int leaf = figure.leaf_of(static_cast<int>(j));
            const double back = joint.role == JointRole::head ? 0.03 : by; // its own breadth is as long
            shorter.nodes.row(leaf) = (*joint.tip - back * (*joint.tip - joint.position).normalized()).transpose();
        }
    const auto same = find_end_points(figure.body, shorter, figure.embedding, human);
    REQUIRE(same.size() == ends.size());
    for (std::size_t i = 0; i < ends.size(); ++i) {
        INFO(human.joint(ends[i].joint).name);
        const auto place = [&](int vertex) { return figure.body.mesh.vertices.row(vertex); };
        CHECK((place(same[i].vertex) - place(ends[i].vertex)).norm() < 1.5 * StickFigure<double>::step);
        CHECK(same[i].joint == ends[i].joint);
    }
}

TEST_CASE("what no path leads to does not count in the geodesic diameter") {
    const double infinite = std::numeric_limits<double>::infinity();
    EndPoint<double> a{0, 0, Eigen::Vector3d(0, 2, infinite)}, b{1, 1, Eigen::Vector3d(2, 0, infinite)},
        c{2, 2, Eigen::Vector3d(infinite, infinite, 0)};
    CHECK(geodesic_diameter(std::vector{a, b, c}) == 2);
    CHECK(geodesic_diameter(std::vector{c}) == 0);
    CHECK(geodesic_diameter(std::vector<EndPoint<double>>{}) == 0);
}
