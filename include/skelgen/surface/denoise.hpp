#pragma once

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// Constants of remove_noise().
struct DenoiseOptions {
    double least_coherence =
        0.2; ///< bodies without noise have 0.26 (facetted) to 0.8; calibrated on three sets of them
    double enough_coherence = 0.6; ///< to stop at
    int most_passes = 20;
    double shrinking = 0.5;  ///< of a pass, part of the way to the mean of the neighbours (Tau95)
    double growing = -0.526; ///< back again; pass band 0.1 (Tau95)
};

/// \throws Error usage when an option is out of its range.
void validate(const DenoiseOptions& options);

/// How alike neighbouring vertices bulge: correlation, over the edges, of the vertices' distances in front of the mean
/// of their neighbours. Near 1 on a smooth surface, whatever its triangles; about 0 and below where every vertex goes
/// its own way. 1 for a flat one. O(n log n).
template <typename Scalar>
[[nodiscard]] Scalar bulge_coherence(const TriangleMesh<Scalar>& mesh);

/// Whether a closed surface bulges as coherently as one without noise, which remove_noise leaves untouched: each of its
/// edges must have two faces. O(n). \throws Error usage when an option is out of its range.
template <typename Scalar>
[[nodiscard]] bool is_without_noise(const TriangleMesh<Scalar>& closed, const DenoiseOptions& options = {});

/// A mesh after some passes of smoothing that keep its volume (Tau95). O(passes n + n log n).
template <typename Scalar>
[[nodiscard]] TriangleMesh<Scalar> smoothed(TriangleMesh<Scalar> mesh, int passes, const DenoiseOptions& options = {});

/// A mesh after denoising.
template <typename Scalar = double>
struct DenoisedMesh {
    TriangleMesh<Scalar> mesh;
    int passes = 0; ///< of smoothing; 0 when the mesh has no noise and is as it was
};

/// Smooths a mesh whose vertices are displaced by noise until they bulge coherently (Tau95), which keeps limbs as thick
/// as they are. A mesh without noise is left untouched. Any unit; any mesh whose faces refer to its vertices.
/// O(passes n + n log n). \throws Error usage when an option is out of its range.
template <typename Scalar>
[[nodiscard]] DenoisedMesh<Scalar> remove_noise(TriangleMesh<Scalar> mesh, const DenoiseOptions& options = {});

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/denoise.hpp>
#endif
