#pragma once

#include <skelgen/refinement/pelvis.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <skelgen/refinement/profile_matcher.hpp>

namespace skelgen::refinement {
namespace detail {

/// Hips whose line is nearer to the axis than this part of it (a cosine) are not those of one pelvis.
template <typename Scalar>
inline constexpr Scalar least_level = Scalar(0.3);

/// The thighs' lines are right or, behind folded flesh, altogether wrong: where the middle between their hips is so
/// many thighs off, what they say counts half, and hardly at all beyond. A working value.
template <typename Scalar>
inline constexpr Scalar thigh_lines_deviation = Scalar(0.25);

/// By how much thighs' lines and trunk usually differ: in thighs, where the middle between the hips is; in the hips'
/// slope, a tangent (7 degrees); in the direction across, radians (12 degrees). Calibrated, as the next one: on a
/// person who bends in 36 poses, and on five upright ones.
template <typename Scalar>
inline constexpr Scalar usual_aside = Scalar(0.06);
template <typename Scalar>
inline constexpr Scalar usual_slope = Scalar(0.12);
template <typename Scalar>
inline constexpr Scalar usual_twist = Scalar(0.21);

/// Where they differ by little, the trunk tells so many times better than the thighs' lines.
template <typename Scalar>
inline constexpr Scalar exactness_of_trunk = Scalar(3);

/// Thighs' hips less than this far below the trunk's place, in thighs, say nothing more of how it bends.
template <typename Scalar>
inline constexpr Scalar least_below = Scalar(0.2);

/// Sections that much narrower one way than the other tell plainly where the trunk's sides are: a third, as people's
/// waists are.
template <typename Scalar>
inline constexpr Scalar plainly_wide = Scalar(0.3);

/// A pelvis as it is being found.
template <typename Scalar>
struct Pelvis {
    Vector3<Scalar> middle; ///< between the hips
    Vector3<Scalar> across; ///< unit, to the first leg's hip
    Vector3<Scalar> up;     ///< unit, its own
};

/// A unit vector near `up` at right angles to the unit vector `across`.
template <typename Scalar>
Vector3<Scalar> level_to(const Vector3<Scalar>& across, const Vector3<Scalar>& up) {
    return (up - up.dot(across) * across).normalized();
}

/// Finds the pelvis of one body; refers to what it is given.
template <typename Scalar>
class PelvisFinder {
public:
    PelvisFinder(const Placement<Scalar>& placement, std::vector<const Limb<Scalar>*> legs,
                 const TrunkAxis<Scalar>& axis, const PelvisOptions& options)
        : placement_(placement), legs_(std::move(legs)), axis_(axis), options_(options),
          thigh_(placement.rest_distance(legs_[0]->joints[0], legs_[0]->joints[1])), girdle_(hip(0) - hip(1)),
          girdle_middle_(Scalar(0.5) * (hip(0) + hip(1))) {}

    /// None where the hips lie along the axis.
    [[nodiscard]] std::optional<Pelvis<Scalar>> find() const {
        constexpr int rounds = 3; // in the first one the hips are not known, nor the flexion; the third changes little
        const Vector3<Scalar> level = without_rise(girdle_);
        if (!(level.norm() > least_level<Scalar> * girdle_.norm())) return std::nullopt;
        Pelvis<Scalar> pelvis{axis_.place - Scalar(0.5) * thigh_ * axis_.up, level.normalized(), axis_.up};
        Vector3<Scalar> by_trunk = pelvis.middle;
        Scalar flexion = 0;
        for (int round = 0; round < rounds; ++round) {
            pelvis.across = hips_line(by_trunk);
            const Vector3<Scalar> ahead = without_rise(pelvis.across).normalized().cross(axis_.up);
            const Scalar faces = std::clamp(facing(*legs_[0], ahead) + facing(*legs_[1], ahead), Scalar(-1), Scalar(1));
            if (round > 0) flexion = least_flexion(pelvis, faces < 0 ? Vector3<Scalar>(-ahead) : ahead);
            const Scalar lean = std::atan(static_cast<Scalar>(options_.tilt));
            const Scalar bend = static_cast<Scalar>(options_.rhythm) * flexion;
            const Vector3<Scalar> unbent = leaning_back(faces * lean, ahead);
            const Vector3<Scalar> bent = leaning_back(faces * (lean + bend), ahead);
            pelvis.up = level_to(pelvis.across, bent);
            const Vector3<Scalar> chord = (unbent + pelvis.up).normalized();
            const Scalar hips_below = below(pelvis, chord, flexion);
            by_trunk = axis_.place - hips_below * chord;
            const Vector3<Scalar> off_chord = aside(by_trunk, chord);
            pelvis.middle = by_trunk + off_chord;
            // As the chord turns, so does the pelvis; not where the place is down in a skirt, whose hem seems the fork.
            const Scalar lever = std::max(hips_below, least_below<Scalar> * thigh_);
            const Vector3<Scalar> turned = (lever * chord - off_chord).normalized();
            pelvis.up = level_to<Scalar>(pelvis.across, pelvis.up + turned - chord);
        }
        return pelvis;
    }

