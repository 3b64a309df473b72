#pragma once

#include <algorithm>
#include <type_traits>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace skelgen::core {

/// Residuals of so many numbers and the derivatives of these, summed to what a step needs.
template <int count>
struct NormalEquations {
    using Numbers = Eigen::Matrix<double, count, 1>;

    Eigen::Matrix<double, count, count> square = Eigen::Matrix<double, count, count>::Zero(); ///< of the derivatives
    Numbers gradient = Numbers::Zero(); ///< derivatives times residuals
    double cost = 0;                    ///< sum of the residuals' squares

    /// A residual that goes by one number alone.
    void add(double residual, Eigen::Index number, double derivative) {
        square(number, number) += derivative * derivative;
        gradient[number] += derivative * residual;
        cost += residual * residual;
    }
    /// Residuals, and per residual a row of derivatives by all numbers.
    template <typename Residuals, typename Derivatives>
    void add(const Residuals& residuals, const Derivatives& derivatives) {
        square.noalias() += derivatives.transpose() * derivatives;
        gradient.noalias() += derivatives.transpose() * residuals;
        cost += residuals.squaredNorm();
    }
};

/// What a function returns, a column of always the same size, by each of the numbers; by forward differences.
template <typename Numbers, typename ValuesOf>
[[nodiscard]] auto derivatives_of(const ValuesOf& values_of, const Numbers& at) {
    constexpr double step = 1e-6;
    const auto here = values_of(at);
    Eigen::Matrix<double, std::decay_t<decltype(here)>::RowsAtCompileTime, Numbers::RowsAtCompileTime> out(here.size(),
                                                                                                           at.size());
    for (Eigen::Index k = 0; k < at.size(); ++k) {
        Numbers moved = at;
        moved[k] += step;
        out.col(k) = (values_of(moved) - here) / step;
    }
    return out;
}

/// Numbers whose residuals are as small as they get, and the sum of the squares of these.
template <int count>
struct LeastSquares {
    Eigen::Matrix<double, count, 1> numbers;
    double cost = 0;
};

/// Brings numbers to where the sum of squared residuals is least nearby, by Levenberg and Marquardt's method.
/// `equations_of(numbers)`: the NormalEquations there. Ends after so many rounds, or when a round gains less than 1e-4
/// of the sum. O(count^3) for each step.
template <int count, typename EquationsOf>
[[nodiscard]] LeastSquares<count> least_squares(Eigen::Matrix<double, count, 1> numbers, int rounds,
                                                const EquationsOf& equations_of) {
    constexpr double least_damping = 1e-6, most_damping = 1e6, least_gain = 1e-4;
    NormalEquations<count> here = equations_of(numbers);
    double damping = 1e-2;
    for (int round = 0; round < rounds; ++round) {
        bool improved = false;
        while (!improved && damping < most_damping) {
            auto damped = here.square;
            damped.diagonal() *= 1 + damping;
            const Eigen::Matrix<double, count, 1> next = numbers - damped.ldlt().solve(here.gradient);
            NormalEquations<count> there = equations_of(next);
            improved = there.cost < here.cost;
            damping = improved ? std::max(damping / 5, least_damping) : damping * 4;
            if (!improved) continue;
            const double gain = here.cost - there.cost;
            numbers = next;
            here = std::move(there);
            if (gain < least_gain * here.cost) return {numbers, here.cost};
        }
        if (!improved) break;
    }
    return {numbers, here.cost};
}

} // namespace skelgen::core
