#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {

/// Which parts a body is divided into.
enum class PartSet {
    bones, ///< head, neck, chest, abdomen, pelvis; on each side shoulder, upper_arm, forearm, hand, thigh, calf, foot.
           ///< Of an animal tail; on each side upper, lower and foot of fore and hind leg: left_fore_upper
    body,  ///< head (with the neck), torso; on each side upper_arm, forearm, hand, thigh, calf, foot; of an animal
           ///< tail, and legs as above
};

/// The names of the parts, in the order in which they are counted.
[[nodiscard]] std::vector<std::string> part_names(PartSet set, BodyKind plan = BodyKind::human);

namespace detail {

inline constexpr std::array<std::string_view, 5> trunk_parts{"head", "neck", "chest", "abdomen", "pelvis"};
inline constexpr std::array<std::string_view, 7> sided_parts{"shoulder", "upper_arm", "forearm", "hand",
                                                             "thigh",    "calf",      "foot"};
inline constexpr std::array<std::string_view, 2> sides{"left_", "right_"};

/// An animal's, likewise.
inline constexpr std::array<std::string_view, 6> animal_trunk_parts{"head",    "neck",   "chest",
                                                                    "abdomen", "pelvis", "tail"};
inline constexpr std::array<std::string_view, 6> animal_sided_parts{"fore_upper", "fore_lower", "fore_foot",
                                                                    "hind_upper", "hind_lower", "hind_foot"};

/// The animal's part around a bone that begins in a joint of this role.
[[nodiscard]] constexpr std::string_view animal_part(JointRole role) {
    switch (role) {
    case JointRole::pelvis:
    case JointRole::hip_girdle:
        return "pelvis";
    case JointRole::waist:
        return "abdomen";
    case JointRole::chest:
    case JointRole::shoulder_girdle:
        return "chest";
    case JointRole::neck:
        return "neck";
    case JointRole::head:
    case JointRole::ear:
        return "head";
    case JointRole::shoulder:
        return "fore_upper";
    case JointRole::elbow:
        return "fore_lower";
    case JointRole::wrist:
    case JointRole::hand:
        return "fore_foot";
    case JointRole::hip:
        return "hind_upper";
    case JointRole::knee:
        return "hind_lower";
    case JointRole::ankle:
    case JointRole::foot:
        return "hind_foot";
    case JointRole::tail:
        break;
    }
    return "tail";
}

/// Index of a person's part of `PartSet::bones`; `side` 0 for left. The name must be one of those above.
inline int trunk_part(std::string_view name) {
    return static_cast<int>(std::find(trunk_parts.begin(), trunk_parts.end(), name) - trunk_parts.begin());
}
inline int sided_part(std::string_view name, std::size_t side) {
    return static_cast<int>(trunk_parts.size() + side * sided_parts.size()) +
           static_cast<int>(std::find(sided_parts.begin(), sided_parts.end(), name) - sided_parts.begin());
}

} // namespace detail

/// Which end of the body a part is on; a part of the trunk is on none. Fore legs end as arms do.
enum class LimbEnd { none, head, left_hand, right_hand, left_foot, right_foot, tail };

/// A place on the skeleton and how thick the body is there.
template <typename Scalar>
struct AxisPoint {
    Vector3<Scalar> place;
    Scalar radius = 0;
};

/// A straight piece of the skeleton and the part around it.
template <typename Scalar>
struct PartAxis {
    int part = 0;
    LimbEnd end = LimbEnd::none; ///< vertices nearest to this end alone may belong to it; none: all
    AxisPoint<Scalar> from, to;
    Scalar reluctance_before = Scalar(0.05); ///< see `distance_to_axis`
};

/// The axes of all parts of `PartSet::bones`, in the skeleton's coordinates. Pelvis, abdomen and chest share the way
/// from between the hips over the waist to the neck as they do in people who stand. An animal's parts are around the
/// bones that begin in the joints of a role (`animal_part`). \throws Error usage when a joint of
/// human21 or quadruped is missing. O(joints^2).
template <typename Scalar>
[[nodiscard]] std::vector<PartAxis<Scalar>> part_axes(const KinematicSkeleton<Scalar>& skeleton);

/// Distance from a place to an axis, less a quarter of how thick the body is there, so that a trunk's side is the
/// trunk's though an arm hangs beside it: it may be negative. Beyond an axis's end both axes that meet there are
/// equally near: a little is added for how far beyond, so that they share by the plane that halves the angle between
/// them. O(1).
template <typename Scalar>
[[nodiscard]] Scalar distance_to_axis(const Vector3<Scalar>& place, const PartAxis<Scalar>& axis);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/part_axes.hpp>
#endif
