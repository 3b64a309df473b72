#pragma once

#include <skelgen/surface/prepare.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/surface/canonical_form.hpp>
#include <skelgen/surface/clean.hpp>
#include <skelgen/surface/fill_holes.hpp>
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

namespace detail {

/// What of a clean mesh becomes the body, before it is brought into canonical form.
template <typename Scalar>
struct ChosenPiece {
    TriangleMesh<Scalar> mesh;
    std::vector<int> source; ///< per vertex that of the clean mesh, -1 for those added; empty where all stayed
    int dropped_pieces = 0;
    std::vector<std::string> notes;
};

/// The largest piece, its small holes closed. A mesh of one closed piece is taken as it is.
template <typename Scalar>
ChosenPiece<Scalar> choose_piece(const TriangleMesh<Scalar>& mesh) {
    constexpr double small = 0.02; // of the surface: a hand, or the soles of both feet (LB44)
    ManifoldParts<Scalar> part = largest_manifold_part(mesh);
    FilledSurface<Scalar> filled = fill_holes(part.mesh, small);
    if (part.dropped_pieces == 0 && filled.filled == 0) return {mesh, {}, 0, {}};
    ChosenPiece<Scalar> out{std::move(filled.mesh), std::move(part.source), part.dropped_pieces, {}};
    out.source.resize(static_cast<std::size_t>(out.mesh.vertices.rows()), -1);
    if (filled.filled > 0) out.notes.push_back("holes closed: " + std::to_string(filled.filled));
    return out;
}

/// The body of a chosen piece; `placed` as in CleanMesh.
template <typename Scalar>
Body<Scalar> body_of(ChosenPiece<Scalar> piece, const std::vector<int>& placed, const PrepareOptions& options) {
    const DenoisedMesh<Scalar> smooth = remove_noise(std::move(piece.mesh), options.denoise);
    const CanonicalMesh<Scalar> canonical = canonical_form(smooth.mesh);
    ManifoldParts<Scalar> part = largest_manifold_part(canonical.mesh);
    std::vector<int> source = composed(std::move(part.source), canonical.input_vertex);
    if (!piece.source.empty()) source = composed(std::move(source), piece.source);
    Body<Scalar> body =
        make_body(std::move(part.mesh), canonical.similarity, source, piece.dropped_pieces + part.dropped_pieces);
    if (!placed.empty()) {
        body.nearest = carried_over(placed, source);
        std::vector<int> first(placed.size(), -1); // of the input's vertices at each of the clean mesh's
        for (std::size_t v = placed.size(); v-- > 0;)
            if (placed[v] >= 0) first[static_cast<std::size_t>(placed[v])] = static_cast<int>(v);
        body.source = composed(std::move(source), first);
    }
    body.repairs = std::move(piece.notes);
    return body;
}

} // namespace detail

template <typename Scalar>
Body<Scalar> prepare(const TriangleMesh<Scalar>& mesh, const PrepareOptions& options) {
    require_surface(mesh);
    const CleanMesh<Scalar> whole = clean(mesh);
    detail::ChosenPiece<Scalar> piece = detail::choose_piece(whole.mesh);
    piece.notes.insert(piece.notes.begin(), whole.notes.begin(), whole.notes.end());
    return detail::body_of(std::move(piece), whole.placed, options);
}

} // namespace skelgen::surface
