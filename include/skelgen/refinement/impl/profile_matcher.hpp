#pragma once

#include <skelgen/refinement/profile_matcher.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include <skelgen/core/geometry.hpp>

namespace skelgen::refinement {
namespace detail {

/// The u of a profile's first entry.
template <typename Scalar>
inline constexpr Scalar first_u = Scalar(-0.6);

/// Between two entries of a profile.
template <typename Scalar>
inline constexpr Scalar step_u = Scalar(0.1);

/// Weight of samples on hand and foot, whose shape changes most, against 1 of the others. A working value.
template <typename Scalar>
inline constexpr Scalar end_weight = Scalar(0.3);

/// Deviations at which a sample's say in the stoutness is halved: a Cauchy weight, whose usual scale this nearly is
/// (HW77: 2.385).
template <typename Scalar>
inline constexpr Scalar halved_at = Scalar(2.5);

/// How often the stoutness is found, each time with the weights that follow from the last.
inline constexpr int stoutness_rounds = 3;

/// Mean squared deviations beyond which a limb is unlike the profile (in trousers, in armour) and tells less.
template <typename Scalar>
inline constexpr Scalar far_misfit = Scalar(2);

/// Thickness of a leg, as a part of its calf, up to which legs do not touch. A working value, as is the next one.
template <typename Scalar>
inline constexpr Scalar slim = Scalar(0.13);

/// What each calf's length that a leg is thicker adds to the standard deviation of where its top is.
template <typename Scalar>
inline constexpr Scalar touching_growth = Scalar(5);

/// An upper bone is never taken to be shorter than this part of its usual length, whatever the trunk says: its
/// logarithm has to exist.
template <typename Scalar>
inline constexpr Scalar shortest_upper_bone = Scalar(0.1);

/// Logarithms of lengths are looked for up to so far from the template's: lengths from 3/4 to 4/3 of it; of a figure,
/// whose hands and feet may be of any size, from 1/2 to 2 times as long.
template <typename Scalar>
inline constexpr Scalar widest_search = Scalar(0.3);
template <typename Scalar>
inline constexpr Scalar widest_search_of_figures = Scalar(0.6);

/// Steps of the grids of logarithms, each grid around the best of the one before; the last is half a percent of a
/// length. For what the best costs a wider first step is enough: which of two like ones it is does not matter then.
inline constexpr std::array steps_to_best{0.03, 0.005};
inline constexpr std::array steps_to_cost{0.06, 0.02, 0.005};

/// Stretch::u for many places: without dividing for each.
template <typename Scalar>
class StretchedCoordinate {
public:
    explicit StretchedCoordinate(const Stretch<Scalar>& s)
        : s_(s), per_end_(1 / s.outer), per_lower_(1 / (s.middle - s.outer)), per_upper_(1 / (s.inner - s.middle)) {}

    [[nodiscard]] Scalar operator()(Scalar from_tip) const {
        if (from_tip < s_.outer) return from_tip * per_end_ - 1;
        if (from_tip < s_.middle) return (from_tip - s_.outer) * per_lower_;
        return 1 + (from_tip - s_.middle) * per_upper_;
    }

private:
    Stretch<Scalar> s_;
    Scalar per_end_, per_lower_, per_upper_;
};

template <typename Scalar>
Scalar squared(Scalar x) {
    return x * x;
}

/// Squared deviations of what may be far off for a reason of its own, and then says little.
template <typename Scalar>
Scalar softened(Scalar squares) {
    constexpr auto far = static_cast<Scalar>(far_off);
    return far * std::log1p(squares / far);
}

/// What a stretch of the profile costs on one limb: squared deviations of the thickness and of the lengths.
template <typename Scalar>
class StretchCost {
public:
    StretchCost(const MatchedLimb<Scalar>& limb, const Profile& profile, const ThicknessProfileOptions& options)
        : limb_(limb), profile_(profile), options_(options) {}

    /// Ratios are logarithms, to the limb at rest.
    [[nodiscard]] Stretch<Scalar> stretch(Scalar outer_ratio, Scalar bone_ratio) const {
        const Scalar outer = limb_.rest.outer * std::exp(outer_ratio), bone = std::exp(bone_ratio);
        const Scalar middle = outer + bone * lower_bone();
        return {outer, middle, middle + bone * upper_bone()};
    }

    /// What the lengths alone cost, for any thickness.
    [[nodiscard]] Scalar of_lengths(Scalar outer_ratio, Scalar bone_ratio) const {
        return off_template(stretch(outer_ratio, bone_ratio), outer_ratio, bone_ratio);
    }

