#pragma once

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/stage_timings.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::fitting {

/// A template fitted to a body, in the input's coordinates and indices.
template <typename Scalar = double>
struct Fit {
    KinematicSkeleton<Scalar> skeleton;
    CurveSkeleton<Scalar> curve;  ///< that the skeleton was fitted to: the given one, or one that serves better; a
                                  ///< draft made whole; empty unless `ExtractOptions::with_curve`
    Scalar geodesic_diameter = 0; ///< largest geodesic distance on the body, estimated, in the input's unit
    StageTimings timings;         ///< of `curve`: what it took to look for curves that serve better
};

/// What the applications stand on: a skeleton, and the surface in which it was found.
template <typename Scalar = double>
struct FittedBody {
    Fit<Scalar> extraction; ///< in the input's coordinates
    Body<Scalar> body;      ///< one closed surface, not cut where it touches itself
};

} // namespace skelgen::fitting
