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

inline StageTimings operator+(const StageTimings& a, const StageTimings& b) {
    return {a.surface + b.surface, a.curve + b.curve, a.embed + b.embed,
            a.refine + b.refine,   a.sides + b.sides, a.total + b.total};
}

} // namespace skelgen
