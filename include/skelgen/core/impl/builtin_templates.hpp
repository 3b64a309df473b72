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

/// A four-legged animal between dog and horse, in no unit: the trunk and a mean leg are 1 long together. Calibrated: about
/// the medians of 15 rigs of 3 makers.
inline constexpr std::array<TabulatedJoint, 33> quadruped{{
    {"hips", -1, pelvis, Side::none, {0.0, 0.54, 0.0}},
    {"spine1", 0, waist, Side::none, {0.0, 0.59, 0.18}},
    {"spine2", 1, waist, Side::none, {0.0, 0.59, 0.36}},
    {"chest", 2, chest, Side::none, {0.0, 0.59, 0.52}},
    {"neck1", 3, neck, Side::none, {0.0, 0.64, 0.62}},
    {"neck2", 4, neck, Side::none, {0.0, 0.74, 0.7}},
    {"head", 5, head, Side::none, {0.0, 0.86, 0.78}, 0.08, {0.0, 0.78, 0.98}},
    {"tail1", 0, tail, Side::none, {0.0, 0.6, -0.08}},
    {"tail2", 7, tail, Side::none, {0.0, 0.56, -0.18}},
    {"tail3", 8, tail, Side::none, {0.0, 0.48, -0.26}},
    {"tail4", 9, tail, Side::none, {0.0, 0.4, -0.32}},
    {"left_fore_girdle", 3, shoulder_girdle, Side::left, {0.05, 0.64, 0.45}},
    {"left_fore_upper", 11, shoulder, Side::left, {0.09, 0.5, 0.58}},
    {"left_fore_lower", 12, elbow, Side::left, {0.09, 0.3, 0.54}},
    {"left_fore_ankle", 13, wrist, Side::left, {0.09, 0.14, 0.56}},
    {"left_fore_foot", 14, hand, Side::left, {0.09, 0.04, 0.57}, 0.04, {0.09, 0.0, 0.62}},
    {"right_fore_girdle", 3, shoulder_girdle, Side::right, {-0.05, 0.64, 0.45}},
    {"right_fore_upper", 16, shoulder, Side::right, {-0.09, 0.5, 0.58}},
    {"right_fore_lower", 17, elbow, Side::right, {-0.09, 0.3, 0.54}},
    {"right_fore_ankle", 18, wrist, Side::right, {-0.09, 0.14, 0.56}},
    {"right_fore_foot", 19, hand, Side::right, {-0.09, 0.04, 0.57}, 0.04, {-0.09, 0.0, 0.62}},
    {"left_hind_girdle", 0, hip_girdle, Side::left, {0.05, 0.56, 0.0}},
    {"left_hind_upper", 21, hip, Side::left, {0.09, 0.52, -0.01}},
    {"left_hind_lower", 22, knee, Side::left, {0.09, 0.34, 0.06}},
    {"left_hind_ankle", 23, ankle, Side::left, {0.09, 0.16, -0.08}},
    {"left_hind_foot", 24, foot, Side::left, {0.09, 0.04, -0.05}, 0.04, {0.09, 0.0, 0.0}},
    {"right_hind_girdle", 0, hip_girdle, Side::right, {-0.05, 0.56, 0.0}},
    {"right_hind_upper", 26, hip, Side::right, {-0.09, 0.52, -0.01}},
    {"right_hind_lower", 27, knee, Side::right, {-0.09, 0.34, 0.06}},
    {"right_hind_ankle", 28, ankle, Side::right, {-0.09, 0.16, -0.08}},
    {"right_hind_foot", 29, foot, Side::right, {-0.09, 0.04, -0.05}, 0.04, {-0.09, 0.0, 0.0}},
    {"left_ear", 6, ear, Side::left, {0.04, 0.94, 0.74}},
    {"right_ear", 6, ear, Side::right, {-0.04, 0.94, 0.74}},
}};
// clang-format on

template <std::size_t n>
SkeletonTemplate from_table(const char* name, const std::array<TabulatedJoint, n>& table,
                            BodyKind plan = BodyKind::human) {
    SkeletonTemplate out{name, {}};
    out.plan = plan;
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

inline const std::array<SkeletonTemplate, 3>& builtin_templates() {
    static const std::array<SkeletonTemplate, 3> templates{from_table("human21", human21),
                                                           from_table("pinocchio18", pinocchio18),
                                                           from_table("quadruped", quadruped, BodyKind::quadruped)};
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
