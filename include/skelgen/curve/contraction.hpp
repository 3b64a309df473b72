#pragma once

#include <skelgen/core/mesh.hpp>
#include <skelgen/curve/medial_balls.hpp>

namespace skelgen::curve {

/// Constants of the contraction. Au08 section 3 solves the least-squares system [w_L L; W_H] V' = [0; W_H V], whose
/// normal matrix holds L twice: a bi-Laplacian, without a maximum principle, that throws vertices out of the body on
/// real meshes. We minimise the energy w_L V'^T(-L)V' + |W_H(V' - V)|^2 + w_M |W_H(V' - P)|^2 instead: one Laplacian,
/// positive weights, every new vertex a weighted mean of old ones and of centres P of inscribed balls (TAOZ12 section
/// 3). Au08's start, w_L = 1e-3 sqrt(mean face area), spends a dozen doublings moving nothing; ours starts where motion
/// starts. What has no source here is calibrated on bodies of people.
struct ContractionOptions {
    double laplacian_weight = 0.4;       ///< w_L of the first iteration
    double laplacian_growth = 1.5;       ///< s_L: factor on w_L after each iteration (Au08: 2)
    double attraction_weight = 1.0;      ///< W_H^2 of the first iteration; grows with sqrt(A_0 / A_t) of the one-ring
    double medial_weight = 2.0;          ///< w_M, relative to W_H^2
    double largest_medial_radius = 0.25; ///< bound on the inscribed balls, relative to the square root of the area
    double volume_ratio = 1e-6;          ///< stop when the enclosed volume is below this part of the start's (Au08)
    double least_progress = 0.02;        ///< stop when an iteration takes off less than this part of the volume
    int iterations = 9;                  ///< stop after so many at the latest: what comes to its end takes eight
};

/// \throws Error usage when an option is out of its range.
void validate(const ContractionOptions& options);

/// A mesh contracted to a thin, curve-like one, and how far it got.
template <typename Scalar = double>
struct Contraction {
    Points<Scalar> vertices; ///< n x 3, one per vertex of the input mesh
    int iterations = 0;
    Scalar volume_ratio = 1; ///< enclosed volume reached, relative to the start's
    bool converged = false;  ///< the volume fell below the bound, or stopped falling; false too where there was none
};

/// The balls inside a surface that its contraction is drawn to. As medial_balls.
template <typename Scalar>
[[nodiscard]] MedialBalls<Scalar> contraction_balls(const TriangleMesh<Scalar>& mesh,
                                                    const ContractionOptions& options = {});

/// Contracts a surface by implicit mean-curvature flow towards its medial axis. `mesh` must be manifold and well-shaped
/// (see build_proxy), faces outwards; any unit. `balls`: as contraction_balls. The system keeps its sparsity: analysed
/// once, factorised once per iteration. O(iterations n^1.5), a factorisation of a surface's graph each. \throws Error
/// internal when a system cannot be solved; usage when an option is out of its range.
template <typename Scalar>
[[nodiscard]] Contraction<Scalar> contract(const TriangleMesh<Scalar>& mesh, const MedialBalls<Scalar>& balls,
                                           const ContractionOptions& options = {});

/// The same with balls that are not needed any more.
template <typename Scalar>
[[nodiscard]] Contraction<Scalar> contract(const TriangleMesh<Scalar>& mesh, const ContractionOptions& options = {});

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/contraction.hpp>
#endif
