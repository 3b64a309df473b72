#pragma once

#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/body.hpp>
#include <skelgen/surface/denoise.hpp>

namespace skelgen::surface {

/// Constants of every step from mesh to body.
struct PrepareOptions {
    DenoiseOptions denoise;
};

/// \throws Error usage when an option is out of its range.
void validate(const PrepareOptions& options);

/// \throws Error bad_input when a mesh has fewer than four vertices or faces, coordinates that are not finite or faces
/// that refer to no vertex. O(n).
template <typename Scalar>
void require_surface(const TriangleMesh<Scalar>& mesh);

/// A mesh made ready for the pipeline: noise smoothed away where there is any, brought into canonical form, and its
/// largest manifold piece kept. Holes are survived, nothing else is repaired. O(n log n). \throws Error usage when an
/// option is out of its range; bad_input when the mesh is no usable surface: fewer than four vertices or faces,
/// coordinates that are not finite, faces that refer to no vertex, no area.
template <typename Scalar>
[[nodiscard]] Body<Scalar> prepare(const TriangleMesh<Scalar>& mesh, const PrepareOptions& options = {});

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/prepare.hpp>
#endif
