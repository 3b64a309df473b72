#pragma once

#include <Eigen/Core>

#include <skelgen/core/mesh.hpp>
#include <skelgen/refinement/cross_section.hpp>

namespace skelgen {

/// How centrelines are drawn; lengths relative to the square root of the surface's area (a person of 1.75 m: 1.4 m).
struct CentrelineOptions {
    double step = 0.0125;       ///< between sections
    int rounds = 2;             ///< of cutting and recentring
    double largest_shift = 1.0; ///< farthest a point moves in a round, in thicknesses of its section
};

/// A polyline through the centres of the surface's cross-sections, and what the sections are like along it. Entries of
/// points without a usable section are interpolated positions with thickness and area 0.
struct Centreline {
    Points<double> points;     ///< k x 3
    Eigen::VectorXd arc;       ///< arc length from the first point
    Eigen::VectorXd thickness; ///< mean distance from the section's centre to its contour
    Eigen::VectorXd area;      ///< of the section
    Eigen::VectorXd flatness;  ///< of the section's Gauss map
};

/// Recentres a polyline inside the surface by perpendicular sections (Sellamani et al. 2010 sections; LF20 3.2.1): each
/// point goes to the centre of the contour around it, ends stay. O(k (n + m)).
[[nodiscard]] Centreline draw_centreline(const Slicer& slicer, const Points<double>& line,
                                         const CentrelineOptions& options = {});

} // namespace skelgen
