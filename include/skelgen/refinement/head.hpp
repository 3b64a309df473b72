#pragma once

#include <optional>

#include <skelgen/core/mesh.hpp>
#include <skelgen/refinement/cross_section.hpp>

namespace skelgen {

/// Constants of the head's measurement (RB12).
struct HeadOptions {
    double slice = 0.05;     ///< between slices, as part of the distance from the neck joint to the top of the head
    double throat = 0.8;     ///< a slice whose diameter is below this part of the largest one above it is the throat's
    double longest = 2;      ///< in the same unit: what is longer is no head alone, but hands on it or hair
    double joint_back = 0.1; ///< how far behind the centroid the skull sits on the spine, in diameters
};

/// Size and orientation of a head by its slices.
struct HeadShape {
    Vector3<double> up = Vector3<double>::Zero(); ///< unit, from the neck joint towards the middle of the head
    Vector3<double> forward =
        Vector3<double>::Zero(); ///< unit, along the head's longer diameter, to the side of the face
    Vector3<double> centroid = Vector3<double>::Zero(); ///< mean of the slices' centres weighted by perimeter
    Vector3<double> joint =
        Vector3<double>::Zero(); ///< of the skull on the spine: at the nose's height, behind the centroid
    std::optional<Vector3<double>>
        throat; ///< centre of the neck's thinnest section; none where it is not clearly thinner than what is around it
    double length = 0;  ///< front to back
    double breadth = 0; ///< side to side
    double size =
        1; ///< of the head relative to an adult's, whose neck joint were at `neck`; the smaller of two measures
    double frontness = 0; ///< how clearly the head faces `forward`: 0 not at all
};

/// Cuts the head into slices across the line from `neck` to the middle of the head, from `top` down to the throat,
/// where the slices' diameter has shrunk or their longer axis turns, and measures them (Rau & Brunnett 2012). None when
/// there are fewer than five slices, when they are round, so that there is no front to see, or longer than a head's.
/// O(slices (n + m)).
[[nodiscard]] std::optional<HeadShape> measure_head(const Slicer& slicer, const Vector3<double>& top,
                                                    const Vector3<double>& neck, const HeadOptions& options = {});

} // namespace skelgen
