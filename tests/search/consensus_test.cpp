// Where candidates together expect joints.

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/search/impl/consensus.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::search;
using namespace skelgen::test;

namespace {

Points<double> rows(std::initializer_list<Vector3<double>> places) {
    Points<double> out(static_cast<Eigen::Index>(places.size()), 3);
    Eigen::Index i = 0;
    for (const Vector3<double>& place : places) out.row(i++) = place.transpose();
    return out;
}

const SkeletonTemplate& whole_human() { return builtin_template("human21"); }

/// The joints of the template at rest, all moved by as much.
Points<double> rest(const Vector3<double>& by = Vector3<double>::Zero()) {
    Points<double> out(static_cast<Eigen::Index>(whole_human().joints.size()), 3);
    for (int j = 0; j < static_cast<int>(whole_human().joints.size()); ++j)
        out.row(j) = (whole_human().joint(j).position + by).transpose();
    return out;
}

Points<double> with_sides_exchanged(const Points<double>& skeleton) {
    Points<double> out = skeleton;
    for (int j = 0; j < static_cast<int>(whole_human().joints.size()); ++j)
        if (const int other = counterpart(whole_human(), j); other >= 0) out.row(j) = skeleton.row(other);
    return out;
}

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

} // namespace

TEST_CASE("a joint is expected where its distance from where it may be is least in the mean") {
    const Vector3<double> away(3, 1, -2);
    SECTION("in the middle of an even triangle") {
        const Points<double> corners = rows({{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}});
        const Vector3<double> middle = corners.colwise().mean().transpose();
        CHECK((expected_place(corners, {2, 2, 2}, away) - middle).norm() < 1e-6);
    }
    SECTION("at the middle one of three on a line, however far off the last one is") {
        CHECK((expected_place(rows({{0, 0, 0}, {1, 0, 0}, {9, 0, 0}}), {1, 1, 1}, {0, 0, 0}) - Vector3<double>::UnitX())
                  .norm() < 0.02);
    }
    SECTION("at the one that has more than half of the odds") {
        CHECK(expected_place(rows({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), {5, 2, 2}, {1, 1, 0}).norm() < 1e-3);
    }
    SECTION("whatever its units") {
        const Points<double> places = rows({{0, 0, 0}, {1, 0, 0}, {0.2, 0.9, 0}, {0.3, 0.1, 0.4}});
        const std::vector<double> odds{1, 2, 3, 4};
        const Vector3<double> small = expected_place(places, odds, {1, 1, 1});
        const Vector3<double> large = expected_place(1000 * places, odds, {1000, 1000, 1000});
        CHECK((large - 1000 * small).norm() < 1e-6);
    }
}

TEST_CASE("where no place has odds, or all are the start, the start remains") {
    const Vector3<double> start(1, 2, 3);
    CHECK(expected_place(rows({}), {}, start) == start);
    CHECK(expected_place(rows({start, start}), {1, 1}, start) == start);
    CHECK(expected_place(rows({{0, 0, 0}, {1, 0, 0}}), {0, 0}, start) == start);
}

TEST_CASE("skeletons that have left and right exchanged are told, and not heard") {
    const Points<double> own = rest(), moved = rest({0.01, 0, 0}), exchanged = with_sides_exchanged(rest({0.3, 0, 0}));
    CHECK(have_same_sides(own, moved, whole_human()));
    CHECK_FALSE(have_same_sides(own, exchanged, whole_human()));
    const Points<double> heard = expected_places({own, moved, exchanged}, {1, 3, 100}, 0, whole_human());
    CHECK((heard - moved).cwiseAbs().maxCoeff() < 1e-3);
    CHECK((expected_places({own, moved, exchanged}, {1, 3, 100}, 2, whole_human()) - exchanged).cwiseAbs().maxCoeff() <
          1e-6);
}

TEST_CASE("a joint that is absent stays so, and those that have it are not heard") {
    Points<double> lacking = rest();
    lacking.row(find_joint(whole_human(), JointRole::hand, Side::left)).setConstant(nothing);
    Points<double> lacks_it_too = lacking;
    lacks_it_too.array() += 0.02;
    const Points<double> whole = rest({0.1, 0, 0});
    CHECK(have_same_sides(lacking, whole, whole_human()));
    CHECK(have_same_joints(lacking, lacks_it_too));
    CHECK_FALSE(have_same_joints(lacking, whole));
    const Points<double> heard = expected_places({lacking, lacks_it_too, whole}, {1, 3, 100}, 0, whole_human());
    CHECK(have_same_joints(heard, lacking));
    CHECK((heard - lacks_it_too).topRows(6).cwiseAbs().maxCoeff() < 1e-3); // has most of the odds
    const Points<double> of_an_animal(0, 3);
    CHECK(expected_places({whole, of_an_animal}, {1, 9}, 0, whole_human()) == whole);
}
