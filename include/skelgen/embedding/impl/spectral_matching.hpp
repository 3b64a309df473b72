#pragma once

#include <skelgen/embedding/spectral_matching.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <skelgen/core/options.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::embedding {
namespace detail {

template <typename Scalar>
using DenseMatrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

template <typename Scalar>
using DenseVector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// Mean distance from each node to the others.
template <typename Scalar>
DenseVector<Scalar> mean_distances(const DenseMatrix<Scalar>& distances) {
    return distances.rowwise().sum() / static_cast<Scalar>(std::max<Eigen::Index>(distances.rows() - 1, 1));
}

/// Of a symmetric matrix without negative entries, none of them negative either (Perron and Frobenius), by power
/// iteration, as LH05 finds it: affinities are so much alike that few iterations do. As good as it is found where they
/// do not.
template <typename Scalar>
DenseVector<Scalar> leading_eigenvector(const DenseMatrix<Scalar>& matrix) {
    constexpr double most_products = 2e8; // tenths of a second; registered bodies need a hundred thousand
    const int most_iterations = std::max(100, static_cast<int>(most_products / static_cast<double>(matrix.size())));
    constexpr Scalar tolerance = 4096 * std::numeric_limits<Scalar>::epsilon(); // about 1e-12 in double
    // From a start that favours no pair: a left and a right limb that match equally well keep equal entries.
    const Eigen::Index n = matrix.rows();
    DenseVector<Scalar> vector = DenseVector<Scalar>::Constant(n, 1 / std::sqrt(static_cast<Scalar>(n)));
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        DenseVector<Scalar> next = DenseVector<Scalar>::Zero(n);
        for (Eigen::Index k = 0; k < n; ++k)
            for (Eigen::Index i = 0; i < n; ++i) next[i] += matrix(i, k) * vector[k];
        const Scalar length = next.norm();
        Scalar change = 0;
        for (Eigen::Index i = 0; i < n; ++i) {
            if (length > 0) next[i] /= length;
            change = std::max(change, std::abs(next[i] - vector[i]));
        }
        vector.swap(next);
        if (change <= tolerance) return vector;
    }
    return vector;
}

template <typename Scalar>
Scalar square(Scalar x) {
    return x * x;
}

/// What curve node `i` for template node `j` adds to the distortion by itself.
template <typename Scalar>
Scalar node_distortion(const ReducedGraph<Scalar>& curve, const ReducedGraph<Scalar>& skeleton_template, int i, int j,
                       const MatchingOptions& options) {
    const auto degree_cost = static_cast<Scalar>(options.degree_cost);
    const auto radius_cost = static_cast<Scalar>(options.radius_cost);
    const auto degrees = static_cast<Scalar>(curve.degree[at(i)] - skeleton_template.degree[at(j)]);
    const bool only_one_is_end = (curve.degree[at(i)] == 1) != (skeleton_template.degree[at(j)] == 1);
    const Scalar radius = curve.radius[at(i)], rest_radius = skeleton_template.radius[at(j)];
    return square(degree_cost * degrees) +
           (only_one_is_end ? square(static_cast<Scalar>(options.end_cost)) : Scalar(0)) +
           (radius > 0 && rest_radius > 0 ? square(radius_cost * (radius - rest_radius)) : Scalar(0));
}

/// What two assigned pairs (i, j) and (k, l) add by the distance between them.
template <typename Scalar>
Scalar pair_distortion(const ReducedGraph<Scalar>& curve, const ReducedGraph<Scalar>& skeleton_template, int i, int j,
                       int k, int l) {
    return square(curve.distances(i, k) - skeleton_template.distances(j, l));
}

/// Exchanging a left limb for a right one gains nothing but rounding; the distortion has no unit.
template <typename Scalar>
Scalar least_gain() {
    return core::rounding<Scalar>();
}

