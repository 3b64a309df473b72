// Least squares against closed forms.

#include <cmath>

#include <Eigen/Core>
#include <Eigen/QR>

#include <skelgen/core/least_squares.hpp>

#include "catch.hpp"

using namespace skelgen;

namespace {

/// Residuals by their values alone: derivatives are differences.
template <int count, typename ResidualsOf>
core::LeastSquares<count> solved(const Eigen::Matrix<double, count, 1>& start, int rounds,
                                 const ResidualsOf& residuals_of) {
    return core::least_squares(start, rounds, [&](const Eigen::Matrix<double, count, 1>& at) {
        core::NormalEquations<count> out;
        out.add(residuals_of(at), core::derivatives_of(residuals_of, at));
        return out;
    });
}

} // namespace

TEST_CASE("least_squares: a linear system's is that of its normal equations") {
    Eigen::MatrixXd matrix(4, 2);
    matrix << 1, 2, 3, -1, 0.5, 4, -2, 1;
    const Eigen::Vector4d wanted(1, -2, 0.3, 5);
    const Eigen::Vector2d exact = matrix.colPivHouseholderQr().solve(wanted);
    const auto residuals_of = [&](const Eigen::Vector2d& x) -> Eigen::Vector4d { return matrix * x - wanted; };
    const auto fixed = solved(Eigen::Vector2d(7, -9), 40, residuals_of);
    CHECK((fixed.numbers - exact).norm() < 1e-4);
    CHECK(fixed.cost == Approx((matrix * exact - wanted).squaredNorm()).epsilon(1e-6));
}

TEST_CASE("least_squares: goes down Rosenbrock's valley, and without rounds stays") {
    const auto rosenbrock = [](const Eigen::Vector2d& x) -> Eigen::Vector2d {
        return {1 - x[0], 10 * (x[1] - x[0] * x[0])};
    };
    const Eigen::Vector2d start(-1.2, 1);
    const auto found = solved(start, 200, rosenbrock);
    CHECK((found.numbers - Eigen::Vector2d(1, 1)).norm() < 1e-2);
    CHECK(found.cost < 1e-6);
    const auto none = solved(start, 0, rosenbrock);
    CHECK(none.numbers == start);
    CHECK(none.cost == Approx(rosenbrock(start).squaredNorm()));
}

TEST_CASE("least_squares: residuals that go by one number each are solved one by one") {
    const Eigen::Vector3d wanted(1, -2, 5);
    const auto found = core::least_squares(Eigen::Vector3d(0, 0, 0), 40, [&](const Eigen::Vector3d& at) {
        core::NormalEquations<3> out;
        for (Eigen::Index k = 0; k < 3; ++k) out.add(2 * (at[k] - wanted[k]), k, 2);
        return out;
    });
    CHECK((found.numbers - wanted).norm() < 1e-4);
    CHECK(found.cost < 1e-6);
}

TEST_CASE("derivatives_of: a polynomial's are its own") {
    const auto values_of = [](const Eigen::Vector2d& x) -> Eigen::Vector3d {
        return {x[0] * x[1], x[0] * x[0], 3 * x[1]};
    };
    Eigen::Matrix<double, 3, 2> exact;
    exact << 5, 2, 4, 0, 0, 3;
    CHECK((core::derivatives_of(values_of, Eigen::Vector2d(2, 5)) - exact).norm() < 1e-5);
}
