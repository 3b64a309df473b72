// Bodies in any pose, laid into their surface.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/search/impl/proportions.hpp>
#include <skelgen/search/posed_fit.hpp>
#include <skelgen/surface/body.hpp>

#include "catch.hpp"
#include "fixture_bodies.hpp"

using namespace skelgen;
using namespace skelgen::search;
using namespace skelgen::test;

namespace {

const SkeletonTemplate& person() { return builtin_template("human21"); }

/// The joints that a body has, in its canonical form.
Points<double> true_joints(const FixtureBody& known, const Body<double>& body) {
    Points<double> out(static_cast<Eigen::Index>(person().joints.size()), 3);
    for (std::size_t j = 0; j < person().joints.size(); ++j)
        out.row(static_cast<Eigen::Index>(j)) =
            body.similarity.to_canonical(Vec3(known.truth.joints.at(j).second)).transpose();
    return out;
}

double mean_error(const Points<double>& joints, const Points<double>& truth) {
    return (joints - truth).rowwise().norm().mean();
}

} // namespace

TEST_CASE("standing_starts: bodies as high as the surface, along every axis, left on the left; none of an animal") {
    const Body<double> body = prepare(load_fixture_body("standing-man").mesh);
    const auto starts = standing_starts(body, person());
    REQUIRE(starts.size() == 216);
    const Eigen::RowVector3d extent = body.mesh.vertices.colwise().maxCoeff() - body.mesh.vertices.colwise().minCoeff();
    const auto joint = [](JointRole role, Side side) { return find_joint(person(), role, side); };
    for (const Points<double>& start : starts) {
        const Vec3 up = (start.row(joint(JointRole::neck, Side::none)) - start.row(0)).transpose().normalized();
        const Vec3 ahead =
            (start.row(joint(JointRole::foot, Side::left)) - start.row(joint(JointRole::ankle, Side::left)))
                .transpose();
        const Vec3 left =
            (start.row(joint(JointRole::hip, Side::left)) - start.row(joint(JointRole::hip, Side::right))).transpose();
        CHECK(up.cross(ahead - up.dot(ahead) * up).dot(left) >= -1e-12);
        const double height = extent.cwiseProduct(up.cwiseAbs().transpose()).sum();
        const double reach =
            (start.row(joint(JointRole::head, Side::none)) - start.row(joint(JointRole::foot, Side::left)))
                .dot(up.transpose());
        CHECK(reach < height);
        CHECK(reach > 0.6 * height);
    }
    CHECK(standing_starts(body, builtin_template("quadruped")).empty());
    SkeletonTemplate with_tail = person(); // the model has none
    with_tail.joints.push_back(with_tail.joints.front());
    with_tail.joints.back().role = JointRole::tail;
    CHECK(standing_starts(body, with_tail).empty());
}

TEST_CASE("fit_posed: from joints that are off, the surface brings them nearer to where they are") {
    for (const char* name : {"standing-man", "figure"}) {
        INFO(name);
        const FixtureBody known = load_fixture_body(name);
        const Body<double> body = prepare(known.mesh);
        const double size = core::bounding_diagonal(body.mesh.vertices);
        const Points<double> truth = true_joints(known, body);
        Points<double> off = truth;
        for (int j = 0; j < static_cast<int>(off.rows()); ++j)
            off.row(j) += 0.04 * size * Eigen::RowVector3d(j % 3 - 1.0, (j + 1) % 3 - 1.0, j % 2 - 0.5);
        const auto fits = fit_posed(body, person(), {off});
        REQUIRE(fits.size() == 1);
        CHECK(std::is_sorted(fits.begin(), fits.end(),
                             [](const PosedFit& a, const PosedFit& b) { return a.cost < b.cost; }));
        CHECK(mean_error(fits.front().joints, truth) < 0.7 * mean_error(off, truth));
        CHECK(fit_posed(body, person(), {off}).front().joints == fits.front().joints);
    }
}