    [[nodiscard]] Vector3<Scalar> to_hip(const Pelvis<Scalar>& pelvis) const {
        return Scalar(0.5) * girdle_.norm() * pelvis.across;
    }

private:
    [[nodiscard]] Vector3<Scalar> hip(std::size_t leg) const { return placement_.at(legs_[leg]->joints[0]); }
    [[nodiscard]] Vector3<Scalar> knee(std::size_t leg) const { return placement_.at(legs_[leg]->joints[1]); }

    [[nodiscard]] Vector3<Scalar> without_rise(const Vector3<Scalar>& v) const {
        return v - v.dot(axis_.up) * axis_.up;
    }

    [[nodiscard]] Vector3<Scalar> leaning_back(Scalar angle, const Vector3<Scalar>& ahead) const {
        return std::cos(angle) * axis_.up - std::sin(angle) * ahead;
    }

    /// How far what the thighs' lines say can be relied on, by how far off their hips lie `middle`; 0 to 1.
    [[nodiscard]] Scalar trust_in_thighs(const Vector3<Scalar>& middle) const {
        const Scalar off = (girdle_middle_ - middle).norm() / (thigh_lines_deviation<Scalar> * thigh_);
        const Scalar fourth = off * off * off * off;
        return 1 / (1 + fourth * fourth);
    }

    /// The part of what thighs' lines and trunk differ by that the thighs' lines are followed, 0 to 1: the larger that
    /// `difference`, in what is usual, the more it is the trunk that bends.
    [[nodiscard]] static Scalar share_of_thighs(Scalar trust, Scalar difference) {
        const Scalar exactness = trust * (1 + trust * difference * difference);
        return exactness / (exactness + exactness_of_trunk<Scalar>);
    }

    /// How far the pelvis's middle lies off the chord through `middle`, by the middle between the thighs' hips.
    [[nodiscard]] Vector3<Scalar> aside(const Vector3<Scalar>& middle, const Vector3<Scalar>& chord) const {
        const Vector3<Scalar> off = girdle_middle_ - middle, across = off - off.dot(chord) * chord;
        return share_of_thighs(trust_in_thighs(middle), across.norm() / (usual_aside<Scalar> * thigh_)) * across;
    }

    /// The hips' line: level to the trunk between what the thighs' lines and the trunk's sections say, the less with
    /// the latter the more the trunk is twisted; and sloping as the thighs' hips do, and as their middle lies off the
    /// trunk.
    [[nodiscard]] Vector3<Scalar> hips_line(const Vector3<Scalar>& middle) const {
        const Scalar trust = trust_in_thighs(middle);
        const Vector3<Scalar> level = without_rise(girdle_).normalized();
        Vector3<Scalar> sections = without_rise(axis_.across) / plainly_wide<Scalar>;
        if (sections.norm() > 1) sections.normalize();
        if (sections.dot(level) < 0) sections = -sections;
        const Scalar twist = std::atan2(sections.cross(level).norm(), sections.dot(level)) / usual_twist<Scalar>;
        sections /= 1 + trust * twist * twist;
        const Vector3<Scalar> between = (trust * level + sections).normalized();
        const Vector3<Scalar> down = girdle_middle_ - axis_.place;
        const Scalar by_hips = girdle_.dot(axis_.up) / without_rise(girdle_).norm();
        const Scalar by_middle = down.dot(level) / std::max(-down.dot(axis_.up), least_below<Scalar> * thigh_);
        const Scalar slope = Scalar(0.5) * (by_hips + by_middle);
        return (between + share_of_thighs(trust, slope / usual_slope<Scalar>) * slope * axis_.up).normalized();
    }

    /// How much a leg says that `ahead` is where the body faces: its foot and its thigh point there, or away. -2 to 2.
    [[nodiscard]] Scalar facing(const Limb<Scalar>& leg, const Vector3<Scalar>& ahead) const {
        const Vector3<Scalar> thigh = placement_.at(leg.joints[1]) - placement_.at(leg.joints[0]);
        Scalar out = thigh.normalized().dot(ahead);
        if (leg.missing > 0) return out;
        if (const auto ankle = find_in_limb(leg, placement_.skeleton_template(), JointRole::ankle))
            out += (tip_of(leg) - placement_.at(leg.joints[*ankle])).normalized().dot(ahead);
        return out;
    }

