#pragma once

// What can be told of how well a rig bends, from the rig alone.

#include <skelgen/applications/rig.hpp>

namespace skelgen::rigs {

/// Of one rig in the T-pose.
struct Quality {
    double worst_sum = 0;     ///< largest difference of a vertex's weights from the sum of 1
    double two_limbs = 0;     ///< share of the vertices that follow two limbs by more than 1 % each
    int islands = 0;          ///< vertices that follow most a joint that none of their neighbours follows most
    double stretch = 0;       ///< largest ratio of an edge's length to that before, elbows and knees bent by 90 degrees
    double overstretched = 0; ///< share of the edges that are stretched more than 3 times
    /// Largest relative change then of the volume of a forearm or a calf: of the piece of surface around its bone.
    double volume = 0;
    /// Largest growth of the gap between vertices of pieces that touch, of the height: not of two limbs, as feet that
    /// stand side by side part rightly.
    double gap = 0;
};

/// Bends as viewers of glTF do: linearly. Edges and gaps shorter than a thousandth of the height count as that long.
[[nodiscard]] Quality measure(const applications::Rig<double>& rig);

} // namespace skelgen::rigs