TEST_CASE("fit_posed: limbs end beyond their joints, and the template has the lengths that were found") {
    const FixtureBody known = load_fixture_body("standing-man");
    const Body<double> body = prepare(known.mesh);
    const PosedFit fit = fit_posed(body, person(), {true_joints(known, body)}).front();
    REQUIRE(fit.tips.size() == 5);
    const auto at = [&](JointRole role, Side side) -> Vec3 {
        return fit.joints.row(find_joint(person(), role, side)).transpose();
    };
    for (const auto& [joint, tip] : fit.tips) {
        const TemplateJoint& end = person().joint(joint);
        const Vec3 last = fit.joints.row(joint).transpose(), before = fit.joints.row(end.parent).transpose();
        INFO(end.name);
        CHECK((tip - before).norm() >= (last - before).norm() - 1e-9);
    }
    const auto& found = fit.skeleton_template;
    const auto length_in = [&](const SkeletonTemplate& one, JointRole from, JointRole to) {
        return (one.joint(find_joint(one, to, Side::left)).position -
                one.joint(find_joint(one, from, Side::left)).position)
            .norm();
    };
    const auto trunk_of = [](const SkeletonTemplate& one) {
        return (one.joint(find_joint(one, JointRole::neck, Side::none)).position - one.joint(0).position).norm();
    };
    const double leg = (at(JointRole::knee, Side::left) - at(JointRole::hip, Side::left)).norm() +
                       (at(JointRole::ankle, Side::left) - at(JointRole::knee, Side::left)).norm();
    const double trunk = (at(JointRole::neck, Side::none) - fit.joints.row(0).transpose()).norm();
    const double leg_in_template =
        length_in(found, JointRole::hip, JointRole::knee) + length_in(found, JointRole::knee, JointRole::ankle);
    CHECK(leg_in_template / trunk_of(found) == Approx(leg / trunk).epsilon(0.1));
}

TEST_CASE("fit_posed: what is known is met, the cheapest of several starts comes first, and no start has no fit") {
    const FixtureBody known = load_fixture_body("standing-man");
    const Body<double> body = prepare(known.mesh);
    const double size = core::bounding_diagonal(body.mesh.vertices);
    const Points<double> truth = true_joints(known, body);
    Points<double> turned = truth; // head down
    turned.col(0) = -truth.col(0).array() + truth.col(0).minCoeff() + truth.col(0).maxCoeff();
    const int elbow = find_joint(person(), JointRole::elbow, Side::left);
    const Vec3 place = truth.row(elbow).transpose() + Vec3::Constant(0.01 * size);
    const auto fits = fit_posed(body, person(), {turned, truth}, {{elbow, place}});
    REQUIRE(fits.size() == 2);
    CHECK(fits.front().start == 1);
    CHECK((fits.front().joints.row(elbow).transpose() - place).norm() < 0.005 * size);
    CHECK(mean_error(fits.front().joints, truth) < 0.03 * size);
    CHECK(fit_posed(body, person(), {}).empty());
    CHECK(fit_posed(body, builtin_template("quadruped"), {truth}).empty());
}

TEST_CASE("proportions: a body's own are its lengths and radii, whatever its size; radii follow from lengths") {
    const FixtureBody known = load_fixture_body("standing-man");
    const Body<double> body = prepare(known.mesh);
    const PosedFit fit = fit_posed(body, person(), {true_joints(known, body)}).front();
    REQUIRE(fit.proportions.size() == search::detail::proportion_count);
    double sum = 0;
    for (int i = 0; i < search::detail::length_count; ++i) sum += fit.proportions[static_cast<std::size_t>(i)];
    CHECK(sum == Approx(0).margin(1e-9));
    for (const double proportion : fit.proportions) CHECK(std::abs(proportion) < 4);

    const auto& prior = search::detail::ProportionsPrior::get();
    const search::detail::Lengths mean =
        Eigen::Map<const search::detail::Lengths>(search::detail::proportion_means.data());
    for (int i = search::detail::length_count; i < search::detail::proportion_count; ++i)
        CHECK(prior.radii_with(mean)[i - search::detail::length_count] ==
              Approx(search::detail::proportion_means[static_cast<std::size_t>(i)]).margin(1e-12));
}

TEST_CASE("proportions: deviations are of unit variance, so that the mean of their squares over the table's is one") {
    const auto& prior = search::detail::ProportionsPrior::get();
    search::detail::Proportions mean;
    for (int i = 0; i < search::detail::proportion_count; ++i)
        mean[i] = search::detail::proportion_means[static_cast<std::size_t>(i)];
    CHECK(prior.deviations(mean).norm() == Approx(0).margin(1e-12));
    // One row of the covariance's root added to the mean is one deviation off.
    Eigen::Matrix<double, search::detail::proportion_count, search::detail::proportion_count> covariance;
    std::size_t next = 0;
    for (int i = 0; i < search::detail::proportion_count; ++i)
        for (int j = 0; j <= i; ++j)
            covariance(i, j) = covariance(j, i) = search::detail::proportion_covariance[next++];
    const Eigen::SelfAdjointEigenSolver<decltype(covariance)> axes(covariance);
    CHECK(axes.eigenvalues().minCoeff() > 0);
    for (int k = 0; k < search::detail::proportion_count; ++k)
        CHECK(prior.deviations(mean + std::sqrt(axes.eigenvalues()[k]) * axes.eigenvectors().col(k)).norm() ==
              Approx(1).epsilon(1e-6));
}
