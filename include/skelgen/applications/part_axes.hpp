#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::applications {
namespace detail {

inline constexpr std::array<std::string_view, 5> trunk_parts{"head", "neck", "chest", "abdomen", "pelvis"};
inline constexpr std::array<std::string_view, 7> sided_parts{"shoulder", "upper_arm", "forearm", "hand",
                                                             "thigh",    "calf",      "foot"};
inline constexpr std::array<std::string_view, 2> sides{"left_", "right_"};

/// Index of a part of `PartSet::bones`; `side` 0 for left. The name must be one of those above.
inline int trunk_part(std::string_view name) {
    return static_cast<int>(std::find(trunk_parts.begin(), trunk_parts.end(), name) - trunk_parts.begin());
}
inline int sided_part(std::string_view name, std::size_t side) {
    return static_cast<int>(trunk_parts.size() + side * sided_parts.size()) +
           static_cast<int>(std::find(sided_parts.begin(), sided_parts.end(), name) - sided_parts.begin());
}

} // namespace detail

/// Which end of the body a part is on; a part of the trunk is on none.
enum class LimbEnd { none, head, left_hand, right_hand, left_foot, right_foot };

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
/// from between the hips over the waist to the neck as they do in people who stand. \throws Error usage when a joint of
/// human21 is missing. O(joints).
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
