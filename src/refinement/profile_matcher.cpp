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

class Matcher {
public:
    Matcher(const std::vector<Sample>& samples, const Profile& profile, const Stretch& rest,
            const std::optional<Top>& top, const ThicknessProfileOptions& options)
        : samples_(samples), profile_(profile), rest_(rest), top_(top), options_(options) {}

    [[nodiscard]] Stretch best() const {
        constexpr double widest = 0.3, step = 0.03; // of logarithms: lengths from 3/4 to 4/3
        const auto coarse = search(0, 0, widest, step);
        const auto fine = search(coarse.log_outer, coarse.log_middle, step, step / 6);
        return stretch(fine.log_outer, fine.log_middle);
    }

private:
    struct Candidate {
        double log_outer = 0, log_middle = 0, cost = std::numeric_limits<double>::infinity();
    };

    [[nodiscard]] double bone_ratio(const Stretch& s) const {
        return (s.middle - s.outer) / (rest_.middle - rest_.outer);
    }

    [[nodiscard]] Stretch stretch(double log_outer, double log_middle) const {
        Stretch s{rest_.outer * std::exp(log_outer), rest_.middle * std::exp(log_middle), 0};
        s.inner = s.middle + std::max(bone_ratio(s), 0.1) * (rest_.inner - rest_.middle);
        return s;
    }

    [[nodiscard]] double cost(double log_outer, double log_middle) const {
        const Stretch s = stretch(log_outer, log_middle);
        const double bone = bone_ratio(s);
        if (bone < 0.5) return std::numeric_limits<double>::infinity();
        constexpr double far_misfit =
            2; // beyond it, a limb is unlike the profile (in trousers, in armour) and tells less
        const auto square = [](double x) { return x * x; };
        const Fit f = fit(samples_, profile_, s, options_.thickness_deviation);
        return options_.independent_samples * far_misfit * std::log1p(f.misfit / far_misfit) +
               square(log_outer / options_.end_deviation) + square(log_middle / options_.limb_deviation) +
               square(std::log(bone) / options_.bone_deviation) + disproportion(s, f.stoutness);
    }

    /// Of the upper bone, whose upper end is known, to the lower one. Clothes hide that end: far off, it says little.
    [[nodiscard]] double disproportion(const Stretch& s, double stoutness) const {
        if (!top_) return 0;
        const double upper = std::max(top_->from_tip - s.middle, 0.1 * (rest_.inner - rest_.middle));
        const double x = std::log(upper / (bone_ratio(s) * (rest_.inner - rest_.middle)));
        const double dev = deviation_of(*top_, stoutness, s);
        const double xx = x * x / (options_.proportion_deviation * options_.proportion_deviation + dev * dev);
        return far_off * std::log1p(xx / far_off);
    }

    [[nodiscard]] Candidate search(double log_outer, double log_middle, double reach, double step) const {
        Candidate best{log_outer, log_middle, cost(log_outer, log_middle)};
        const int steps = static_cast<int>(std::lround(reach / step));
        for (int i = -steps; i <= steps; ++i)
            for (int j = -steps; j <= steps; ++j) {
                const Candidate next{log_outer + i * step, log_middle + j * step,
                                     cost(log_outer + i * step, log_middle + j * step)};
                if (next.cost < best.cost) best = next;
            }
        return best;
    }

    const std::vector<Sample>& samples_;
    const Profile& profile_;
    Stretch rest_;
    std::optional<Top> top_;
    ThicknessProfileOptions options_;
};

} // namespace

std::optional<double> value_at(const Profile& profile, double u) {
    const double x = (u - first_u) / step_u;
    if (!(x >= 0) || x >= static_cast<double>(profile.size() - 1)) return std::nullopt;
    const auto i = static_cast<std::size_t>(x);
    return profile[i] + (x - static_cast<double>(i)) * (profile[i + 1] - profile[i]);
}

Fit fit(const std::vector<Sample>& samples, const Profile& profile, const Stretch& stretch, double deviation) {
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
        sum += r.weight * std::min(far * far, 9.0);
        weights += r.weight;
    }
    return {sum / weights, offset};
}

double deviation_of(const Top& top, double stoutness, const Stretch& s) {
    constexpr double slim = 0.13, growth = 5;
    return top.deviation + growth * std::max(0.0, std::exp(stoutness) / (s.middle - s.outer) - slim);
}

Stretch best_stretch(const std::vector<Sample>& samples, const Profile& profile, const Stretch& rest,
                     const std::optional<Top>& top, const ThicknessProfileOptions& options) {
    return Matcher(samples, profile, rest, top, options).best();
}

} // namespace skelgen::detail
