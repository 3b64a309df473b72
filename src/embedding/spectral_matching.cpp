#include <skelgen/embedding/spectral_matching.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Spectra/MatOp/DenseSymMatProd.h>
#include <Spectra/SymEigsSolver.h>

#include <skelgen/core/error.hpp>

namespace skelgen {
namespace {

/// Mean distance from each node to the others.
Eigen::VectorXd mean_distances(const Eigen::MatrixXd& distances) {
    return distances.rowwise().sum() / static_cast<double>(std::max<Eigen::Index>(distances.rows() - 1, 1));
}

Eigen::VectorXd leading_eigenvector(const Eigen::MatrixXd& matrix) {
    if (matrix.rows() < 3) return Eigen::VectorXd::Ones(matrix.rows()); // Spectra needs room for its subspace
    Spectra::DenseSymMatProd<double> product(matrix);
    Spectra::SymEigsSolver<Spectra::DenseSymMatProd<double>> solver(
        product, 1, static_cast<int>(std::min<Eigen::Index>(20, matrix.rows())));
    // From a start that favours no pair: a left and a right limb that match equally well keep equal entries.
    const Eigen::VectorXd start = Eigen::VectorXd::Ones(matrix.rows());
    solver.init(start.data());
    solver.compute(Spectra::SortRule::LargestAlge, 1000, 1e-12);
    if (solver.info() != Spectra::CompInfo::Successful)
        throw Error(ErrorCode::internal, "the spectral matching's eigenvector did not converge");
    return solver.eigenvectors().col(0).cwiseAbs();
}

double square(double x) { return x * x; }

/// What curve node `i` for template node `j` adds to the distortion by itself.
double node_distortion(const ReducedGraph& curve, const ReducedGraph& skeleton_template, int i, std::size_t j,
                       const MatchingOptions& options) {
    const auto node = static_cast<std::size_t>(i);
    const double radius = curve.radius[node], rest_radius = skeleton_template.radius[j];
    return square(options.degree_cost * (curve.degree[node] - skeleton_template.degree[j])) +
           (radius > 0 && rest_radius > 0 ? square(options.radius_cost * (radius - rest_radius)) : 0);
}

/// What two assigned pairs add by the distance between them.
double pair_distortion(const ReducedGraph& curve, const ReducedGraph& skeleton_template, int i, std::size_t j, int k,
                       std::size_t l) {
    return square(curve.distances(i, k) -
                  skeleton_template.distances(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(l)));
}

} // namespace

double distortion(const ReducedGraph& curve, const ReducedGraph& skeleton_template, const std::vector<int>& partner,
                  const MatchingOptions& options) {
    double total = 0;
    for (std::size_t j = 0; j < partner.size(); ++j) {
        total += node_distortion(curve, skeleton_template, partner[j], j, options);
        for (std::size_t l = 0; l < j; ++l)
            total += pair_distortion(curve, skeleton_template, partner[j], j, partner[l], l);
    }
    return total;
}

namespace {

/// Depth-first search through all assignments, leaving out what is already more distorted than the best one known.
class BranchAndBound {
public:
    BranchAndBound(const ReducedGraph& curve, const ReducedGraph& skeleton_template, std::vector<int> start,
                   const MatchingOptions& options)
        : curve_(curve), template_(skeleton_template), options_(options), partner_(start.size(), -1),
          taken_(curve.degree.size(), false), order_(start.size()),
          least_(distortion(curve, skeleton_template, start, options)), best_(std::move(start)) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
            return skeleton_template.degree[a] > skeleton_template.degree[b];
        });
    }

    std::vector<int> run() {
        extend(0, 0);
        return std::move(best_);
    }

