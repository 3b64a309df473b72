#pragma once

// The proportions of people and figures, which a body in any pose is held to.

#include <cstddef>

#include <Eigen/Cholesky>

#include <skelgen/search/laid_model.hpp>
#include <skelgen/search/proportions_table.hpp>

namespace skelgen::search::detail {

/// The logarithms of nine lengths and of the radii, in the order of proportions_table.hpp, beside the mean of the
/// lengths, so that they say nothing of size.
inline constexpr int lengths = 9;
using Proportions = Eigen::Matrix<double, proportion_count, 1>;
using Lengths = Eigen::Matrix<double, lengths, 1>;

/// Where joints are on the way from the end of a limb's bone to the next.
inline constexpr double shoulder_of_upper_arm = 0.08, hip_of_thigh = 0.07;
inline constexpr double wrist_of_forearm = (wrist_at - elbow_at) / (1 - elbow_at);

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
    [[nodiscard]] Eigen::Matrix<double, proportion_count - lengths, 1> radii_with(const Lengths& of) const {
        return mean_.tail<proportion_count - lengths>() + radii_by_lengths_ * (of - mean_.head<lengths>());
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
        const Eigen::Matrix<double, lengths, lengths> of_lengths = covariance.topLeftCorner<lengths, lengths>();
        radii_by_lengths_ =
            of_lengths.llt().solve(covariance.topRightCorner<lengths, proportion_count - lengths>()).transpose();
    }

    Proportions mean_;
    Eigen::LLT<Eigen::Matrix<double, proportion_count, proportion_count>> factor_;
    Eigen::Matrix<double, proportion_count - lengths, lengths> radii_by_lengths_;
};

} // namespace skelgen::search::detail
