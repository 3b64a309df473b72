#pragma once

#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// Constants of remove_noise().
struct DenoiseOptions {
    double least_coherence =
        0.2; ///< bodies without noise have 0.26 (facetted) to 0.8; calibrated on three sets of them
    double enough_coherence = 0.6; ///< to stop at
    int most_passes = 20;
    double shrinking = 0.5;  ///< of a Taubin pass, part of the way to the mean of the neighbours
    double growing = -0.526; ///< back again; pass band 0.1 (Taubin 1995)
};

/// How alike neighbouring vertices bulge: correlation, over the edges, of the vertices' distances in front of the mean
/// of their neighbours. Near 1 on a smooth surface, whatever its triangles; about 0 and below where every vertex goes
/// its own way. 1 for a flat one. O(n log n).
[[nodiscard]] double bulge_coherence(const TriangleMesh<double>& mesh);

/// Smooths a mesh whose vertices are displaced by noise until they bulge coherently (Taubin, A signal processing
/// approach to fair surface design, SIGGRAPH 1995), which keeps limbs as thick as they are. A mesh without noise is
/// left untouched. Any unit; any mesh whose faces refer to its vertices. \returns the number of passes. O(passes n + n
/// log n).
int remove_noise(TriangleMesh<double>& mesh, const DenoiseOptions& options = {});

} // namespace skelgen