    [[nodiscard]] Scalar operator()(Scalar outer_ratio, Scalar bone_ratio) const {
        const Stretch<Scalar> s = stretch(outer_ratio, bone_ratio);
        const ProfileFit<Scalar> fit =
            fit_profile(limb_.samples, profile_, s, static_cast<Scalar>(options_.thickness_deviation));
        return static_cast<Scalar>(options_.independent_samples) * far_misfit<Scalar> *
                   std::log1p(fit.misfit / far_misfit<Scalar>) +
               off_template(s, outer_ratio, bone_ratio) + disproportion(s, fit.stoutness) + off_heel(s);
    }

private:
    [[nodiscard]] Scalar lower_bone() const { return limb_.rest.middle - limb_.rest.outer; }
    [[nodiscard]] Scalar upper_bone() const { return limb_.rest.inner - limb_.rest.middle; }

    /// Of all lengths from the template's.
    [[nodiscard]] Scalar off_template(const Stretch<Scalar>& s, Scalar outer_ratio, Scalar bone_ratio) const {
        return off_rest(outer_ratio, options_.end_deviation) +
               off_rest(std::log(s.middle / limb_.rest.middle), options_.limb_deviation) +
               off_rest(bone_ratio, options_.bone_deviation);
    }

    /// Of a length from the template's. A figure's proportions are its own: far off they say little.
    [[nodiscard]] Scalar off_rest(Scalar ratio, double deviation) const {
        const Scalar squares = squared(ratio / static_cast<Scalar>(deviation));
        return limb_.is_adapted ? softened(squares) : squares;
    }

    /// Of the ankle from where the heel has it. Shoes may turn the line elsewhere: far off it says little.
    [[nodiscard]] Scalar off_heel(const Stretch<Scalar>& s) const {
        if (!limb_.heel) return 0;
        const Scalar ratio = std::log(s.outer / limb_.heel->from_tip) - static_cast<Scalar>(options_.ankle_beyond_heel);
        return limb_.heel->bent * softened(squared(ratio / static_cast<Scalar>(options_.heel_deviation)));
    }

    /// Of the upper bone, whose upper end is known, to the lower one. Clothes hide that end: far off, it says little.
    [[nodiscard]] Scalar disproportion(const Stretch<Scalar>& s, Scalar stoutness) const {
        if (!limb_.top) return 0;
        const Scalar upper = std::max(limb_.top->from_tip - s.middle, shortest_upper_bone<Scalar> * upper_bone());
        const Scalar x = std::log(upper / (s.inner - s.middle));
        const Scalar deviation = deviation_of(*limb_.top, stoutness, s);
        return softened(squared(x) /
                        (squared(static_cast<Scalar>(options_.proportion_deviation)) + squared(deviation)));
    }

