#pragma once

#include <optional>
#include <string>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/outcome.hpp>
#include <skelgen/surface/body.hpp>
#include <skelgen/surface/clean.hpp>
#include <skelgen/surface/denoise.hpp>
#include <skelgen/surface/envelope.hpp>
#include <skelgen/surface/unpaired_pieces.hpp>
#include <skelgen/surface/vertex_clusters.hpp>

namespace skelgen::surface {

/// Constants of every step from mesh to body.
struct PrepareOptions {
    DenoiseOptions denoise;
    EnvelopeOptions envelope;
    /// A body's surface of more faces, an envelope of more than 24 thousand, is clustered to about half as many
    /// (surface::cluster_vertices); 0: never. Joints of bodies with 150 to 500 thousand faces are no more wrong then.
    int most_faces = 150000;
    int component = 0; ///< which of several bodies that stand apart, from 1 for the largest; 0: there must be one alone
};

/// \throws Error usage when an option is out of its range.
void validate(const PrepareOptions& options);

/// \throws Error bad_input when a mesh has fewer than four vertices or faces, coordinates that are not finite or faces
/// that refer to no vertex; where it is so small or large that its volume is no number; or where very many faces are
/// as long as all of it, as those between random vertices: whatever is done with them would take too long. O(n).
template <typename Scalar>
void require_surface(const TriangleMesh<Scalar>& mesh);

/// A way to make one body of what a mesh consists of.
enum class Remedy {
    largest_piece, ///< the piece with the largest area, its small holes closed, its triangles untouched
    envelope,      ///< winding_envelope around all pieces
    alike_pieces,  ///< winding_envelope without lone pieces (unpaired_pieces.hpp): what a hand holds or one side wears
    bridged,       ///< winding_envelope around all that stands apart, too, where narrow gaps can be bridged
    rounded,       ///< the largest piece, rounder than its faces (surface::rounded): those of a coarse one bend bones
};

/// The faces of one body, put right, and what may make one surface of them.
template <typename Scalar = double>
struct BodyMaterial {
    CleanMesh<Scalar> clean; ///< in its own axes unless it is sound; only the vertices that its faces use count
    int bodies = 1;          ///< how many stand apart in the input
    int dropped_pieces = 0;
    bool stood_on_plate = false;                 ///< as BodyFaces has it
    std::vector<Remedy> remedies;                ///< that may do, the gentlest first; never empty
    std::optional<PairedPieces> paired = {};     ///< for the remedy that leaves pieces out
    std::optional<CleanMesh<Scalar>> apart = {}; ///< for the one that bridges gaps: with what stands apart
    std::optional<Body<Scalar>> coarse = {};     ///< that of a large clean mesh which is to be taken as it is
};

/// What a mesh of several bodies is refused for, of which none was chosen.
[[nodiscard]] inline Failure several_bodies(int bodies) {
    return {Refusal::several_bodies,
            std::to_string(bodies) +
                " bodies apart; give each a file of its own, or take one by its number (--component)"};
}

/// Cleans a mesh, in its own axes unless it is sound, and chooses what belongs to the body. One piece that is closed
/// but for small holes and has nearly all of the surface is the body, rounded where it is coarse and does not do as it
/// is; one that reaches as far as all together is tried first; otherwise an envelope comes first. O(n log n). \throws
/// Error as `prepare`; usage when `options.component` is larger than the number of bodies.
template <typename Scalar>
[[nodiscard]] BodyMaterial<Scalar> gather(const TriangleMesh<Scalar>& mesh, const PrepareOptions& options = {});

/// Where the vertices are that the faces of a material use, in the input's coordinates, each place once. O(n).
template <typename Scalar>
[[nodiscard]] Points<Scalar> input_vertices(const BodyMaterial<Scalar>& material);

/// The body that a remedy makes: noise smoothed away where there is any, in canonical form. \returns a failure where
/// nothing is enclosed. \throws Error bad_input when the surface has no area.
template <typename Scalar>
[[nodiscard]] Outcome<Body<Scalar>> make_body_by(Remedy remedy, BodyMaterial<Scalar> material,
                                                 const PrepareOptions& options = {});

/// A mesh made ready for the pipeline without moving more than noise: cleaned, brought into canonical form, and its
/// largest manifold piece kept, small holes of which are closed. O(n log n). \throws Error usage when an
/// option is out of its range; bad_input when the mesh is no usable surface: fewer than four vertices or faces,
/// coordinates that are not finite, faces that refer to no vertex, no area, or what else `require_surface` refuses.
template <typename Scalar>
[[nodiscard]] Body<Scalar> prepare(const TriangleMesh<Scalar>& mesh, const PrepareOptions& options = {});

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/prepare.hpp>
#endif
