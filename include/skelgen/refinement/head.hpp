#pragma once

#include <optional>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/refinement/cross_section.hpp>

namespace skelgen::refinement {

/// Constants of the head's measurement (RB12).
struct HeadOptions {
    double slice = 0.05;     ///< between slices, as part of the distance from the neck joint to the top of the head
    double throat = 0.8;     ///< a slice whose diameter is below this part of the largest one above it is the throat's
    double longest = 2;      ///< in the same unit: what is longer is no head alone, but hands on it or hair
    double joint_back = 0.1; ///< how far behind the centroid the skull sits on the spine, in diameters
};

/// \throws Error usage when an option is out of its range.
inline void validate(const HeadOptions& options) {
    core::require_in_range("refinement.head.slice", options.slice, 0.002, 1.0);
    core::require_in_range("refinement.head.throat", options.throat, 0.0, 1.0);
    core::require_in_range("refinement.head.longest", options.longest, 0.0, 100.0);
    core::require_in_range("refinement.head.joint_back", options.joint_back, -1.0, 1.0);
}

/// Size and orientation of a head by its slices.
template <typename Scalar = double>
struct HeadShape {
    Vector3<Scalar> up = Vector3<Scalar>::Zero(); ///< unit, from the neck joint towards the middle of the head
    Vector3<Scalar> forward =
        Vector3<Scalar>::Zero(); ///< unit, along the head's longer diameter, to the side of the face
    Vector3<Scalar> centroid = Vector3<Scalar>::Zero(); ///< mean of the slices' centres weighted by perimeter
    Vector3<Scalar> joint =
        Vector3<Scalar>::Zero(); ///< of the skull on the spine: at the nose's height, behind the centroid
    std::optional<Vector3<Scalar>>
        throat; ///< centre of the neck's thinnest section; none where it is not clearly thinner than what is around it
    Scalar length = 0;  ///< front to back
    Scalar breadth = 0; ///< side to side
    Scalar size =
        1; ///< of the head relative to an adult's, whose neck joint were at `neck`; the smaller of two measures
    Scalar frontness = 0; ///< how clearly the head faces `forward`: 0 not at all
};

/// Cuts the head into slices across the line from `neck` to the middle of the head, from `top` down to the throat,
/// where the slices' diameter has shrunk or their longer axis turns, and measures them (RB12). Round ones are as long
/// as they are broad and show no front: its frontness is 0, its joint the centroid. None when there are fewer than five
/// slices, or longer ones than a head's. O(slices (n + m)).
template <typename Scalar>
[[nodiscard]] std::optional<HeadShape<Scalar>> measure_head(const Slicer<Scalar>& slicer, const Vector3<Scalar>& top,
                                                            const Vector3<Scalar>& neck,
                                                            const HeadOptions& options = {});

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/head.hpp>
#endif