/// Depth-first search through all assignments, leaving out what cannot become less distorted than the best one known:
/// what is assigned already and, for each template node that is not, the partner that adds least to it.
template <typename Scalar>
class BranchAndBound {
public:
    BranchAndBound(const ReducedGraph<Scalar>& curve, const ReducedGraph<Scalar>& skeleton_template,
                   std::vector<int> start, const MatchingOptions& options)
        : curve_(curve), template_(skeleton_template), partner_(start.size(), -1), taken_(curve.degree.size(), false),
          order_(start.size()), left_(most_trials_per_node * static_cast<std::ptrdiff_t>(curve.degree.size())),
          least_(distortion(curve, skeleton_template, start, options)), best_(std::move(start)) {
        std::iota(order_.begin(), order_.end(), 0);
        std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) {
            return skeleton_template.degree[at(a)] > skeleton_template.degree[at(b)];
        });
        const auto n = static_cast<int>(order_.size()), m = static_cast<int>(taken_.size());
        added_.assign(order_.size() + 1, DenseMatrix<Scalar>::Zero(m, n));
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < m; ++i) added_[0](i, j) = node_distortion(curve, skeleton_template, i, j, options);
    }

    Assignment run() {
        extend(0, Scalar(0));
        return {std::move(best_), left_ > 0};
    }

private:
    /// Calibrated: the curves of registered bodies need up to a dozen trials for each of their nodes.
    static constexpr std::ptrdiff_t most_trials_per_node = 500;

    /// The least that the template nodes from `depth` on add.
    [[nodiscard]] Scalar least_to_come(std::size_t depth) const {
        Scalar sum = 0;
        for (std::size_t d = depth; d < order_.size(); ++d) {
            Scalar least = std::numeric_limits<Scalar>::infinity();
            for (std::size_t i = 0; i < taken_.size(); ++i)
                if (!taken_[i]) least = std::min(least, added_[depth](static_cast<Eigen::Index>(i), order_[d]));
            sum += least;
        }
        return sum;
    }

    void extend(std::size_t depth, Scalar total) {
        if (total > least_ - least_gain<Scalar>()) return;
        if (depth == order_.size()) {
            least_ = total;
            best_ = partner_;
            return;
        }
        if (total + least_to_come(depth) > least_) return; // by more than rounding
        const int j = order_[depth];
        for (int i = 0; i < static_cast<int>(taken_.size()); ++i) {
            if (taken_[at(i)]) continue;
            if (left_ == 0) break;
            --left_;
            const Scalar longer = total + added_[depth](i, j);
            if (longer > least_) continue;
            assign(depth, i);
            extend(depth + 1, longer);
            taken_[at(i)] = false;
        }
        partner_[at(j)] = -1;
    }

    /// The template node at this depth gets a partner, which adds to what all later ones would add.
    void assign(std::size_t depth, int i) {
        const int j = order_[depth];
        taken_[at(i)] = true;
        partner_[at(j)] = i;
        for (std::size_t d = depth + 1; d < order_.size(); ++d)
            for (int k = 0; k < static_cast<int>(taken_.size()); ++k)
                added_[depth + 1](k, order_[d]) =
                    added_[depth](k, order_[d]) + pair_distortion(curve_, template_, k, order_[d], i, j);
    }

    const ReducedGraph<Scalar>& curve_;
    const ReducedGraph<Scalar>& template_;
    std::vector<int> partner_;
    std::vector<bool> taken_;
    std::vector<int> order_; ///< template nodes, junctions first
    std::ptrdiff_t left_;    ///< partners that may still be tried
    Scalar least_;
    std::vector<int> best_;
    std::vector<DenseMatrix<Scalar>>
        added_; ///< per depth what curve node i for template node j adds to those assigned; m x n
};

/// All assignments one exchange away from `partner`; `candidates` curve nodes in all.
inline std::vector<std::vector<int>> exchanges(const std::vector<int>& partner, int candidates) {
    std::vector<std::vector<int>> out;
    for (std::size_t a = 0; a < partner.size(); ++a) {
        for (std::size_t b = a + 1; b < partner.size(); ++b) {
            out.push_back(partner);
            std::swap(out.back()[a], out.back()[b]);
        }
        for (int i = 0; i < candidates; ++i)
            if (std::find(partner.begin(), partner.end(), i) == partner.end()) {
                out.push_back(partner);
                out.back()[a] = i;
            }
    }
    return out;
}

} // namespace detail

SKELGEN_INLINE void validate(const MatchingOptions& options) {
    core::require_in_range("matching.degree_weight", options.degree_weight, 0.0, 1000.0);
    core::require_in_range("matching.distance_weight", options.distance_weight, 0.01, 1000.0); // 0: nothing to match
    core::require_in_range("matching.distance_scale", options.distance_scale, 0.01, 100.0);
    core::require_in_range("matching.radius_cost", options.radius_cost, 0.0, 1000.0);
    core::require_in_range("matching.degree_cost", options.degree_cost, 0.0, 1000.0);
    core::require_in_range("matching.end_cost", options.end_cost, 0.0, 1000.0);
}

