#include "proportions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <skelgen/core/error.hpp>

namespace skelgen::synth {
namespace {

void check_range(const char* field, double value, double low, double high, const char* unit, bool zero_is_free) {
    if ((value >= low && value <= high) || (zero_is_free && value == 0)) return;
    std::ostringstream what;
    what << field << ' ' << value << " is out of range: give " << low << " to " << high << unit;
    throw Error(ErrorCode::usage, what.str());
}

/// Linear between the rows of a table {x, y}, flat beyond its ends.
template <std::size_t n>
double interpolate(const std::array<std::array<double, 2>, n>& table, double x) {
    if (x <= table.front()[0]) return table.front()[1];
    for (std::size_t i = 1; i < n; ++i)
        if (x <= table[i][0])
            return std::lerp(table[i - 1][1], table[i][1], (x - table[i - 1][0]) / (table[i][0] - table[i - 1][0]));
    return table.back()[1];
}

constexpr std::array<std::array<double, 2>, 7> male_height{
    {{5, 1.10}, {8, 1.28}, {10, 1.38}, {12, 1.49}, {14, 1.63}, {16, 1.73}, {18, 1.75}}};
constexpr std::array<std::array<double, 2>, 7> female_height{
    {{5, 1.09}, {8, 1.27}, {10, 1.38}, {12, 1.51}, {14, 1.59}, {16, 1.62}, {18, 1.63}}};
constexpr std::array<std::array<double, 2>, 5> average_body_mass_index{
    {{5, 15.5}, {8, 16}, {12, 18}, {16, 20.5}, {20, 22.5}}};

double average_height(const BodyShape& shape) {
    return std::lerp(interpolate(female_height, shape.age), interpolate(male_height, shape.age), shape.masculinity);
}

} // namespace

void check_shape(const BodyShape& shape) {
    check_range("age", shape.age, 5, 90, " years", false);
    check_range("masculinity", shape.masculinity, 0, 1, " (woman to man)", false);
    check_range("height", shape.height, 0.8, 2.3, " m", true);
    check_range("muscle", shape.muscle, 0, 1, "", false);
    struct Factor {
        const char* name;
        double value, low, high;
    };
    for (const Factor& factor : {Factor{"arm length", shape.arm_length, 0.4, 1.8},
                                 {"leg length", shape.leg_length, 0.3, 1.5},
                                 {"torso length", shape.torso_length, 0.5, 1.5},
                                 {"head size", shape.head_size, 0.6, 3.5},
                                 {"hand size", shape.hand_size, 0.6, 2.5},
                                 {"foot size", shape.foot_size, 0.6, 2},
                                 {"limb girth", shape.limb_girth, 0.6, 2},
                                 {"shoulder width", shape.shoulder_width, 0.6, 1.6},
                                 {"hip width", shape.hip_width, 0.6, 1.6}})
        check_range(factor.name, factor.value, factor.low, factor.high, " times the average", false);
    check_range("mouth", shape.mouth, 0, 1, " (closed to open as far as the throat)", false);
    const double height = shape.height > 0 ? shape.height : average_height(shape);
    const auto kilograms = [height](double index) { return std::round(10 * index * height * height) / 10; };
    check_range("weight", shape.weight, kilograms(12), kilograms(60), " kg at this height", true);
}

BodyShape complete_shape(const BodyShape& shape) {
    check_shape(shape);
    BodyShape full = shape;
    if (full.height == 0) full.height = average_height(shape);
    if (full.weight == 0) full.weight = interpolate(average_body_mass_index, shape.age) * full.height * full.height;
    return full;
}

Proportions proportions_of(const BodyShape& given) {
    const BodyShape shape = complete_shape(given);
    Proportions p;
    p.maturity = std::clamp((shape.age - 5) / 13, 0.0, 1.0);
    p.masculinity = std::lerp(0.5, shape.masculinity, std::sqrt(p.maturity));
    p.muscle = shape.muscle * (0.3 + 0.7 * p.maturity);
    const double child = 1 - p.maturity, woman = 1 - p.masculinity;
    p.fat = shape.weight / (shape.height * shape.height) / interpolate(average_body_mass_index, shape.age) - 1;

    // Of a man of 1.75 m, the sum of the heights scaled to the height asked for at the end. Grown-up lengths agree with
    // the mean that SMPL's joint regressor finds in registered scans of people: hips close together and low, the chest
    // joint below the shoulders, the head joint low in the skull and forward of the neck. The waist is the project's
    // own, a little less than a third of the way from the middle of the hips to the neck.
    const double leg = shape.leg_length * (1 - 0.10 * child);
    const double torso = shape.torso_length * (1 + 0.02 * child + 0.01 * woman);
    const double head = shape.head_size * (1 + 0.42 * child);
    p.ankle_height = 0.082 * shape.foot_size;
    p.calf = 0.405 * leg;
    p.thigh = 0.378 * leg;
    p.hip_drop = 0.087 * torso;
    p.lower_spine = 0.097 * torso;
    p.upper_spine = 0.204 * torso;
    p.neck_base = 0.225 * torso;
    p.neck = (0.049 - 0.015 * child) * head;
    p.head_top = 0.216 * head;
    const double height = p.ankle_height + p.calf + p.thigh + p.hip_drop + p.lower_spine + p.upper_spine + p.neck_base +
                          p.neck + p.head_top;
    const double fit = shape.height / height;
    for (double* length : {&p.ankle_height, &p.calf, &p.thigh, &p.hip_drop, &p.lower_spine, &p.upper_spine,
                           &p.neck_base, &p.neck, &p.head_top})
        *length *= fit;

    p.scale = shape.height / 1.75;
    p.limb_scale = p.scale * shape.limb_girth;
    p.head_scale = head * fit;
    p.hand_scale = 1.08 * p.scale * shape.hand_size * (1 + 0.04 * child) * (1 - 0.05 * woman);
    p.foot_scale = p.ankle_height / 0.082 * (1 + 0.02 * child) * (1 - 0.05 * woman);
    p.shoulder_factor = shape.shoulder_width;
    p.hip_factor = shape.hip_width;
    p.mouth = shape.mouth;
    p.hip_half_width = p.scale * shape.hip_width * (0.067 + 0.011 * woman - 0.003 * child) * (1 + 0.12 * p.fat);
    p.shoulder_half_width = p.scale * shape.shoulder_width *
                            (0.197 - 0.014 * woman + 0.008 * p.muscle - 0.006 * child) * (1 + 0.10 * p.fat);
    p.shoulder_rise = 0.114 * p.scale * shape.torso_length;
    const double arm = p.scale * shape.arm_length * (1 - 0.06 * child);
    p.upper_arm = 0.265 * arm;
    p.forearm = 0.249 * arm;
    p.palm = 0.082 * p.hand_scale;
    return p;
}

} // namespace skelgen::synth