private:
    void extend(std::size_t depth, double total) {
        constexpr double least_gain = 1e-9; // exchanging a left limb for a right one gains nothing but rounding
        constexpr int most_visits = 3'000'000;
        if (total > least_ - least_gain || ++visits_ > most_visits) return;
        if (depth == order_.size()) {
            least_ = total;
            best_ = partner_;
            return;
        }
        const std::size_t j = order_[depth];
        for (int i = 0; i < static_cast<int>(taken_.size()); ++i) {
            if (taken_[static_cast<std::size_t>(i)]) continue;
            double longer = total + node_distortion(curve_, template_, i, j, options_);
            for (std::size_t d = 0; d < depth; ++d)
                longer += pair_distortion(curve_, template_, i, j, partner_[order_[d]], order_[d]);
            taken_[static_cast<std::size_t>(i)] = true;
            partner_[j] = i;
            extend(depth + 1, longer);
            taken_[static_cast<std::size_t>(i)] = false;
        }
        partner_[j] = -1;
    }

    const ReducedGraph& curve_;
    const ReducedGraph& template_;
    const MatchingOptions& options_;
    std::vector<int> partner_;
    std::vector<bool> taken_;
    std::vector<std::size_t> order_; ///< template nodes, junctions first
    int visits_ = 0;
    double least_;
    std::vector<int> best_;
};

/// All assignments one exchange away from `partner`; `candidates` curve nodes in all.
std::vector<std::vector<int>> exchanges(const std::vector<int>& partner, int candidates) {
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

} // namespace

Eigen::MatrixXd affinity_matrix(const ReducedGraph& curve, const ReducedGraph& skeleton_template,
                                const MatchingOptions& options) {
    const auto m = static_cast<Eigen::Index>(curve.origin.size());
    const auto n = static_cast<Eigen::Index>(skeleton_template.origin.size());
    const Eigen::VectorXd curve_mean = mean_distances(curve.distances);
    const Eigen::VectorXd template_mean = mean_distances(skeleton_template.distances);
    const auto degree_error = [&](Eigen::Index i, Eigen::Index j) {
        return std::abs(curve.degree[static_cast<std::size_t>(i)] -
                        skeleton_template.degree[static_cast<std::size_t>(j)]);
    };
    const auto affinity = [&](double degree_difference, double distance_difference) {
        return options.degree_weight * std::exp(-degree_difference) +
               options.distance_weight * std::exp(-distance_difference / options.distance_scale);
    };

    Eigen::MatrixXd affinities = Eigen::MatrixXd::Zero(m * n, m * n);
    for (Eigen::Index i = 0; i < m; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            affinities(i * n + j, i * n + j) = affinity(degree_error(i, j), std::abs(curve_mean[i] - template_mean[j]));
            for (Eigen::Index k = 0; k < m; ++k)
                for (Eigen::Index l = 0; l < n; ++l) {
                    if (i == k || j == l) continue;
                    affinities(i * n + j, k * n + l) =
                        affinity(std::abs(degree_error(i, j) - degree_error(k, l)),
                                 std::abs(curve.distances(i, k) - skeleton_template.distances(j, l)));
                }
        }
    return affinities;
}

std::vector<int> spectral_assignment(const Eigen::MatrixXd& affinities, int template_nodes) {
    const Eigen::VectorXd strength = leading_eigenvector(affinities);
    std::vector<int> order(static_cast<std::size_t>(strength.size()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return strength[a] > strength[b]; });

    std::vector<int> partner(static_cast<std::size_t>(template_nodes), -1);
    std::vector<bool> taken(order.size() / static_cast<std::size_t>(template_nodes), false);
    for (const int pair : order) {
        const auto i = static_cast<std::size_t>(pair / template_nodes),
                   j = static_cast<std::size_t>(pair % template_nodes);
        if (taken[i] || partner[j] >= 0) continue;
        partner[j] = static_cast<int>(i);
        taken[i] = true;
    }
    return partner;
}

std::vector<int> descend(const ReducedGraph& curve, const ReducedGraph& skeleton_template, std::vector<int> partner,
                         const MatchingOptions& options) {
    constexpr double least_gain = 1e-9; // exchanging a left limb for a right one gains nothing but rounding
    double best = distortion(curve, skeleton_template, partner, options);
    while (true) {
        std::vector<int> better;
        for (std::vector<int>& candidate : exchanges(partner, static_cast<int>(curve.origin.size()))) {
            const double total = distortion(curve, skeleton_template, candidate, options);
            if (total > best - least_gain) continue;
            best = total;
            better = std::move(candidate);
        }
        if (better.empty()) return partner;
        partner = std::move(better);
    }
}

std::vector<int> least_distorted(const ReducedGraph& curve, const ReducedGraph& skeleton_template,
                                 std::vector<int> partner, const MatchingOptions& options) {
    return BranchAndBound(curve, skeleton_template, std::move(partner), options).run();
}

} // namespace skelgen
