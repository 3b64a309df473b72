#include <cmath>
#include <optional>
#include <vector>

#include <skelgen/refinement/profile_matcher.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::refinement;

namespace {

/// Samples of a limb that has just that profile, stretched, `stoutness` times as thick.
template <typename Scalar>
std::vector<Sample<Scalar>> samples_of(const Profile& profile, const Stretch<Scalar>& stretch, double log_stoutness) {
    std::vector<Sample<Scalar>> samples;
    for (int i = 0; i < 100; ++i) {
        const Scalar from_tip = stretch.inner * static_cast<Scalar>(i) / 100;
        if (const auto value = value_at(profile, stretch.u(from_tip)))
            samples.push_back({from_tip, *value + static_cast<Scalar>(log_stoutness)});
    }
    return samples;
}

} // namespace

TEMPLATE_TEST_CASE("a limb's coordinate is -1 at the tip, 0, 1 and 2 at its joints, and linear between", "", float,
                   double) {
    const Stretch<TestType> s{TestType(0.2), TestType(0.6), TestType(1.1)};
    for (const auto& [from_tip, u] :
         {std::pair(0.0, -1.0), {0.1, -0.5}, {0.2, 0.0}, {0.4, 0.5}, {0.6, 1.0}, {0.85, 1.5}, {1.1, 2.0}, {1.6, 3.0}})
        CHECK(s.u(static_cast<TestType>(from_tip)) == Approx(u).margin(1e-6));
}

TEMPLATE_TEST_CASE("a profile is linear between its entries and nothing beyond them", "", float, double) {
    for (std::size_t i = 0; i + 1 < leg_profile.size(); ++i) {
        const double u = -0.6 + 0.1 * (static_cast<double>(i) + 0.5);
        const auto value = value_at(leg_profile, static_cast<TestType>(u));
        REQUIRE(value);
        CHECK(*value == Approx((leg_profile[i] + leg_profile[i + 1]) / 2).margin(1e-6));
    }
    CHECK(*value_at(arm_profile, TestType(-0.6)) == Approx(arm_profile.front()));
    CHECK_FALSE(value_at(leg_profile, TestType(-0.601)));
    CHECK_FALSE(value_at(leg_profile, TestType(1.601)));
}

TEMPLATE_TEST_CASE(
    "a limb that is the profile fits it, whatever its stoutness; folds cost no more than three deviations", "", float,
    double) {
    const Stretch<TestType> s{TestType(0.2), TestType(0.6), TestType(1.1)};
    auto samples = samples_of(arm_profile, s, -2.5);
    const auto exact = fit_profile(samples, arm_profile, s, TestType(0.07));
    CHECK(exact.misfit < 1e-6);
    CHECK(exact.stoutness == Approx(-2.5));
    for (std::size_t i = 40; i < 44; ++i) samples[i].log_thickness += 3; // a fold
    const auto folded = fit_profile(samples, arm_profile, s, TestType(0.07));
    CHECK(folded.stoutness == Approx(-2.5).margin(0.02));
    CHECK(folded.misfit < 4 * worst_misfit / 60);
    CHECK(fit_profile(std::vector<Sample<TestType>>{}, arm_profile, s, TestType(0.07)).misfit == worst_misfit);
    CHECK(fit_profile(std::vector<Sample<TestType>>{}, arm_profile, s, TestType(0.07)).stoutness == 0);
}

TEMPLATE_TEST_CASE("the joints of a limb that is the profile are found where they are", "", float, double) {
    const Stretch<TestType> rest{TestType(0.2), TestType(0.6), TestType(1.1)};
    for (const double longer : {0.95, 1.0, 1.06}) {
        const auto k = static_cast<TestType>(longer);
        const Stretch<TestType> own{rest.outer, rest.outer + k * (rest.middle - rest.outer),
                                    rest.outer + k * (rest.inner - rest.outer)};
        const std::vector<MatchedLimb<TestType>> limbs{{samples_of(leg_profile, own, -3), rest, std::nullopt}};
        const auto found = best_stretches(limbs, leg_profile, {});
        REQUIRE(found.size() == 1);
        // Between the template's proportions and the thickness: at least three quarters of the way, as a grid finds it.
        CHECK(found[0].middle == Approx(rest.middle + 0.9 * (own.middle - rest.middle)).margin(0.006));
        CHECK(found[0].outer == Approx(0.2).margin(0.012));
    }
    CHECK(best_stretches(std::vector<MatchedLimb<TestType>>{}, leg_profile, {}).empty());
}

TEST_CASE("the ankle of a figure with large feet is found by the heel and the profile, not by a person's lengths") {
    const Stretch<double> rest{0.2, 0.6, 1.1}, own{0.32, 0.58, 0.9};
    const std::optional<Heel<double>> heel = Heel<double>{0.32 * std::exp(-0.13), 1};
    const auto ankle_of = [&](std::optional<Heel<double>> seen, bool is_adapted) {
        return best_stretches<double>({{samples_of(leg_profile, own, -3), rest, std::nullopt, seen, is_adapted}},
                                      leg_profile, {})[0]
            .outer;
    };
    CHECK(ankle_of(heel, true) == Approx(own.outer).epsilon(0.05));
    CHECK(std::abs(ankle_of(std::nullopt, false) - own.outer) > 0.02);
    CHECK(std::abs(ankle_of(heel, true) - own.outer) <= std::abs(ankle_of(std::nullopt, true) - own.outer));
    // A heel that is not where the rest of the leg has the ankle at all says little.
    const Stretch<double> like_rest = rest;
    const std::vector<MatchedLimb<double>> shoe{
        {samples_of(leg_profile, like_rest, -3), rest, std::nullopt, Heel<double>{0.5, 1}, true}};
    CHECK(best_stretches(shoe, leg_profile, {})[0].outer == Approx(0.2).epsilon(0.1));
}

TEST_CASE("a limb that is a little longer is found a little longer, without steps") {
    const Stretch<double> rest{0.2, 0.6, 1.1};
    const auto found_for = [&](double longer) {
        const Stretch<double> own{rest.outer * longer, rest.middle * longer, rest.inner * longer};
        return best_stretches<double>({{samples_of(leg_profile, own, -3), rest, std::nullopt}}, leg_profile, {})[0];
    };
    Stretch<double> before = found_for(1);
    for (int i = 1; i <= 40; ++i) {
        const Stretch<double> here = found_for(1 + 0.0005 * i);
        INFO("longer by " << 0.0005 * i);
        CHECK(std::abs(here.middle - before.middle) < 0.0012); // a step of the grid is 0.003
        before = here;
    }
}

TEST_CASE("the fork of stout legs tells less of where they begin") {
    const Top<double> top{1.1, 0.03};
    const Stretch<double> s{0.2, 0.6, 1.1};
    CHECK(deviation_of(top, std::log(0.13 * 0.4), s) == Approx(0.03));
    CHECK(deviation_of(top, std::log(0.10 * 0.4), s) == Approx(0.03));
    CHECK(deviation_of(top, std::log(0.15 * 0.4), s) == Approx(0.03 + 5 * 0.02));
    CHECK(deviation_of({1.1, 0.03, BodyPart::arm}, std::log(0.15 * 0.4), s) == Approx(0.03)); // arms do not touch
}
