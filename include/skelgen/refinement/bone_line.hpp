#pragma once

#include <optional>
#include <vector>

#include <skelgen/core/line.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/refinement/centreline.hpp>
#include <skelgen/refinement/limbs.hpp>

namespace skelgen::refinement {

/// Which sections tell where a bone is.
struct BoneLineOptions {
    double flatness =
        0.1; ///< a section counts as cylindrical below this flatness of its Gauss map (LF20 section 3.2.1)
};

/// \throws Error usage when an option is out of its range.
inline void validate(const BoneLineOptions& options) {
    core::require_in_range("refinement.bone_line.flatness", options.flatness, 0.0, 1.0);
}

using core::Line;

/// The part of a bone next to its joints that tells nothing of its direction: a section there cuts the flesh of the
/// other bone, too, or the trunk's. A working value, not a measured one.
template <typename Scalar>
inline constexpr Scalar joint_part = Scalar(0.15);

/// The line through the centres of the cylindrical sections of `centreline` between arc lengths `from` < `to`, pointing
/// towards larger arc length; none with fewer than three of them. Sections that do not lie with the others, as those
/// across a fold, do not count. O(k^3) for k sections.
template <typename Scalar>
[[nodiscard]] std::optional<Line<Scalar>> fit_bone(const Centreline<Scalar>& centreline, Scalar from, Scalar to,
                                                   const BoneLineOptions& options = {});

/// The line of the limb's first bone, upper arm or thigh, pointing outwards, by its sections outside of the trunk and
/// `joint_part` away from its joints; the limb must have two joints. None with fewer than three such sections.
template <typename Scalar>
[[nodiscard]] std::optional<Line<Scalar>> fit_first_bone(const Limb<Scalar>& limb, const BoneLineOptions& options = {});

/// Middle of the common perpendicular of two lines; none when they are within two degrees of parallel.
template <typename Scalar>
[[nodiscard]] std::optional<Vector3<Scalar>> meeting_point(const Line<Scalar>& a, const Line<Scalar>& b);

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/bone_line.hpp>
#endif
