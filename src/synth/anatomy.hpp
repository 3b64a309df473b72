#pragma once

#include <array>
#include <optional>
#include <vector>

#include <skelgen/synth/hand_shape.hpp>
#include <skelgen/synth/pose.hpp>

#include "kinematics.hpp"
#include "primitives.hpp"
#include "proportions.hpp"

/// What is on the bones, part by part, in the part's rest coordinates: x to the left (outwards on a limb), y
/// backwards, z up (down the limb where it says so). All tables are those of a man or a woman of 1.75 m.
namespace skelgen::synth {

/// Chest, belly, pelvis and neck; world coordinates of the rest pose. Shoulder blades, collar bones and buttocks
/// follow the arms and thighs of `skeleton`.
[[nodiscard]] std::vector<Blob> trunk(const Proportions& proportions, const PosedSkeleton& skeleton);

/// Skull, face and ears around the head joint.
[[nodiscard]] std::vector<Blob> head(const Proportions& proportions);

/// What is hollow behind parted lips, around the head joint: as deep as `proportions.mouth` says, from halfway on down
/// towards the throat.
[[nodiscard]] std::vector<Blob> mouth(const Proportions& proportions);

/// z down the limb from the upper joint. Every section is symmetric about the bone between the joints.
[[nodiscard]] std::vector<Blob> upper_arm(const Proportions& proportions);
[[nodiscard]] std::vector<Blob> forearm(const Proportions& proportions);
[[nodiscard]] std::vector<Blob> thigh(const Proportions& proportions);
[[nodiscard]] std::vector<Blob> calf(const Proportions& proportions);

/// A digit's bones and how thick it is at its end.
struct HandDigit {
    std::array<Vec3, hands::phalanges + 1> places; ///< its joints and the middle of its round end
    double end_radius = 0;
    bool is_sunk = false; ///< its end lies in the palm, the thumb's in a finger

    /// On the surface.
    [[nodiscard]] Vec3 tip() const {
        return places.back() + end_radius * (places.back() - places[places.size() - 2]).normalized();
    }
};

struct Hand {
    std::vector<Blob> blobs;
    Vec3 fingertip;                ///< of the middle finger
    std::vector<HandDigit> digits; ///< from the thumb on
    std::optional<RoundCone> held; ///< a thing of its own
};

/// z from the wrist to the fingers, -x the palm, -y the thumb. `fingers`: bend curls and side spreads them all.
[[nodiscard]] Hand hand(const Proportions& proportions, const JointAngles& fingers, const HandShape& shape = {});

struct Foot {
    std::vector<Blob> blobs;
    Vec3 toe; ///< tip of the big toe
};

/// Around the ankle, z up; `toes_up` in degrees bends the toes at the ball.
[[nodiscard]] Foot foot(const Proportions& proportions, double toes_up);

/// The lengthwise outline of a limb: its rings along z.
[[nodiscard]] const Tube& outline(const std::vector<Blob>& limb);

} // namespace skelgen::synth
