#pragma once

#include <skelgen/surface/prepare.hpp>

#include <cmath>
#include <utility>

#include <skelgen/core/error.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/surface/canonical_form.hpp>
#include <skelgen/surface/manifold_parts.hpp>

namespace skelgen::surface {
template <typename Scalar>
void require_surface(const TriangleMesh<Scalar>& mesh) {
    if (mesh.vertices.rows() < 4 || mesh.faces.rows() < 4)
        throw Error(ErrorCode::bad_input,
                    "the mesh has fewer than four vertices or faces; a body needs a closed surface");
    for (Eigen::Index i = 0; i < mesh.vertices.size(); ++i)
        if (!std::isfinite(mesh.vertices.data()[i]))
            throw Error(ErrorCode::bad_input, "the mesh has a coordinate that is not a finite number; repair it");
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i)
        if (const int v = mesh.faces.data()[i]; v < 0 || v >= mesh.vertices.rows())
            throw Error(ErrorCode::bad_input, "a face refers to a vertex that does not exist; repair the mesh");
}

SKELGEN_INLINE void validate(const PrepareOptions& options) { validate(options.denoise); }

template <typename Scalar>
Body<Scalar> prepare(const TriangleMesh<Scalar>& mesh, const PrepareOptions& options) {
    require_surface(mesh);
    const DenoisedMesh<Scalar> clean = remove_noise(mesh, options.denoise);
    const CanonicalMesh<Scalar> canonical = canonical_form(clean.mesh);
    ManifoldParts<Scalar> part = largest_manifold_part(canonical.mesh);
    return make_body(std::move(part.mesh), canonical.similarity, composed(part.source, canonical.input_vertex),
                     part.dropped_pieces);
}

} // namespace skelgen::surface