    /// By how much both thighs are flexed at least against the prolonged trunk, radians, 0 at least: one alone turns
    /// the pelvis little, which stands on the other.
    [[nodiscard]] Scalar least_flexion(const Pelvis<Scalar>& pelvis, const Vector3<Scalar>& ahead) const {
        const auto flexion = [&](std::size_t leg, const Vector3<Scalar>& side) {
            const Vector3<Scalar> thigh = knee(leg) - (pelvis.middle + side);
            return std::atan2(thigh.dot(ahead), -thigh.dot(axis_.up));
        };
        const Vector3<Scalar> side = to_hip(pelvis);
        return std::max(Scalar(0), std::min(flexion(0, side), flexion(1, Vector3<Scalar>(-side))));
    }

    /// How far below `axis.place` along `chord` the hips lie: what the fork and the lengths of the thighs together make
    /// likely (least squares; the fork with a Cauchy weight).
    [[nodiscard]] Scalar below(const Pelvis<Scalar>& pelvis, const Vector3<Scalar>& chord, Scalar flexion) const {
        constexpr int rounds = 10; // of Gauss-Newton, reweighted: it settles within them
        const auto precision = [&](double deviation) {
            const Scalar length = static_cast<Scalar>(deviation) * thigh_;
            return 1 / (length * length);
        };
        const Scalar above_fork =
            static_cast<Scalar>(options_.hips_above_fork) - static_cast<Scalar>(options_.fork_rise) * flexion;
        const Vector3<Scalar> fork =
            axis_.crossings.empty() ? axis_.fork : fork_along(axis_.crossings, axis_.place, pelvis.up);
        const Scalar by_fork = ((axis_.place - fork).dot(pelvis.up) - above_fork * thigh_) / chord.dot(pelvis.up);
        const Vector3<Scalar> side = to_hip(pelvis);
        Scalar below = by_fork;
        for (int round = 0; round < rounds; ++round) {
            // Far from where the thighs' lengths put the hips, it is rather the hem of a coat than the fork of the
            // legs.
            const Scalar off = below - by_fork, exact = precision(options_.fork_deviation);
            const Scalar weight =
                axis_.is_hem ? Scalar(0) : exact / (1 + exact * off * off / static_cast<Scalar>(far_off));
            Scalar gradient = weight * off, curvature = weight;
            for (std::size_t leg = 0; leg < legs_.size(); ++leg) {
                const Vector3<Scalar> hip_at = axis_.place - below * chord + (leg == 0 ? side : Vector3<Scalar>(-side));
                const Vector3<Scalar> bone = hip_at - knee(leg);
                const Scalar slope = -bone.normalized().dot(chord); // of the bone's length
                const Scalar longer = bone.norm() - (legs_[leg]->from_tip[0] - legs_[leg]->from_tip[1]);
                gradient += precision(options_.thigh_deviation) * longer * slope;
                curvature += precision(options_.thigh_deviation) * slope * slope;
            }
            below -= gradient / curvature;
        }
        return below;
    }

    const Placement<Scalar>& placement_;
    std::vector<const Limb<Scalar>*> legs_;
    const TrunkAxis<Scalar>& axis_;
    const PelvisOptions& options_;
    Scalar thigh_;
    Vector3<Scalar> girdle_;        ///< from hip to hip as the thighs' lines have them
    Vector3<Scalar> girdle_middle_; ///< between those hips
};

} // namespace detail

template <typename Scalar>
std::optional<Placement<Scalar>> place_pelvis(Placement<Scalar> placement, const std::vector<Limb<Scalar>>& limbs,
                                              const TrunkAxis<Scalar>& axis, const PelvisOptions& options) {
    std::vector<const Limb<Scalar>*> legs;
    for (const std::size_t leg : find_legs(limbs, placement.skeleton_template())) legs.push_back(&limbs[leg]);
    if (legs.empty()) return std::nullopt;
    const detail::PelvisFinder<Scalar> finder(placement, legs, axis, options);
    const auto pelvis = finder.find();
    if (!pelvis) return std::nullopt;
    const Vector3<Scalar> to_hip = finder.to_hip(*pelvis);
    Placement<Scalar> out = placement;
    out.put(legs[0]->joints[0], pelvis->middle + to_hip);
    out.put(legs[1]->joints[0], pelvis->middle - to_hip);
    const int root = placement.find(JointRole::pelvis);
    const double higher =
        placement.skeleton_template().joint(root).position.y() - placement.rest_height(JointRole::hip);
    out.put(root, pelvis->middle + placement.scale() * static_cast<Scalar>(higher) * pelvis->up);
    return out;
}

} // namespace skelgen::refinement
