#pragma once

#include <skelgen/synth/shape.hpp>

namespace skelgen::synth {

/// Lengths of one person, in metres, and how much of what is on the bones.
struct Proportions {
    double scale = 1;      ///< trunk and limbs relative to a man of 1.75 m
    double limb_scale = 1; ///< thickness of arms and legs, likewise
    double head_scale = 1; ///< head, neck upwards
    double hand_scale = 1;
    double foot_scale = 1;

    double ankle_height = 0; ///< above the sole
    double calf = 0;
    double thigh = 0;
    double hip_half_width = 0; ///< middle to thigh joint
    double hip_drop = 0;       ///< hip below crotch
    double lower_spine = 0;    ///< crotch to waist
    double upper_spine = 0;    ///< waist to chest
    double neck_base = 0;      ///< chest to neck
    double neck = 0;           ///< neck to head
    double head_top = 0;       ///< head to the top of the skull
    double shoulder_half_width = 0;
    double shoulder_rise = 0; ///< shoulder above chest
    double upper_arm = 0;
    double forearm = 0;
    double palm = 0; ///< wrist to the middle of the knuckles

    double fat = 0;         ///< body mass index relative to the average, minus 1: -0.4 starved, 0, +1.5 very heavy
    double muscle = 0;      ///< 0 to 1
    double masculinity = 0; ///< 0 to 1 of a grown-up; both 0.5 in a small child
    double maturity = 1;    ///< 0 at 5 years, 1 grown up
    double shoulder_factor = 1;
    double hip_factor = 1;
    double mouth = 0; ///< 0 closed, 1 open as far as the throat
};

/// \throws Error usage as `check_shape`.
[[nodiscard]] Proportions proportions_of(const BodyShape& shape);

} // namespace skelgen::synth
