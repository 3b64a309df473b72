#pragma once

namespace skelgen::synth {

/// Who a synthetic body is: a person, or a figure with the proportions of a cartoon. Every field has a range that
/// `check_shape` states when it is left.
struct BodyShape {
    double age = 30;           ///< years, 5 to 90; below 18 the proportions are a child's
    double masculinity = 1;    ///< 0 a woman, 1 a man, anything between
    double height = 0;         ///< standing height in metres, 0.8 to 2.3; 0: the average of the age and sex
    double weight = 0;         ///< kilograms, a body mass index of 12 to 60; 0: the average of the height and age
    double muscle = 0.3;       ///< 0 slack to 1 an athlete
    double arm_length = 1;     ///< factor on upper arm and forearm, 0.4 to 1.8
    double leg_length = 1;     ///< factor on thigh and calf, 0.3 to 1.5; the height stays
    double torso_length = 1;   ///< factor on crotch to neck, 0.5 to 1.5; the height stays
    double head_size = 1;      ///< factor on the head, 0.6 to 3.5; the height stays
    double hand_size = 1;      ///< factor on the hands, 0.6 to 2.5
    double foot_size = 1;      ///< factor on the feet and the height of the ankles, 0.6 to 2; the body's height stays
    double limb_girth = 1;     ///< factor on the thickness of arms and legs, 0.6 to 2
    double shoulder_width = 1; ///< factor, 0.6 to 1.6
    double hip_width = 1;      ///< factor, 0.6 to 1.6
    double mouth = 0;          ///< 0: closed lips; else open with a cavity behind them, 1: as far as the throat
};

/// \throws Error usage naming the field, its value and its range.
void check_shape(const BodyShape& shape);

/// The shape with `height` and `weight` filled in where they were 0.
/// \throws Error usage as `check_shape`.
[[nodiscard]] BodyShape complete_shape(const BodyShape& shape);

} // namespace skelgen::synth
