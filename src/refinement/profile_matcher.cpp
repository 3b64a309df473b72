#include "profile_matcher.hpp"

#include <algorithm>
#include <cmath>

namespace skelgen::detail {

const Profile leg_profile{-0.395, -0.357, -0.313, -0.248, -0.129, -0.044, -0.176, -0.328, -0.295, -0.186, -0.055, 0.077,
                          0.174,  0.201,  0.167,  0.125,  0.177,  0.238,  0.279,  0.340,  0.417,  0.485,  0.547};
const Profile arm_profile{-1.001, -0.339, -0.150, -0.007, -0.063, -0.183, -0.269, -0.257, -0.207, -0.139, -0.058, 0.031,
                          0.101,  0.142,  0.161,  0.166,  0.162,  0.164,  0.191,  0.236,  0.279,  0.319,  0.357};

namespace {

constexpr double first_u = -0.6, step_u = 0.1;
constexpr double end_weight = 0.3; // of samples on hand and foot, whose shape changes most

double square(double x) { return x * x; }

/// What a stretch of the profile costs on one limb: squared deviations of the thickness and of the lengths.
class Cost {
public:
    Cost(const MatchedLimb& limb, const Profile& profile, const ThicknessProfileOptions& options)
        : limb_(limb), profile_(profile), options_(options) {}

    /// Ratios are logarithms, to the limb at rest.
    [[nodiscard]] Stretch stretch(double outer_ratio, double bone_ratio) const {
        const double outer = limb_.rest.outer * std::exp(outer_ratio), bone = std::exp(bone_ratio);
        const double middle = outer + bone * lower_bone();
        return {outer, middle, middle + bone * upper_bone()};
    }

    [[nodiscard]] double operator()(double outer_ratio, double bone_ratio) const {
        const Stretch s = stretch(outer_ratio, bone_ratio);
        constexpr double far_misfit =
            2; // beyond it, a limb is unlike the profile (in trousers, in armour) and tells less
        const ProfileFit f = fit(limb_.samples, profile_, s, options_.thickness_deviation);
        return options_.independent_samples * far_misfit * std::log1p(f.misfit / far_misfit) +
               square(outer_ratio / options_.end_deviation) +
               square(std::log(s.middle / limb_.rest.middle) / options_.limb_deviation) +
               square(bone_ratio / options_.bone_deviation) + disproportion(s, f.stoutness);
    }

private:
    [[nodiscard]] double lower_bone() const { return limb_.rest.middle - limb_.rest.outer; }
    [[nodiscard]] double upper_bone() const { return limb_.rest.inner - limb_.rest.middle; }

    /// Of the upper bone, whose upper end is known, to the lower one. Clothes hide that end: far off, it says little.
    [[nodiscard]] double disproportion(const Stretch& s, double stoutness) const {
        if (!limb_.top) return 0;
        const double upper = std::max(limb_.top->from_tip - s.middle, 0.1 * upper_bone());
        const double x = std::log(upper / (s.inner - s.middle));
        const double deviation = deviation_of(*limb_.top, stoutness, s);
        const double xx = x * x / (square(options_.proportion_deviation) + square(deviation));
        return far_off * std::log1p(xx / far_off);
    }

    const MatchedLimb& limb_;
    const Profile& profile_;
    ThicknessProfileOptions options_;
};

/// Logarithms of lengths to those at rest: of the lower bones, and of each limb from joint to tip.
struct Ratios {
    double bone = 0;
    std::vector<double> outer;
    double cost = std::numeric_limits<double>::infinity();
};

/// The cheapest ratios on a grid of that step around `centre`.
Ratios search(const std::vector<Cost>& costs, const Ratios& centre, double reach, double step) {
    const int steps = static_cast<int>(std::lround(reach / step));
    Ratios best = centre;
    best.cost = std::numeric_limits<double>::infinity();
    for (int i = -steps; i <= steps; ++i) {
        Ratios next{centre.bone + i * step, centre.outer, 0};
        for (std::size_t k = 0; k < costs.size(); ++k) {
            double least = std::numeric_limits<double>::infinity();
            for (int j = -steps; j <= steps; ++j) {
                const double outer = centre.outer[k] + j * step, cost = costs[k](outer, next.bone);
                if (cost < least) {
                    least = cost;
                    next.outer[k] = outer;
                }
            }
            next.cost += least;
        }
        if (next.cost < best.cost) best = next;
    }
    return best;
}

} // namespace

std::optional<double> value_at(const Profile& profile, double u) {
    const double x = (u - first_u) / step_u;
    if (!(x >= 0) || x >= static_cast<double>(profile.size() - 1)) return std::nullopt;
    const auto i = static_cast<std::size_t>(x);
    return profile[i] + (x - static_cast<double>(i)) * (profile[i + 1] - profile[i]);
}

ProfileFit fit(const std::vector<Sample>& samples, const Profile& profile, const Stretch& stretch, double deviation) {
    struct Residual {
        double value, weight;
    };
    std::vector<Residual> residuals;
    for (const Sample& sample : samples) {
        const double u = stretch.u(sample.from_tip);
        if (const auto expected = value_at(profile, u))
            residuals.push_back({sample.log_thickness - *expected, u < 0 ? end_weight : 1});
    }
    double offset = 0; // how stout the limb is
    for (int round = 0; round < 3; ++round) {
        double sum = 0, weights = 0;
        for (const Residual& r : residuals) {
            const double far = (r.value - offset) / (2.5 * deviation);
            const double weight = round == 0 ? r.weight : r.weight / (1 + far * far);
            sum += weight * r.value;
            weights += weight;
        }
        if (!(weights > 0)) return {};
        offset = sum / weights;
    }
    double sum = 0, weights = 0;
    for (const Residual& r : residuals) {
        const double far = (r.value - offset) / deviation;
        sum += r.weight * std::min(far * far, worst_misfit);
        weights += r.weight;
    }
    return {sum / weights, offset};
}

double deviation_of(const Top& top, double stoutness, const Stretch& s) {
    constexpr double slim = 0.13, growth = 5;
    return top.deviation + growth * std::max(0.0, std::exp(stoutness) / (s.middle - s.outer) - slim);
}

std::vector<Stretch> best_stretches(const std::vector<MatchedLimb>& limbs, const Profile& profile,
                                    const ThicknessProfileOptions& options) {
    constexpr double widest = 0.3, step = 0.03; // lengths from 3/4 to 4/3
    std::vector<Cost> costs;
    for (const MatchedLimb& limb : limbs) costs.emplace_back(limb, profile, options);
    const Ratios coarse = search(costs, {0, std::vector<double>(limbs.size(), 0.0)}, widest, step);
    const Ratios fine = search(costs, coarse, step, step / 6);
    std::vector<Stretch> stretches;
    for (std::size_t k = 0; k < limbs.size(); ++k) stretches.push_back(costs[k].stretch(fine.outer[k], fine.bone));
    return stretches;
}

} // namespace skelgen::detail
