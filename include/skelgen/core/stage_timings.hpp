#pragma once

namespace skelgen {

/// Wall-clock milliseconds of each stage of an extraction.
struct StageTimings {
    double surface = 0; ///< the body's surface made of the mesh, and opened where it has grown together
    double curve = 0;   ///< the curve skeleton found
    double embed = 0;   ///< the template laid into it
    double refine = 0;  ///< joints placed
    double sides = 0;   ///< sides told apart, and the skeleton completed
    double total = 0;
};

} // namespace skelgen
