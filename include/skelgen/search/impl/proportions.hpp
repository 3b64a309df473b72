#pragma once

// The proportions of people and figures, which a body in any pose is held to.

#include <cstddef>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <skelgen/search/proportions_table.hpp>

namespace skelgen::search::detail {

/// The logarithms of nine lengths and of the radii, in the order of proportions_table.hpp, beside the mean of the
/// lengths, so that they say nothing of size.
inline constexpr int length_count = 9;
using Proportions = Eigen::Matrix<double, proportion_count, 1>;
using Lengths = Eigen::Matrix<double, length_count, 1>;

/// A normal distribution, fitted to people and figures.
class ProportionsPrior {
public:
    static const ProportionsPrior& get() {
        static const ProportionsPrior prior;
        return prior;
    }

    /// How far off the mean proportions are, in standard deviations that are independent of each other.
    [[nodiscard]] Proportions deviations(const Proportions& of) const { return factor_.matrixL().solve(of - mean_); }

    /// The likeliest radii with these lengths.
    [[nodiscard]] Eigen::Matrix<double, proportion_count - length_count, 1> radii_with(const Lengths& of) const {
        return mean_.tail<proportion_count - length_count>() + radii_by_lengths_ * (of - mean_.head<length_count>());
    }

private:
    ProportionsPrior() {
        Eigen::Matrix<double, proportion_count, proportion_count> covariance;
        std::size_t next = 0;
        for (int i = 0; i < proportion_count; ++i) {
            mean_[i] = proportion_means[static_cast<std::size_t>(i)];
            for (int j = 0; j <= i; ++j) covariance(i, j) = covariance(j, i) = proportion_covariance[next++];
        }
        factor_.compute(covariance);
        const Eigen::Matrix<double, length_count, length_count> of_lengths =
            covariance.topLeftCorner<length_count, length_count>();
        radii_by_lengths_ = of_lengths.llt()
                                .solve(covariance.topRightCorner<length_count, proportion_count - length_count>())
                                .transpose();
    }

    Proportions mean_;
    Eigen::LLT<Eigen::Matrix<double, proportion_count, proportion_count>> factor_;
    Eigen::Matrix<double, proportion_count - length_count, length_count> radii_by_lengths_;
};

} // namespace skelgen::search::detail
