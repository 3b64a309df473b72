#include <skelgen/hands/impl/phalanx_fit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "shapes.hpp"

using namespace skelgen;
using skelgen::test::Vec3;

namespace {

constexpr double radius = 0.1;

/// The joints of a digit that bends by as many radians at each, and the centre of its end.
std::vector<Vec3> bent(double by) {
    constexpr std::array<double, 3> lengths{0.8, 0.55, 0.4};
    std::vector<Vec3> places{Vec3(0, 0, 0)};
    for (std::size_t k = 0; k < lengths.size(); ++k) {
        const double angle = static_cast<double>(k) * by;
        places.push_back(places.back() + lengths[k] * Vec3(std::cos(angle), -std::sin(angle), 0));
    }
    return places;
}

/// Its surface beyond the web, which is on the first phalanx.
template <typename Scalar>
hands::DigitTube<Scalar> tube_along(const std::vector<Vec3>& places) {
    constexpr int around = 24, along = 60;
    constexpr double web = 0.4; // of the first phalanx
    hands::DigitTube<Scalar> tube;
    const auto add = [&](const Vec3& p) {
        for (std::size_t k = 0; k + 1 < places.size(); ++k) { // not what is inside another phalanx
            const Vec3 bone = places[k + 1] - places[k];
            const double t = std::clamp(bone.dot(p - places[k]) / bone.squaredNorm(), 0.0, 1.0);
            if ((p - places[k] - t * bone).norm() < radius * (1 - 1e-9)) return;
        }
        tube.points.push_back(p.cast<Scalar>());
        tube.areas.push_back(1);
    };
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
        const Vec3 bone = places[k + 1] - places[k], up = Vec3::UnitZ(), side = bone.normalized().cross(up);
        for (int i = 0; i < along; ++i)
            for (int j = 0; j < around; ++j) {
                const double t = (i + 0.5) / along, angle = 2 * std::numbers::pi * j / around;
                if (k == 0 && t < web) continue;
                add(places[k] + t * bone + radius * (std::cos(angle) * up + std::sin(angle) * side));
            }
    }
    const Vec3 last = (places[3] - places[2]).normalized(), side = last.cross(Vec3::UnitZ());
    for (int i = 1; i <= around / 4; ++i) // the half ball at its end
        for (int j = 0; j < around; ++j) {
            const double height = 2 * std::numbers::pi * i / around, angle = 2 * std::numbers::pi * j / around;
            add(places[3] + radius * (std::sin(height) * last +
                                      std::cos(height) * (std::cos(angle) * Vec3::UnitZ() + std::sin(angle) * side)));
        }
    const Vec3 base = places[0] + web * (places[1] - places[0]), end = places[3] + radius * last;
    for (const Vec3& p : {base, places[1], places[2], end}) tube.axis.push_back(p.cast<Scalar>());
    return tube;
}

template <typename Scalar>
hands::PhalanxChain<Scalar> chain_along(const std::vector<Vec3>& places) {
    hands::PhalanxChain<Scalar> chain;
    for (const Vec3& p : places) {
        chain.places.push_back(p.cast<Scalar>());
        chain.radii.push_back(static_cast<Scalar>(0.8 * radius));
    }
    return chain;
}

template <typename Scalar>
hands::ExpectedPhalanges<Scalar> others() {
    return {{Scalar(0.38), Scalar(0.32), Scalar(0.30)}, Scalar(1.7)};
}

} // namespace

TEMPLATE_TEST_CASE("a bent digit's joints are where it bends, whatever is expected", "[hands]", float, double) {
    const std::vector<Vec3> places = bent(0.7);
    std::vector<Vec3> before = places; // as an axis that cuts corners has them, and too far out
    for (Vec3& p : before) p += Vec3(0.03, -0.05, 0.01);
    const auto found =
        hands::fit_phalanges<TestType>(tube_along<TestType>(places), chain_along<TestType>(before), others<TestType>());
    REQUIRE(found.places.size() == places.size());
    for (std::size_t k = 1; k < places.size(); ++k) {
        CHECK((found.places[k].template cast<double>() - places[k]).norm() < 0.03);
        CHECK(std::abs(static_cast<double>(found.radii[k]) - radius) < 0.01);
    }
    CHECK((found.places[0].template cast<double>() - places[0]).norm() < 0.2); // behind the web, as expected
}

TEST_CASE("of a straight digit what is expected tells the joints", "[hands]") {
    const std::vector<Vec3> places = bent(0);
    const auto found =
        hands::fit_phalanges<double>(tube_along<double>(places), chain_along<double>(places), others<double>());
    const double first = (found.places[1] - found.places[0]).norm(),
                 middle = (found.places[2] - found.places[1]).norm();
    CHECK(std::abs(first / middle - 0.38 / 0.32) < 0.05);
    for (const Vec3& p : found.places) CHECK(std::hypot(p.y(), p.z()) < 0.005);
    CHECK((found.places[3] - places[3]).norm() < 0.01);
}

TEST_CASE("a digit of too few points stays as it is", "[hands]") {
    hands::DigitTube<double> tube;
    tube.axis = {Vec3(0, 0, 0), Vec3(1, 0, 0)};
    tube.points = {Vec3(0, radius, 0), Vec3(1, radius, 0)};
    tube.areas = {1, 1};
    const auto chain = chain_along<double>(bent(0.5));
    CHECK(hands::fit_phalanges<double>(tube, chain, others<double>()).places == chain.places);
}