    const MatchedLimb<Scalar>& limb_;
    const Profile& profile_;
    ThicknessProfileOptions options_;
};

/// Logarithms of lengths to those at rest: of the lower bones, and of each limb from joint to tip.
template <typename Scalar>
struct StretchRatios {
    Scalar bone = 0;
    std::vector<Scalar> outer;
    Scalar cost = std::numeric_limits<Scalar>::infinity();
};

/// The cheapest ratios on a grid of that step around `centre`.
template <typename Scalar>
StretchRatios<Scalar> search_ratios(const std::vector<StretchCost<Scalar>>& costs, const StretchRatios<Scalar>& centre,
                                    Scalar reach, Scalar step) {
    const int steps = static_cast<int>(std::lround(reach / step));
    StretchRatios<Scalar> best = centre;
    best.cost = std::numeric_limits<Scalar>::infinity();
    // From the middle outwards: what is farther than the best so far by its lengths alone needs no look at thickness.
    const auto outwards = [](int i) { return i % 2 == 0 ? i / 2 : -(i + 1) / 2; };
    for (int row = 0; row <= 2 * steps; ++row) {
        const int i = outwards(row);
        StretchRatios<Scalar> next{centre.bone + static_cast<Scalar>(i) * step, centre.outer, 0};
        for (std::size_t k = 0; k < costs.size() && next.cost < best.cost; ++k) {
            Scalar least = best.cost - next.cost; // what costs more does not come to be the best
            bool is_found = false;
            for (int column = 0; column <= 2 * steps; ++column) {
                const Scalar outer = centre.outer[k] + static_cast<Scalar>(outwards(column)) * step;
                if (costs[k].of_lengths(outer, next.bone) >= least) continue;
                const Scalar cost = costs[k](outer, next.bone);
                if (cost < least) {
                    least = cost;
                    next.outer[k] = outer;
                    is_found = true;
                }
            }
            next.cost = is_found ? next.cost + least : std::numeric_limits<Scalar>::infinity();
        }
        if (next.cost < best.cost) best = next;
    }
    return best;
}

/// The ratios where parabolas through what they and their neighbours on the grid cost are least: between its places, so
/// that a body a little different has ratios a little different. First the lower bones', of all limbs together.
template <typename Scalar>
StretchRatios<Scalar> between_grid(const std::vector<StretchCost<Scalar>>& costs, StretchRatios<Scalar> ratios,
                                   Scalar step) {
    const auto least = [&](Scalar& ratio, const auto& cost) {
        const Scalar here = ratio;
        const auto cost_at = [&](Scalar x) {
            ratio = x;
            return cost();
        };
        const Scalar offset = core::least_of_parabola(cost_at(here - step), cost_at(here), cost_at(here + step));
        ratio = here + offset * step;
    };
    least(ratios.bone, [&] {
        Scalar sum = 0;
        for (std::size_t k = 0; k < costs.size(); ++k) sum += costs[k](ratios.outer[k], ratios.bone);
        return sum;
    });
    for (std::size_t k = 0; k < costs.size(); ++k)
        least(ratios.outer[k], [&] { return costs[k](ratios.outer[k], ratios.bone); });
    return ratios;
}

/// The cheapest of all ratios.
template <typename Scalar, std::size_t count>
StretchRatios<Scalar> cheapest_ratios(const std::vector<MatchedLimb<Scalar>>& limbs, const Profile& profile,
                                      const ThicknessProfileOptions& options, const std::array<double, count>& steps) {
    std::vector<StretchCost<Scalar>> costs;
    for (const MatchedLimb<Scalar>& limb : limbs) costs.emplace_back(limb, profile, options);
    StretchRatios<Scalar> best{0, std::vector<Scalar>(limbs.size(), Scalar(0))};
    const bool are_adapted = std::any_of(limbs.begin(), limbs.end(), [](const auto& limb) { return limb.is_adapted; });
    Scalar reach = are_adapted ? widest_search_of_figures<Scalar> : widest_search<Scalar>;
    for (const double step : steps) {
        best = search_ratios(costs, best, reach, static_cast<Scalar>(step));
        reach = static_cast<Scalar>(step);
    }
    return between_grid(costs, std::move(best), reach);
}

} // namespace detail

template <typename Scalar>
std::optional<Scalar> value_at(const Profile& profile, Scalar u) {
    constexpr Scalar per_u = 1 / detail::step_u<Scalar>;
    const Scalar x = (u - detail::first_u<Scalar>)*per_u;
    if (!(x >= 0) || x >= static_cast<Scalar>(profile.size() - 1)) return std::nullopt;
    const auto i = static_cast<std::size_t>(x);
    const auto here = static_cast<Scalar>(profile[i]), next = static_cast<Scalar>(profile[i + 1]);
    return here + (x - static_cast<Scalar>(i)) * (next - here);
}

template <typename Scalar>
ProfileFit<Scalar> fit_profile(const std::vector<Sample<Scalar>>& samples, const Profile& profile,
                               const Stretch<Scalar>& stretch, Scalar deviation) {
    using Values = Eigen::Array<Scalar, Eigen::Dynamic, 1>;
    Values residuals(samples.size()), weights(samples.size());
    Eigen::Index n = 0; // on the profile
    const detail::StretchedCoordinate<Scalar> coordinate(stretch);
    for (const Sample<Scalar>& sample : samples) {
        const Scalar u = coordinate(sample.from_tip);
        const auto expected = value_at(profile, u);
        if (!expected) continue;
        residuals[n] = sample.log_thickness - *expected;
        weights[n++] = sample.weight * (u < 0 ? detail::end_weight<Scalar> : Scalar(1));
    }
    const auto value = residuals.head(n), weight = weights.head(n);
    const Scalar all = weight.sum();
    if (!(all > 0)) return {};
    Scalar offset = (weight * value).sum() / all; // how stout the limb is
    const Scalar scale = 1 / (detail::halved_at<Scalar> * deviation);
    for (int round = 1; round < detail::stoutness_rounds; ++round) {
        const Values robust = weight / (1 + (scale * (value - offset)).square());
        offset = (robust * value).sum() / robust.sum();
    }
    const auto misfit = ((value - offset) / deviation).square().min(static_cast<Scalar>(worst_misfit));
    return {(weight * misfit).sum() / all, offset};
}

template <typename Scalar>
Scalar deviation_of(const Top<Scalar>& top, Scalar stoutness, const Stretch<Scalar>& s) {
    if (top.part != BodyPart::leg) return top.deviation;
    const Scalar thickness = std::exp(stoutness) / (s.middle - s.outer);
    return top.deviation + detail::touching_growth<Scalar> * std::max(Scalar(0), thickness - detail::slim<Scalar>);
}

template <typename Scalar>
std::vector<Stretch<Scalar>> best_stretches(const std::vector<MatchedLimb<Scalar>>& limbs, const Profile& profile,
                                            const ThicknessProfileOptions& options) {
    const auto best = detail::cheapest_ratios(limbs, profile, options, detail::steps_to_best);
    std::vector<Stretch<Scalar>> stretches;
    for (std::size_t k = 0; k < limbs.size(); ++k)
        stretches.push_back(detail::StretchCost<Scalar>(limbs[k], profile, options).stretch(best.outer[k], best.bone));
    return stretches;
}

template <typename Scalar>
Scalar least_cost(const MatchedLimb<Scalar>& limb, const Profile& profile, const ThicknessProfileOptions& options) {
    return detail::cheapest_ratios<Scalar>({limb}, profile, options, detail::steps_to_cost).cost;
}

} // namespace skelgen::refinement
