#pragma once

namespace skelgen {

/// Wall-clock milliseconds of each stage of an extraction.
struct StageTimings {
    double curve = 0;  ///< the body's surface prepared, and the curve skeleton found
    double embed = 0;  ///< the template laid into it
    double refine = 0; ///< joints placed
    double sides = 0;  ///< sides told apart, and the skeleton completed
    double total = 0;
};

} // namespace skelgen
