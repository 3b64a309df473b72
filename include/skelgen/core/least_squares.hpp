#pragma once

#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace skelgen::core {

/// Numbers whose residuals are as small as they get, and the sum of the squares of these.
template <typename Numbers>
struct LeastSquares {
    Numbers numbers;
    double cost = 0;
};

/// Brings `numbers`, a column vector, to where the sum of squared residuals is least nearby, by Levenberg and
/// Marquardt's method with differences for derivatives. `state_of(numbers, known)` says what residuals are reckoned
/// from; `known` is the state at numbers of which all but one are the same, to take over what that one does not move,
/// or none. `residuals_of(state, numbers)`: a vector of always the same size. Ends after so many rounds, or when a
/// round gains less than 1e-4 of the sum.
template <typename Numbers, typename StateOf, typename ResidualsOf>
[[nodiscard]] LeastSquares<Numbers> least_squares(Numbers numbers, int rounds, const StateOf& state_of,
                                                  const ResidualsOf& residuals_of) {
    constexpr double step = 1e-4, least_damping = 1e-6, most_damping = 1e6, least_gain = 1e-4;
    constexpr int count = Numbers::RowsAtCompileTime;
    using Square = Eigen::Matrix<double, count, count>;
    const auto anew = [&](const Numbers& at) {
        return state_of(at, static_cast<decltype(state_of(at, nullptr))*>(nullptr));
    };
    auto here = anew(numbers);
    Eigen::VectorXd residuals = residuals_of(here, numbers);
    double cost = residuals.squaredNorm(), damping = 1e-2;
    for (int round = 0; round < rounds; ++round) {
        Eigen::Matrix<double, Eigen::Dynamic, count> jacobian(residuals.size(), numbers.size());
        for (Eigen::Index k = 0; k < numbers.size(); ++k) {
            Numbers moved = numbers;
            moved[k] += step;
            jacobian.col(k) = (residuals_of(state_of(moved, &here), moved) - residuals) / step;
        }
        const Square normal = jacobian.transpose() * jacobian;
        const Numbers gradient = jacobian.transpose() * residuals;
        bool improved = false;
        while (!improved && damping < most_damping) {
            Square damped = normal;
            damped.diagonal() *= 1 + damping;
            const Numbers next = numbers - damped.ldlt().solve(gradient);
            auto there = anew(next);
            const Eigen::VectorXd residuals_there = residuals_of(there, next);
            improved = residuals_there.squaredNorm() < cost;
            damping = improved ? std::max(damping / 5, least_damping) : damping * 4;
            if (!improved) continue;
            const double gain = cost - residuals_there.squaredNorm();
            numbers = next;
            here = std::move(there);
            residuals = residuals_there;
            cost = residuals.squaredNorm();
            if (gain < least_gain * cost) return {numbers, cost};
        }
        if (!improved) break;
    }
    return {numbers, cost};
}

} // namespace skelgen::core
