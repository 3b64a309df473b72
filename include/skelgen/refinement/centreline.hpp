#pragma once

#include <Eigen/Core>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/refinement/cross_section.hpp>

namespace skelgen::refinement {

/// How centrelines are drawn; lengths relative to the square root of the surface's area (a person of 1.75 m: 1.4 m).
struct CentrelineOptions {
    double step = 0.0125;       ///< between sections
    int rounds = 2;             ///< of cutting and recentring
    double largest_shift = 1.0; ///< farthest a point moves in a round, in thicknesses of its section
};

/// \throws Error usage when an option is out of its range.
inline void validate(const CentrelineOptions& options) {
    core::require_in_range("refinement.centreline.step", options.step, 0.001, 0.2);
    core::require_in_range("refinement.centreline.rounds", options.rounds, 0, 20);
    core::require_in_range("refinement.centreline.largest_shift", options.largest_shift, 0.0, 100.0);
}

/// A polyline through the centres of the surface's cross-sections, and what the sections are like along it. Entries of
/// points without a usable section are interpolated positions with thickness and area 0.
template <typename Scalar = double>
struct Centreline {
    Points<Scalar> points;            ///< k x 3
    Eigen::VectorX<Scalar> arc;       ///< arc length from the first point
    Eigen::VectorX<Scalar> thickness; ///< mean distance from the section's centre to its contour
    Eigen::VectorX<Scalar> area;      ///< of the section
    Eigen::VectorX<Scalar> flatness;  ///< of the section's Gauss map, see gauss_map_flatness()
};

/// Recentres a polyline inside the surface by perpendicular sections (PCS10; LF20 section 3.2.1): each point goes to
/// the centre of the contour around it, ends stay. O(k (n + m)).
template <typename Scalar>
[[nodiscard]] Centreline<Scalar> draw_centreline(const Slicer<Scalar>& slicer, const Points<Scalar>& line,
                                                 const CentrelineOptions& options = {});

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/centreline.hpp>
#endif
