#pragma once

#include <array>
#include <optional>
#include <vector>

#include <skelgen/refinement/thickness_profile.hpp>

namespace skelgen::detail {

/// Mean logarithm of a limb's thickness where its coordinate u runs from -0.6 to 1.6 in steps of 0.1: -1 at the tip, 0
/// at wrist or ankle, 1 at elbow or knee, 2 at shoulder or hip. Up to a constant. Calibrated: the straight limbs of 50
/// registered bodies.
using Profile = std::array<double, 23>;
extern const Profile leg_profile, arm_profile;

/// Value of the profile at u; none beyond its ends.
[[nodiscard]] std::optional<double> value_at(const Profile& profile, double u);

/// Distances of a limb's joints from its tip.
struct Stretch {
    double outer = 0, middle = 0, inner = 0; ///< wrist, elbow, shoulder; or ankle, knee, hip

    [[nodiscard]] double u(double from_tip) const {
        if (from_tip < outer) return from_tip / outer - 1;
        if (from_tip < middle) return (from_tip - outer) / (middle - outer);
        return 1 + (from_tip - middle) / (inner - middle);
    }
};

struct Sample {
    double from_tip = 0, log_thickness = 0;
};

inline constexpr double worst_misfit = 9; ///< of a sample, in squared deviations: what is farther off counts no more

/// How well a stretched profile fits.
struct ProfileFit {
    double misfit = worst_misfit; ///< mean squared difference, in squared deviations
    double stoutness = 0;         ///< mean difference of the logarithms
};

/// Compares the samples with the profile stretched over them. Robust: sections across a fold or a sleeve count for no
/// more than three deviations. Without samples on the profile the misfit is the worst, the stoutness 0.
[[nodiscard]] ProfileFit fit(const std::vector<Sample>& samples, const Profile& profile, const Stretch& stretch,
                             double deviation);

inline constexpr double far_off = 4; ///< squared deviations beyond which the end that the trunk tells counts for little

/// The upper end of a limb as the trunk tells it: distance from the tip, and the standard deviation of the logarithm of
/// the upper bone's length that follows.
struct Top {
    double from_tip = 0, deviation = 0;
};

/// Of the upper bone's length on a leg of that stoutness: where legs are stout, they touch, and part lower than others.
[[nodiscard]] double deviation_of(const Top& top, double stoutness, const Stretch& stretch);

/// A limb whose thickness is compared with the profile.
struct MatchedLimb {
    std::vector<Sample> samples;
    Stretch rest; ///< the template's own
    std::optional<Top> top;
};

/// The stretch of the profile for each of the limbs, both arms or both legs, that fit their samples, the template's
/// proportions and the tops best, with lower bones equally many times longer than at rest. By search on a grid and on a
/// finer one around its best.
[[nodiscard]] std::vector<Stretch> best_stretches(const std::vector<MatchedLimb>& limbs, const Profile& profile,
                                                  const ThicknessProfileOptions& options);

} // namespace skelgen::detail
