#pragma once

#include <skelgen/core/builtin_templates.hpp>

#include <algorithm>
#include <array>

#include <skelgen/core/error.hpp>
#include <skelgen/core/header_only.hpp>

namespace skelgen {
namespace core::detail {

/// One joint of a table. Ends of limbs have a radius and a tip.
struct TabulatedJoint {
    const char* name;
    int parent;
    JointRole role;
    Side side;
    std::array<double, 3> position;
    double radius = 0;
    std::array<double, 3> tip = {};
};

using enum JointRole;

// clang-format off
/// The joints of an adult in metres, arms stretched out to the sides. Calibrated: mean bone lengths of 50 registered
/// bodies (5 people).
inline constexpr std::array<TabulatedJoint, 21> human21{{
    {"crotch", -1, pelvis, Side::none, {0.0, 0.953, 0.0}},
    {"waist", 0, waist, Side::none, {0.0, 1.0566, -0.01}},
    {"chest", 1, chest, Side::none, {0.0, 1.274, -0.02}},
    {"neck", 2, neck, Side::none, {0.0, 1.492, -0.02}},
    {"head", 3, head, Side::none, {0.0, 1.565, 0.02}, 0.095, {0.0, 1.777, 0.02}},
    {"left_shoulder", 2, shoulder, Side::left, {0.185, 1.424, -0.02}},
    {"left_elbow", 5, elbow, Side::left, {0.453, 1.424, -0.02}},
    {"left_wrist", 6, wrist, Side::left, {0.705, 1.424, -0.02}},
    {"left_hand", 7, hand, Side::left, {0.794, 1.424, -0.02}, 0.035, {0.897, 1.424, -0.02}},
    {"right_shoulder", 2, shoulder, Side::right, {-0.185, 1.424, -0.02}},
    {"right_elbow", 9, elbow, Side::right, {-0.453, 1.424, -0.02}},
    {"right_wrist", 10, wrist, Side::right, {-0.705, 1.424, -0.02}},
    {"right_hand", 11, hand, Side::right, {-0.794, 1.424, -0.02}, 0.035, {-0.897, 1.424, -0.02}},
    {"left_hip", 0, hip, Side::left, {0.071, 0.87, 0.0}},
    {"left_knee", 13, knee, Side::left, {0.071, 0.481, 0.0}},
    {"left_ankle", 14, ankle, Side::left, {0.071, 0.071, -0.02}},
    {"left_foot", 15, foot, Side::left, {0.081, 0.02, 0.105}, 0.045, {0.09, 0.015, 0.185}},
    {"right_hip", 0, hip, Side::right, {-0.071, 0.87, 0.0}},
    {"right_knee", 17, knee, Side::right, {-0.071, 0.481, 0.0}},
    {"right_ankle", 18, ankle, Side::right, {-0.071, 0.071, -0.02}},
    {"right_foot", 19, foot, Side::right, {-0.081, 0.02, 0.105}, 0.045, {-0.09, 0.015, 0.185}},
}};

/// The 18 joints of BP07, with the proportions of human21.
inline constexpr std::array<TabulatedJoint, 18> pinocchio18{{
    {"hips", -1, pelvis, Side::none, {0.0, 0.953, 0.0}},
    {"back", 0, waist, Side::none, {0.0, 1.0566, -0.01}},
    {"shoulders", 1, chest, Side::none, {0.0, 1.274, -0.02}},
    {"head", 2, head, Side::none, {0.0, 1.565, 0.02}, 0.095, {0.0, 1.777, 0.02}},
    {"left_shoulder", 2, shoulder, Side::left, {0.185, 1.424, -0.02}},
    {"left_elbow", 4, elbow, Side::left, {0.453, 1.424, -0.02}},
    {"left_hand", 5, hand, Side::left, {0.794, 1.424, -0.02}, 0.035, {0.897, 1.424, -0.02}},
    {"right_shoulder", 2, shoulder, Side::right, {-0.185, 1.424, -0.02}},
    {"right_elbow", 7, elbow, Side::right, {-0.453, 1.424, -0.02}},
    {"right_hand", 8, hand, Side::right, {-0.794, 1.424, -0.02}, 0.035, {-0.897, 1.424, -0.02}},
    {"left_thigh", 0, hip, Side::left, {0.071, 0.87, 0.0}},
    {"left_knee", 10, knee, Side::left, {0.071, 0.481, 0.0}},
    {"left_ankle", 11, ankle, Side::left, {0.071, 0.071, -0.02}},
    {"left_foot", 12, foot, Side::left, {0.081, 0.02, 0.105}, 0.045, {0.09, 0.015, 0.185}},
    {"right_thigh", 0, hip, Side::right, {-0.071, 0.87, 0.0}},
    {"right_knee", 14, knee, Side::right, {-0.071, 0.481, 0.0}},
    {"right_ankle", 15, ankle, Side::right, {-0.071, 0.071, -0.02}},
    {"right_foot", 16, foot, Side::right, {-0.081, 0.02, 0.105}, 0.045, {-0.09, 0.015, 0.185}},
}};
// clang-format on

template <std::size_t n>
SkeletonTemplate from_table(const char* name, const std::array<TabulatedJoint, n>& table) {
    SkeletonTemplate out{name, {}};
    for (const TabulatedJoint& row : table) {
        TemplateJoint& joint = out.joints.emplace_back();
        joint.name = row.name;
        joint.parent = row.parent;
        joint.role = row.role;
        joint.side = row.side;
        joint.position = Vector3<double>(row.position.data());
        joint.radius = row.radius;
        if (ends_limb(row.role)) joint.tip = Vector3<double>(row.tip.data());
    }
    return out;
}

inline const std::array<SkeletonTemplate, 2>& builtin_templates() {
    static const std::array<SkeletonTemplate, 2> templates{from_table("human21", human21),
                                                           from_table("pinocchio18", pinocchio18)};
    return templates;
}

} // namespace core::detail

SKELGEN_INLINE std::vector<std::string> builtin_template_names() {
    std::vector<std::string> names;
    for (const SkeletonTemplate& each : core::detail::builtin_templates()) names.push_back(each.name);
    return names;
}

SKELGEN_INLINE const SkeletonTemplate& builtin_template(std::string_view name) {
    std::string known;
    for (const SkeletonTemplate& each : core::detail::builtin_templates()) {
        if (each.name == name) return each;
        known += (known.empty() ? "" : ", ") + each.name;
    }
    throw Error(ErrorCode::usage, "there is no built-in template '" + std::string(name) + "': use one of " + known);
}

} // namespace skelgen
