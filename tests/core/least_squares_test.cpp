// Least squares against closed forms.

#include <cmath>

#include <Eigen/Core>
#include <Eigen/QR>

#include <skelgen/core/least_squares.hpp>

#include "catch.hpp"

using namespace skelgen;

namespace {

/// Without a state to take over: residuals of the numbers alone.
template <typename Numbers, typename ResidualsOf>
core::LeastSquares<Numbers> solved(const Numbers& start, int rounds, const ResidualsOf& residuals_of) {
    return core::least_squares(
        start, rounds, [](const Numbers& at, const Numbers*) { return at; },
        [&](const Numbers& state, const Numbers&) -> Eigen::VectorXd { return residuals_of(state); });
}

} // namespace

TEST_CASE("least_squares: a linear system's is that of its normal equations, of fixed and of any size") {
    Eigen::MatrixXd matrix(4, 2);
    matrix << 1, 2, 3, -1, 0.5, 4, -2, 1;
    const Eigen::Vector4d wanted(1, -2, 0.3, 5);
    const Eigen::Vector2d exact = matrix.colPivHouseholderQr().solve(wanted);
    const auto residuals_of = [&](const auto& x) -> Eigen::VectorXd { return matrix * x - wanted; };
    const auto fixed = solved(Eigen::Vector2d(7, -9), 40, residuals_of);
    CHECK((fixed.numbers - exact).norm() < 1e-4);
    CHECK(fixed.cost == Approx((matrix * exact - wanted).squaredNorm()).epsilon(1e-6));
    const Eigen::VectorXd start = Eigen::Vector2d(7, -9);
    CHECK((solved(start, 40, residuals_of).numbers - exact).norm() < 1e-4);
}

TEST_CASE("least_squares: goes down Rosenbrock's valley, and without rounds stays") {
    const auto rosenbrock = [](const Eigen::Vector2d& x) -> Eigen::VectorXd {
        return Eigen::Vector2d(1 - x[0], 10 * (x[1] - x[0] * x[0]));
    };
    const Eigen::Vector2d start(-1.2, 1);
    const auto found = solved(start, 200, rosenbrock);
    CHECK((found.numbers - Eigen::Vector2d(1, 1)).norm() < 1e-2);
    CHECK(found.cost < 1e-6);
    const auto none = solved(start, 0, rosenbrock);
    CHECK(none.numbers == start);
    CHECK(none.cost == Approx(rosenbrock(start).squaredNorm()));
}

TEST_CASE("least_squares: what a number does not move is taken over from the state that is known") {
    int reckoned = 0;
    const auto state_of = [&](const Eigen::Vector2d& at, const Eigen::Vector2d* known) -> Eigen::Vector2d {
        Eigen::Vector2d out;
        for (int k = 0; k < 2; ++k) {
            const bool is_same = known && std::sqrt(std::abs((*known)[k])) == at[k];
            reckoned += is_same ? 0 : 1;
            out[k] = is_same ? (*known)[k] : at[k] * at[k];
        }
        return out;
    };
    const auto found = core::least_squares(Eigen::Vector2d(3, 2), 1, state_of,
                                           [](const Eigen::Vector2d& state, const Eigen::Vector2d&) -> Eigen::VectorXd {
                                               return state - Eigen::Vector2d(4, 9);
                                           });
    CHECK(found.cost < 50);       // 25 + 25 at the start
    CHECK(reckoned == 2 + 2 + 2); // at the start, one for each derivative, where it came to
}
