#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <skelgen/core/options.hpp>

namespace skelgen::refinement {

/// How far a limb's own proportions may be from the template's (standard deviations of logarithms of lengths), and how
/// closely its thickness follows that of other people.
struct ThicknessProfileOptions {
    double end_deviation = 0.2;         ///< of hand or foot: fists and shoes change it much
    double limb_deviation = 0.2;        ///< of the middle joint's distance from the tip
    double bone_deviation = 0.1;        ///< of forearm or calf
    double proportion_deviation = 0.08; ///< of upper bone against lower bone
    double thickness_deviation = 0.07;  ///< of the logarithm of thickness
    double independent_samples = 10;    ///< as many independent measurements a limb's thickness profile is worth
    double ankle_beyond_heel = 0.13;    ///< logarithm of the ankle's distance from the tip to the heel's
    double heel_deviation = 0.12;       ///< of that; both calibrated on the legs of registered bodies, and of figures
};

/// \throws Error usage when an option is out of its range.
inline void validate(const ThicknessProfileOptions& options) {
    const auto deviation = [](const char* name, double value) { core::require_in_range(name, value, 0.001, 100.0); };
    deviation("refinement.thickness_profile.end_deviation", options.end_deviation);
    deviation("refinement.thickness_profile.limb_deviation", options.limb_deviation);
    deviation("refinement.thickness_profile.bone_deviation", options.bone_deviation);
    deviation("refinement.thickness_profile.proportion_deviation", options.proportion_deviation);
    deviation("refinement.thickness_profile.thickness_deviation", options.thickness_deviation);
    deviation("refinement.thickness_profile.heel_deviation", options.heel_deviation);
    core::require_in_range("refinement.thickness_profile.ankle_beyond_heel", options.ankle_beyond_heel, -1.0, 1.0);
    core::require_in_range("refinement.thickness_profile.independent_samples", options.independent_samples, 0.0, 1e4);
}

/// Mean logarithm of a limb's thickness where its coordinate u runs from -0.6 to 1.6 in steps of 0.1: -1 at the tip, 0
/// at wrist or ankle, 1 at elbow or knee, 2 at shoulder or hip. Up to a constant. Calibrated: the straight limbs of 50
/// registered bodies.
using Profile = std::array<double, 23>;
inline constexpr Profile leg_profile{-0.395, -0.357, -0.313, -0.248, -0.129, -0.044, -0.176, -0.328,
                                     -0.295, -0.186, -0.055, 0.077,  0.174,  0.201,  0.167,  0.125,
                                     0.177,  0.238,  0.279,  0.340,  0.417,  0.485,  0.547};
inline constexpr Profile arm_profile{-1.001, -0.339, -0.150, -0.007, -0.063, -0.183, -0.269, -0.257,
                                     -0.207, -0.139, -0.058, 0.031,  0.101,  0.142,  0.161,  0.166,
                                     0.162,  0.164,  0.191,  0.236,  0.279,  0.319,  0.357};

/// Value of the profile at u, linear between its entries; none beyond its ends.
template <typename Scalar>
[[nodiscard]] std::optional<Scalar> value_at(const Profile& profile, Scalar u);

/// Distances of a limb's joints from its tip.
template <typename Scalar = double>
struct Stretch {
    Scalar outer = 0, middle = 0, inner = 0; ///< wrist, elbow, shoulder; or ankle, knee, hip

    /// The limb's coordinate at that distance from the tip, see Profile.
    [[nodiscard]] Scalar u(Scalar from_tip) const {
        if (from_tip < outer) return from_tip / outer - 1;
        if (from_tip < middle) return (from_tip - outer) / (middle - outer);
        return 1 + (from_tip - middle) / (inner - middle);
    }
};

/// Thickness of a limb at one place.
template <typename Scalar = double>
struct Sample {
    Scalar from_tip = 0, log_thickness = 0;
    Scalar weight = 1; ///< 0 to 1: how much it is the limb's own thickness
};

/// What one sample's deviation from the profile costs at most, in squared deviations: beyond three deviations, the
/// usual bound for a normally distributed error, it is a fold or a sleeve and counts no more.
inline constexpr double worst_misfit = 9;

/// How well a stretched profile fits.
template <typename Scalar = double>
struct ProfileFit {
    Scalar misfit = Scalar(worst_misfit); ///< mean squared difference, in squared deviations
    Scalar stoutness = 0;                 ///< mean difference of the logarithms
};

/// Compares the samples with the profile stretched over them. Robust: sections across a fold or a sleeve count for no
/// more than three deviations. Without samples on the profile the misfit is the worst, the stoutness 0. O(samples).
template <typename Scalar>
[[nodiscard]] ProfileFit<Scalar> fit_profile(const std::vector<Sample<Scalar>>& samples, const Profile& profile,
                                             const Stretch<Scalar>& stretch, Scalar deviation);

/// Squared deviations beyond which the end that the trunk tells counts for little: beyond two deviations it is rather
/// the hem of a coat than the fork of the legs.
inline constexpr double far_off = 4;

/// The upper end of a limb as the trunk tells it: distance from the tip, and the standard deviation of the logarithm of
/// the upper bone's length that follows.
template <typename Scalar = double>
struct Top {
    Scalar from_tip = 0, deviation = 0;
    BodyPart part = BodyPart::leg;
};

/// Standard deviation of the logarithm of the upper bone's length on a limb of that stoutness: where legs are stout,
/// they touch, and part lower than others.
template <typename Scalar>
[[nodiscard]] Scalar deviation_of(const Top<Scalar>& top, Scalar stoutness, const Stretch<Scalar>& stretch);

/// Where a leg's centreline turns from calf to foot: see find_heel.
template <typename Scalar = double>
struct Heel {
    Scalar from_tip = 0;
    Scalar bent = 0; ///< how much it counts as turned: 0 up to `BendOptions::from`, 1 from `full` on
};

/// A limb whose thickness is compared with the profile.
template <typename Scalar = double>
struct MatchedLimb {
    std::vector<Sample<Scalar>> samples;
    Stretch<Scalar> rest; ///< the template's own
    std::optional<Top<Scalar>> top;
    std::optional<Heel<Scalar>> heel = {};
    bool is_adapted = false; ///< its proportions are its own: `rest` has them roughly
};

/// The stretch of the profile for each of the limbs, both arms or both legs, that fit their samples, the template's
/// proportions and the tops best, with lower bones equally many times longer than at rest. By search on a grid and on a
/// finer one around its best. O(samples) for each of some hundred stretches per limb.
template <typename Scalar>
[[nodiscard]] std::vector<Stretch<Scalar>> best_stretches(const std::vector<MatchedLimb<Scalar>>& limbs,
                                                          const Profile& profile,
                                                          const ThicknessProfileOptions& options);

/// What the best stretch for that limb alone costs: squared deviations of thickness and lengths. As `best_stretches`,
/// in wider steps at first.
template <typename Scalar>
[[nodiscard]] Scalar least_cost(const MatchedLimb<Scalar>& limb, const Profile& profile,
                                const ThicknessProfileOptions& options);

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/profile_matcher.hpp>
#endif
