#pragma once

#include <cstddef>
#include <vector>

#include <skelgen/synth/tubes.hpp>

#include "primitives.hpp"

namespace skelgen::synth {

/// The tubes' surface as a field, negative inside, that is close to a distance near it.
class StrokeField {
public:
    explicit StrokeField(const std::vector<TubeStroke>& strokes);

    [[nodiscard]] double operator()(const Vec3& p) const;

    /// The radius of the tube nearest to a point.
    [[nodiscard]] double radius_at(const Vec3& p) const;

private:
    /// Neighbouring segments of one stroke and a ball around their tube.
    struct Chunk {
        std::size_t first = 0, last = 0; ///< segments, the last one excluded
        Ball bound;
    };
    struct Part {
        TubeStroke stroke;
        std::vector<Chunk> chunks;
        Ball bound;
    };
    struct Nearest {
        double value = 0;
        double radius = 0;
    };

    static Part to_part(const TubeStroke& stroke);
    static Nearest round_at(const Part& part, const Chunk& start, const Vec3& p);
    static Nearest elliptic_at(const Part& part, const Chunk& start, const Vec3& p);
    static Nearest at(const Part& part, const Vec3& p);

    std::vector<Part> parts_;
};

} // namespace skelgen::synth
