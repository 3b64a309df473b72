// Written by `./dev calibrate`: where joints lie along an animal's limbs.
#pragma once

#include <array>

#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::quadruped {

/// A way along an animal's curve: legs from the foot, the trunk from the hind legs, the neck from the fore legs, the
/// tail from the trunk.
enum class Way { fore_leg, hind_leg, trunk, neck, tail };

/// Where a joint lies: at a share of a way's length, and so far off that, in parts of the animal's size.
struct JointPlace {
    JointRole role;
    int ordinal; ///< among the joints of the role, from the trunk on
    Way way;
    double share, forward, up, outward;
};

inline constexpr std::array joint_places{
    JointPlace{JointRole::pelvis, 0, Way::trunk, 0.00283, -0.0808, -0.0361, 0},
    JointPlace{JointRole::waist, 0, Way::trunk, 0.213, -0.00866, 0.025, 0},
    JointPlace{JointRole::waist, 1, Way::trunk, 0.685, -0.000219, -0.00355, 0},
    JointPlace{JointRole::chest, 0, Way::trunk, 0.971, 0.0468, 0.0147, 0},
    JointPlace{JointRole::neck, 0, Way::neck, 0.275, 0.00644, -0.00787, 0},
    JointPlace{JointRole::neck, 1, Way::neck, 0.417, 0.00666, -0.00987, 0},
    JointPlace{JointRole::head, 0, Way::neck, 0.619, -0.00215, 0.00752, 0},
    JointPlace{JointRole::ear, 0, Way::neck, 1, -0.175, 0.0306, 0.0573},
    JointPlace{JointRole::shoulder_girdle, 0, Way::fore_leg, 0.987, -0.0164, 0.107, 0.0559},
    JointPlace{JointRole::shoulder, 0, Way::fore_leg, 0.773, 0.0328, 0.0304, 0.0391},
    JointPlace{JointRole::elbow, 0, Way::fore_leg, 0.566, -0.00832, 0.000861, 0.0091},
    JointPlace{JointRole::wrist, 0, Way::fore_leg, 0.34, 0.0077, 0.00181, 0.000338},
    JointPlace{JointRole::hand, 0, Way::fore_leg, 0.0972, -0.00456, -0.00334, -0.000215},
    JointPlace{JointRole::hip_girdle, 0, Way::hind_leg, 1, 0, 0, 0},
    JointPlace{JointRole::hip, 0, Way::hind_leg, 0.793, -0.0202, 0.0436, 0.0425},
    JointPlace{JointRole::knee, 0, Way::hind_leg, 0.641, 0.0406, -0.00334, 0.0126},
    JointPlace{JointRole::ankle, 0, Way::hind_leg, 0.412, -0.0187, 0.00246, 0.000871},
    JointPlace{JointRole::foot, 0, Way::hind_leg, 0.0866, -0.00298, -0.00182, 0.000828},
    JointPlace{JointRole::tail, 0, Way::tail, 0.303, 0.00739, 0.034, 0},
    JointPlace{JointRole::tail, 1, Way::tail, 0.418, -0.0064, 0.0193, 0},
    JointPlace{JointRole::tail, 2, Way::tail, 0.603, -0.00485, 0.00483, 0},
    JointPlace{JointRole::tail, 3, Way::tail, 0.804, -0.000663, 0.00166, 0},
};

/// Of a role; its last one where there are not so many. Templates keep to that (core/template_rules.hpp).
[[nodiscard]] constexpr const JointPlace& place_of(JointRole role, int ordinal) {
    const JointPlace* out = joint_places.data();
    for (const JointPlace& place : joint_places)
        if (place.role == role && place.ordinal <= ordinal) out = &place;
    return *out;
}

} // namespace skelgen::quadruped