template <typename Scalar>
Scalar distortion(const ReducedGraph<Scalar>& curve, const ReducedGraph<Scalar>& skeleton_template,
                  const std::vector<int>& partner, const MatchingOptions& options) {
    Scalar total = 0;
    for (int j = 0; j < static_cast<int>(partner.size()); ++j) {
        const int i = partner[detail::at(j)];
        total += detail::node_distortion(curve, skeleton_template, i, j, options);
        for (int l = 0; l < j; ++l)
            total += detail::pair_distortion(curve, skeleton_template, i, j, partner[detail::at(l)], l);
    }
    return total;
}

template <typename Scalar>
Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> affinity_matrix(const ReducedGraph<Scalar>& curve,
                                                                      const ReducedGraph<Scalar>& skeleton_template,
                                                                      const MatchingOptions& options) {
    const auto m = static_cast<int>(curve.origin.size()), n = static_cast<int>(skeleton_template.origin.size());
    const detail::DenseVector<Scalar> curve_mean = detail::mean_distances(curve.distances);
    const detail::DenseVector<Scalar> template_mean = detail::mean_distances(skeleton_template.distances);
    const auto degree_error = [&](int i, int j) {
        return std::abs(curve.degree[detail::at(i)] - skeleton_template.degree[detail::at(j)]);
    };
    const auto affinity = [&](int degree_difference, Scalar distance_difference) {
        return static_cast<Scalar>(options.degree_weight) * std::exp(-static_cast<Scalar>(degree_difference)) +
               static_cast<Scalar>(options.distance_weight) *
                   std::exp(-distance_difference / static_cast<Scalar>(options.distance_scale));
    };

    detail::DenseMatrix<Scalar> affinities = detail::DenseMatrix<Scalar>::Zero(m * n, m * n);
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < n; ++j) {
            affinities(i * n + j, i * n + j) = affinity(degree_error(i, j), std::abs(curve_mean[i] - template_mean[j]));
            for (int k = 0; k < m; ++k)
                for (int l = 0; l < n; ++l) {
                    if (i == k || j == l) continue;
                    affinities(i * n + j, k * n + l) =
                        affinity(std::abs(degree_error(i, j) - degree_error(k, l)),
                                 std::abs(curve.distances(i, k) - skeleton_template.distances(j, l)));
                }
        }
    return affinities;
}

template <typename Scalar>
std::vector<int> spectral_assignment(const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& affinities,
                                     int template_nodes) {
    const detail::DenseVector<Scalar> strength = detail::leading_eigenvector(affinities);
    std::vector<int> order(static_cast<std::size_t>(strength.size()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return strength[a] > strength[b]; });

    std::vector<int> partner(detail::at(template_nodes), -1);
    std::vector<bool> taken(order.size() / detail::at(template_nodes), false);
    for (const int pair : order) {
        const int i = pair / template_nodes, j = pair % template_nodes;
        if (taken[detail::at(i)] || partner[detail::at(j)] >= 0) continue;
        partner[detail::at(j)] = i;
        taken[detail::at(i)] = true;
    }
    return partner;
}

template <typename Scalar>
std::vector<int> descend(const ReducedGraph<Scalar>& curve, const ReducedGraph<Scalar>& skeleton_template,
                         std::vector<int> partner, const MatchingOptions& options) {
    Scalar best = distortion(curve, skeleton_template, partner, options);
    while (true) {
        std::vector<int> better;
        for (std::vector<int>& candidate : detail::exchanges(partner, static_cast<int>(curve.origin.size()))) {
            const Scalar total = distortion(curve, skeleton_template, candidate, options);
            if (total > best - detail::least_gain<Scalar>()) continue;
            best = total;
            better = std::move(candidate);
        }
        if (better.empty()) return partner;
        partner = std::move(better);
    }
}

template <typename Scalar>
Assignment least_distorted(const ReducedGraph<Scalar>& curve, const ReducedGraph<Scalar>& skeleton_template,
                           std::vector<int> partner, const MatchingOptions& options) {
    return detail::BranchAndBound<Scalar>(curve, skeleton_template, std::move(partner), options).run();
}

} // namespace skelgen::embedding
