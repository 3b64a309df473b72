#include <type_traits>
#include <vector>

#include <skelgen/refinement/placement.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;

// It refers to its template, which may be no temporary; it is a value for all that.
static_assert(std::is_constructible_v<Placement<double>, const SkeletonTemplate&, double>);
static_assert(!std::is_constructible_v<Placement<double>, SkeletonTemplate, double>);
static_assert(std::is_move_assignable_v<Placement<float>> && std::is_copy_assignable_v<Placement<float>>);

TEMPLATE_TEST_CASE("a placement knows the template's joints by their roles", "", float, double) {
    const SkeletonTemplate& human = builtin_template("human21");
    Placement<TestType> placement(human, TestType(0.5));
    CHECK(placement.positions().rows() == 21);
    CHECK(placement.positions().isZero());
    CHECK(placement.find(JointRole::neck) == joint_of(JointRole::neck));
    CHECK(placement.find(JointRole::hip) == -1); // there are two, which have sides
    const int left = joint_of(JointRole::hip, Side::left), right = joint_of(JointRole::hip, Side::right);
    CHECK(placement.all(JointRole::hip) == std::vector<int>{left, right});
    CHECK(placement.role(left) == JointRole::hip);

    placement.put(left, {1, 2, 3});
    placement.put(right, {3, 4, -1});
    CHECK(placement.at(left) == Vector3<TestType>(1, 2, 3));
    CHECK(*placement.middle(JointRole::hip) == Vector3<TestType>(2, 3, 1));

    SkeletonTemplate headless{"headless", {human.joints.begin(), human.joints.begin() + 3}};
    CHECK_FALSE(Placement<TestType>(headless, 1).middle(JointRole::neck).has_value());
    CHECK(Placement<TestType>(headless, 1).find(JointRole::neck) == -1);
    CHECK(Placement<TestType>(headless, 1).rest_height(JointRole::neck) == 0);
}

TEMPLATE_TEST_CASE("rest poses count upwards along y, in whatever unit", "", float, double) {
    const SkeletonTemplate& human = builtin_template("human21");
    const SkeletonTemplate centimetres = scaled(human, 100);
    const Placement<TestType> placement(human, TestType(0.7)), same(centimetres, TestType(0.007));
    CHECK(placement.rest_height(JointRole::hip) == Approx(0.87));
    CHECK(same.rest_height(JointRole::hip) == Approx(87));
    const int knee = joint_of(JointRole::knee, Side::left), ankle = joint_of(JointRole::ankle, Side::left);
    CHECK(placement.rest_distance(knee, ankle) == Approx(0.7 * std::hypot(0.41, 0.02)).epsilon(1e-6));
    CHECK(same.rest_distance(knee, ankle) == Approx(placement.rest_distance(knee, ankle)).epsilon(1e-6));
}
