#pragma once

#include <optional>
#include <vector>

#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/centreline.hpp>
#include <skelgen/refinement/end_points.hpp>

namespace skelgen {

/// One chain of the template that ends at a tip (an arm, a leg, the head), and the centreline it lies on.
struct Limb {
    std::vector<int> joints; ///< template joints after the branching one, outwards; the last one ends the limb
    Centreline line;         ///< from the branching node to the tip on the surface
    std::vector<double>
        from_tip; ///< per joint its rest-pose distance from the tip along the template, scaled to this body
    std::optional<double> top_by_trunk; ///< distance of the first joint from the tip as the trunk's shape tells it
    double top_deviation = 0;           ///< standard deviation of that
    double attachment =
        0; ///< arc length on `line` where the limb leaves the trunk: nearer the start sections are not its own
};

/// Rest-pose length to body length, from the geodesic diameter of the body (all in the body's unit).
[[nodiscard]] double template_scale(const SkeletonTemplate& skeleton_template, double geodesic_diameter);

/// Sets the limb's centreline and attachment from its end and `from_tip`: through the centres of the rings at equal
/// geodesic distance from the end, which follow any bend and never stray to another part of the body, then recentred by
/// perpendicular sections.
void draw_limb(Limb& limb, const Slicer& slicer, const EndPoint& end, const CentrelineOptions& options = {});

/// All limbs of an embedded template, in the order of their ends, their joints at the template's distances.
[[nodiscard]] std::vector<Limb> trace_limbs(const Slicer& slicer, const std::vector<EndPoint>& ends,
                                            const SkeletonTemplate& skeleton_template, double scale,
                                            const CentrelineOptions& options = {});

} // namespace skelgen
