#pragma once

#include <skelgen/core/curve_skeleton.hpp>

namespace skelgen::evaluation {

/// How a curve skeleton differs from the axis that is known. Distances are in local radii: of the axis where it is
/// nearest; within 1.5 times a junction's radius (of its thickest tube) in the junction's.
struct CurveError {
    double hausdorff = 0; ///< largest distance from either one to the other; what is within 1.5 local radii of an end
                          ///< of the axis or of the curve does not count
    double mean = 0;      ///< along both, of the distances that count
    double radius_error = 0; ///< largest difference of a node's radius from the axis's nearest to it, over the latter;
                             ///< nodes within 2.5 radii of a junction or an end do not count
    double end_error = 0;    ///< largest distance from an end of the axis to the nearest one of the curve
    int ends = 0, true_ends = 0;     ///< nodes with one edge
    int cycles = 0, true_cycles = 0; ///< independent ones
};

/// Compares a curve with the axis. Distances are infinite where one has nodes or ends and the other has none.
/// O(length of both, in radii, times the number of edges of the other).
/// \throws Error bad_input when the axis has no edges, or not one radius for each node.
[[nodiscard]] CurveError measure_curve(const CurveSkeleton<double>& curve, const CurveSkeleton<double>& truth);

} // namespace skelgen::evaluation
