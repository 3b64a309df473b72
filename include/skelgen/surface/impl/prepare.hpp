#pragma once

#include <skelgen/surface/prepare.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nanoflann.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/surface/canonical_form.hpp>
#include <skelgen/surface/clean.hpp>
#include <skelgen/surface/denoise.hpp>
#include <skelgen/surface/impl/bridges.hpp>
#include <skelgen/surface/impl/fill_holes.hpp>
#include <skelgen/surface/manifold_parts.hpp>
#include <skelgen/surface/pieces.hpp>
#include <skelgen/surface/rounded.hpp>
#include <skelgen/surface/unpaired_pieces.hpp>
#include <skelgen/surface/vertex_clusters.hpp>
#include <skelgen/surface/weld.hpp>

namespace skelgen::surface {
namespace detail {

/// \throws Error bad_input where the volume of a mesh of this size, or of a thousandth of it, is no number.
template <typename Scalar>
void require_usable_size(Scalar size) {
    const Scalar part = Scalar(1e-3) * size;
    if (!std::isnormal(part * part * part) || !std::isnormal(size * size * size))
        throw Error(ErrorCode::bad_input, "the mesh is too " + std::string(size < 1 ? "small" : "large") +
                                              " to compute with; scale it to metres");
}

/// The squares over the longest edges of the faces that lie within reach of a mesh's robust box, beside that over the
/// box's diagonal: about as many faces does a line through the box pass.
template <typename Scalar>
core::Accumulator faces_along_a_line(const TriangleMesh<Scalar>& mesh, const Eigen::AlignedBox<Scalar, 3>& box) {
    const Scalar size = box.diagonal().norm();
    core::Accumulator sum = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        Scalar longest = 0;
        bool is_near = true;
        for (int k = 0; k < 3; ++k) {
            const Vector3<Scalar> corner = core::point(mesh.vertices, mesh.faces(f, k));
            is_near = is_near && box.exteriorDistance(corner) <= size;
            longest =
                std::max(longest, (core::point(mesh.vertices, mesh.faces(f, (k + 1) % 3)) - corner).norm() / size);
        }
        if (is_near) sum += static_cast<core::Accumulator>(longest) * static_cast<core::Accumulator>(longest);
    }
    return sum;
}

/// \throws Error bad_input where a line passes very many faces: they join vertices far apart. No tree parts such ones,
/// so that all that looks along rays, or for what is near, would look at most of them each time.
template <typename Scalar>
void require_short_faces(const TriangleMesh<Scalar>& mesh) {
    constexpr core::Accumulator most = 150; // a person has 2, of 240 characters and things none more than 65; with one
                                            // face in ten between random vertices a person has 400
    const Eigen::AlignedBox<Scalar, 3> box = robust_box(mesh);
    const Scalar side = box.isEmpty() ? Scalar(0) : box.sizes().maxCoeff();
    if (!(side > 0)) return; // that there is no area is for others to say
    require_usable_size(side);
    if (faces_along_a_line(mesh, box) > most)
        throw Error(ErrorCode::bad_input, "most faces join vertices that are far apart, so that they are no surface; "
                                          "export the mesh again");
}

} // namespace detail

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
    detail::require_short_faces(mesh);
}

SKELGEN_INLINE void validate(const PrepareOptions& options) {
    validate(options.denoise);
    validate(options.envelope);
    core::require_in_range("prepare.most_faces", options.most_faces, 0, std::numeric_limits<int>::max());
    core::require_in_range("prepare.component", options.component, 0, 1000);
}

namespace detail {

/// What of a clean mesh becomes the body, before it is brought into canonical form.
template <typename Scalar>
struct ChosenPiece {
    TriangleMesh<Scalar> mesh;
    std::vector<int> source; ///< per vertex that of the clean mesh, -1 for those added; empty where all stayed
    int dropped_pieces = 0;
    std::vector<std::string> notes;
    std::vector<std::vector<int>> rims = {}; ///< as in Body, of this mesh
    bool is_sound = false;                   ///< as is_sound(mesh) has it
    std::vector<int> standing = {}; ///< per vertex of the clean mesh that which stands for it, -1 where it was left
                                    ///< out; empty where `source` says it all
};

inline std::vector<int> identity(Eigen::Index count) {
    std::vector<int> out(static_cast<std::size_t>(count));
    std::iota(out.begin(), out.end(), 0);
    return out;
}

/// A rim on the vertices that stand for its own, -1 for none; empty where that is no ring.
inline std::vector<int> coarser_rim(const std::vector<int>& rim, const std::vector<int>& cluster) {
    std::vector<int> out;
    for (const int v : rim)
        if (const int c = cluster[static_cast<std::size_t>(v)]; c >= 0 && (out.empty() || out.back() != c))
            out.push_back(c);
    while (out.size() > 1 && out.front() == out.back()) out.pop_back();
    std::vector<int> sorted = out;
    std::sort(sorted.begin(), sorted.end());
    const bool is_ring = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
    return is_ring ? out : std::vector<int>();
}

/// A sound piece that is all of the clean mesh, coarser.
template <typename Scalar>
ChosenPiece<Scalar> coarser(const ChosenPiece<Scalar>& piece, ClusteredMesh<Scalar> coarse) {
    ChosenPiece<Scalar> out{std::move(coarse.mesh), std::move(coarse.source), piece.dropped_pieces, piece.notes};
    out.is_sound = true; // clusters of a closed surface that are discs make one
    out.standing = std::move(coarse.cluster);
    return out;
}

/// The piece in about so many faces, all of its vertices stood for.
template <typename Scalar>
ChosenPiece<Scalar> clustered(const ChosenPiece<Scalar>& piece, int faces) {
    if (piece.is_sound) return coarser(piece, cluster_vertices(piece.mesh, faces));
    const ManifoldParts<Scalar> part = largest_manifold_part(piece.mesh); // where the piece may be none
    ClusteredMesh<Scalar> coarse = cluster_vertices(part.mesh, faces);
    const std::vector<int> cluster =
        composed(carried_over(identity(piece.mesh.vertices.rows()), part.source), coarse.cluster);
    std::vector<int> source = composed(std::move(coarse.source), part.source);
    ChosenPiece<Scalar> out{std::move(coarse.mesh), {}, piece.dropped_pieces + part.dropped_pieces, piece.notes};
    for (const std::vector<int>& rim : piece.rims)
        if (std::vector<int> coarser = coarser_rim(rim, cluster); coarser.size() > 2)
            out.rims.push_back(std::move(coarser));
    if (piece.source.empty()) {
        out.source = std::move(source);
        out.standing = cluster;
    } else {
        out.standing = composed(
            carried_over(identity(1 + *std::max_element(piece.source.begin(), piece.source.end())), piece.source),
            cluster);
        out.source = composed(std::move(source), piece.source);
    }
    return out;
}

inline constexpr double small_hole = 0.04; // of the surface: the skin of an upper arm (LB44)

/// The largest piece, its small holes closed. A mesh of one closed piece is taken as it is.
template <typename Scalar>
ChosenPiece<Scalar> choose_piece(const CleanMesh<Scalar>& clean) {
    const TriangleMesh<Scalar>& mesh = clean.mesh;
    if (clean.is_sound) return {mesh, {}, 0, {}, {}, true};
    ManifoldParts<Scalar> part = largest_manifold_part(mesh);
    FilledSurface<Scalar> filled = fill_holes(part.mesh, small_hole);
    if (part.dropped_pieces == 0 && filled.filled == 0) return {mesh, {}, 0, {}};
    ChosenPiece<Scalar> out{std::move(filled.mesh), std::move(part.source), part.dropped_pieces, {}};
    out.source.resize(static_cast<std::size_t>(out.mesh.vertices.rows()), -1);
    out.rims = std::move(filled.rims);
    if (filled.filled > 0) out.notes.push_back("holes closed: " + std::to_string(filled.filled));
    return out;
}

/// The surfaces that an envelope consists of.
template <typename Scalar>
std::vector<TriangleMesh<Scalar>> closed_parts(const TriangleMesh<Scalar>& envelope) {
    std::vector<TriangleMesh<Scalar>> out;
    for (ManifoldParts<Scalar>& part : manifold_parts(envelope)) out.push_back(std::move(part.mesh));
    return out;
}

/// The surface that encloses most of those, none where none does, and how many others
/// enclose half of that or more.
template <typename Scalar>
struct LargestEnvelope {
    TriangleMesh<Scalar> mesh;
    int as_large = 0;
};

template <typename Scalar>
LargestEnvelope<Scalar> largest_of(std::vector<TriangleMesh<Scalar>> parts) {
    LargestEnvelope<Scalar> out;
    std::vector<Scalar> volumes;
    for (TriangleMesh<Scalar>& part : parts) {
        volumes.push_back(core::enclosed_volume(part));
        if (volumes.back() > 0 && volumes.back() >= *std::max_element(volumes.begin(), volumes.end()))
            out.mesh = std::move(part);
    }
    if (volumes.empty()) return out;
    const Scalar half = *std::max_element(volumes.begin(), volumes.end()) / 2;
    if (half > 0)
        out.as_large =
            static_cast<int>(std::count_if(volumes.begin(), volumes.end(), [&](Scalar v) { return v >= half; })) - 1;
    return out;
}

/// For each vertex of `mesh` that a face uses the nearest of the body's vertices where the surface looks to the same
/// side, if one is near, else the nearest; -1 for the others.
template <typename Scalar>
std::vector<int> nearest_on(const Body<Scalar>& body, const TriangleMesh<Scalar>& mesh) {
    constexpr std::size_t candidates = 8;
    const nanoflann::KDTreeEigenMatrixAdaptor<Points<Scalar>, 3, nanoflann::metric_L2_Simple> tree(3,
                                                                                                   body.mesh.vertices);
    const Points<Scalar> body_normals = core::vertex_normals(body.mesh), normals = core::vertex_normals(mesh);
    std::vector<bool> is_used(static_cast<std::size_t>(mesh.vertices.rows()), false);
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) is_used[static_cast<std::size_t>(mesh.faces.data()[i])] = true;
    std::vector<int> out(is_used.size(), -1);
    for (std::size_t v = 0; v < out.size(); ++v) {
        if (!is_used[v]) continue;
        const auto row = static_cast<Eigen::Index>(v);
        const Vector3<Scalar> place = body.similarity.to_canonical(core::point(mesh.vertices, row));
        const Vector3<Scalar> normal = body.similarity.rotation * core::point(normals, row);
        std::array<Eigen::Index, candidates> found{};
        std::array<Scalar, candidates> squared{};
        nanoflann::KNNResultSet<Scalar, Eigen::Index> results(candidates);
        results.init(found.data(), squared.data());
        tree.index->findNeighbors(results, place.data(), nanoflann::SearchParams());
        const auto same_side =
            std::find_if(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(results.size()),
                         [&](Eigen::Index i) { return core::point(body_normals, i).dot(normal) > 0; });
        out[v] = static_cast<int>(
            same_side == found.begin() + static_cast<std::ptrdiff_t>(results.size()) ? found[0] : *same_side);
    }
    return out;
}

template <typename Scalar>
bool is_too_fine(const TriangleMesh<Scalar>& mesh, const PrepareOptions& options) {
    return options.most_faces > 0 && mesh.faces.rows() > options.most_faces;
}

/// The body of a chosen piece as it is; `placed` as in CleanMesh.
template <typename Scalar>
Body<Scalar> body_as_is(ChosenPiece<Scalar> piece, const std::vector<int>& placed) {
    const CanonicalMesh<Scalar> canonical = canonical_form(piece.mesh);
    ManifoldParts<Scalar> part =
        piece.is_sound ? manifold_part_of_sound(canonical.mesh) : largest_manifold_part(canonical.mesh);
    std::vector<int> source = composed(std::move(part.source), canonical.input_vertex); // of the piece
    std::vector<std::vector<int>> rims = carried_rims(piece.rims, source);
    std::vector<int> standing = carried_over(std::move(piece.standing), source);
    if (!piece.source.empty()) source = composed(std::move(source), piece.source);
    Body<Scalar> body =
        make_body(std::move(part.mesh), canonical.similarity, source, piece.dropped_pieces + part.dropped_pieces);
    if (placed.empty())
        body.nearest = std::move(standing);
    else {
        if (standing.empty()) {
            body.nearest = carried_over(placed, source);
        } else {
            standing.resize(1 + static_cast<std::size_t>(*std::max_element(placed.begin(), placed.end())), -1);
            body.nearest = composed(placed, standing);
        }
        std::vector<int> first(placed.size(), -1); // of the input's vertices at each of the clean mesh's
        for (std::size_t v = placed.size(); v-- > 0;)
            if (placed[v] >= 0) first[static_cast<std::size_t>(placed[v])] = static_cast<int>(v);
        body.source = composed(std::move(source), first);
    }
    body.repairs = std::move(piece.notes);
    body.rims = std::move(rims);
    return body;
}

/// The same without noise, and no finer than a body is to be.
template <typename Scalar>
Body<Scalar> body_of(ChosenPiece<Scalar> piece, const std::vector<int>& placed, const PrepareOptions& options) {
    piece.mesh = remove_noise(std::move(piece.mesh), options.denoise).mesh;
    if (is_too_fine(piece.mesh, options)) piece = clustered(piece, options.most_faces / 2);
    return body_as_is(std::move(piece), placed);
}

/// Of the box around a mesh's faces.
template <typename Scalar>
Vector3<Scalar> extent_of(const TriangleMesh<Scalar>& mesh) {
    const TriangleMesh<Scalar> used = used_part(mesh).mesh;
    return (used.vertices.colwise().maxCoeff() - used.vertices.colwise().minCoeff()).transpose();
}

/// How many pieces a mesh has.
template <typename Scalar>
std::string overlapping_pieces(const TriangleMesh<Scalar>& mesh) {
    return std::to_string(manifold_parts(mesh).size());
}

/// The largest piece of the material.
template <typename Scalar>
ChosenPiece<Scalar> chosen_of(const BodyMaterial<Scalar>& material) {
    ChosenPiece<Scalar> piece = choose_piece(material.clean);
    piece.notes.insert(piece.notes.begin(), material.clean.notes.begin(), material.clean.notes.end());
    piece.dropped_pieces += material.dropped_pieces;
    return piece;
}

/// That piece as a body.
template <typename Scalar>
Body<Scalar> body_of_largest_piece(BodyMaterial<Scalar> material, const PrepareOptions& options) {
    if (!material.coarse) return body_of(chosen_of(material), material.clean.placed, options);
    Body<Scalar> body = *std::move(material.coarse);
    body.dropped_pieces += material.dropped_pieces;
    body.repairs = std::move(material.clean.notes);
    return body;
}

/// The same, rounder.
template <typename Scalar>
Body<Scalar> body_of_rounded_piece(const BodyMaterial<Scalar>& material, const PrepareOptions& options) {
    ChosenPiece<Scalar> piece = chosen_of(material);
    if (piece.source.empty()) {
        piece.source = identity(piece.mesh.vertices.rows());
    }
    const Eigen::Index faces = piece.mesh.faces.rows();
    piece.mesh = rounded(piece.mesh);
    piece.is_sound = false;
    piece.source.resize(static_cast<std::size_t>(piece.mesh.vertices.rows()), -1);
    piece.notes.push_back("coarse surface made rounder: " + std::to_string(piece.mesh.faces.rows()) + " faces of " +
                          std::to_string(faces));
    return body_of(std::move(piece), material.clean.placed, options);
}

/// An envelope of more faces is clustered to half as many, about what a body of FAUST has: the time of what follows
/// grows with them, and how many characters are right differs by chance alone between 10 and 60 thousand.
inline constexpr int most_envelope_faces = 24'000;

/// An envelope of the material as a body; `has_gaps`: a failure where none can be bridged.
template <typename Scalar>
Outcome<Body<Scalar>> body_of_envelope(const BodyMaterial<Scalar>& material, const PrepareOptions& options,
                                       bool has_gaps) {
    // In canonical form first: the lattice then lies along the body's axes, however the input was turned.
    const CanonicalMesh<Scalar> whole = canonical_form(used_part(material.clean.mesh).mesh);
    std::vector<TriangleMesh<Scalar>> parts = closed_parts(winding_envelope(whole.mesh, options.envelope));
    const std::vector<TriangleMesh<Scalar>> bridges = bridges_between(parts);
    if (has_gaps && bridges.empty())
        return Failure{Refusal::several_bodies, "what stands apart is too far away to belong together"};
    if (!bridges.empty()) {
        TriangleMesh<Scalar> joined = whole.mesh;
        for (const TriangleMesh<Scalar>& bridge : bridges) joined = side_by_side(joined, bridge);
        parts = closed_parts(winding_envelope(joined, options.envelope));
    }
    LargestEnvelope<Scalar> largest = largest_of(std::move(parts));
    TriangleMesh<Scalar>& envelope = largest.mesh;
    if (largest.as_large > 0)
        return Failure{Refusal::several_bodies,
                       std::to_string(largest.as_large + 1) +
                           " bodies apart, or parts of one; leave all but one away, or join the parts"};
    if (envelope.faces.rows() == 0)
        return Failure{Refusal::nothing_enclosed, "no body: its " + overlapping_pieces(material.clean.mesh) +
                                                      " pieces enclose nothing; close its surface"};
    for (Eigen::Index v = 0; v < envelope.vertices.rows(); ++v)
        core::set_point<Scalar>(envelope.vertices, v, whole.similarity.to_input(core::point(envelope.vertices, v)));
    ChosenPiece<Scalar> piece{std::move(envelope), {}, material.dropped_pieces, material.clean.notes};
    piece.source.assign(static_cast<std::size_t>(piece.mesh.vertices.rows()), -1);
    piece.notes.push_back(overlapping_pieces(material.clean.mesh) + " pieces joined into one surface");
    if (!bridges.empty()) piece.notes.push_back("gaps bridged between its parts: " + std::to_string(bridges.size()));
    PrepareOptions coarser = options;
    if (options.most_faces > 0) coarser.most_faces = std::min(options.most_faces, most_envelope_faces);
    Body<Scalar> body = body_of(std::move(piece), {}, coarser);
    const std::vector<int> nearest = nearest_on(body, material.clean.mesh);
    body.nearest = material.clean.placed.empty() ? nearest : composed(material.clean.placed, nearest);
    return body;
}

/// The material in some of its faces alone.
template <typename Scalar>
void keep_faces(CleanMesh<Scalar>& clean, Triangles faces) {
    UsedPart<Scalar> used = used_part(TriangleMesh<Scalar>{clean.mesh.vertices, std::move(faces)});
    std::vector<int> now(static_cast<std::size_t>(clean.mesh.vertices.rows()), -1);
    for (std::size_t v = 0; v < used.source.size(); ++v)
        now[static_cast<std::size_t>(used.source[v])] = static_cast<int>(v);
    clean.placed = clean.placed.empty() ? std::move(now) : composed(std::move(clean.placed), now);
    clean.mesh = std::move(used.mesh);
    clean.is_sound = false;
}

/// The remedy that leaves out what a body holds or wears on one side, where that is pieces of their own.
template <typename Scalar>
void add_paired_pieces(BodyMaterial<Scalar>& material) {
    material.paired = without_lone_pieces(material.clean.mesh);
    if (material.paired) material.remedies.insert(material.remedies.begin() + 1, Remedy::alike_pieces);
}

/// The body of a mesh that is too fine in fewer faces, if `is_sound` then says that it is sound and it has no noise.
/// Another thread makes it while this one finds that out, which takes as long: most meshes of that size are.
template <typename Scalar, typename IsSound>
std::optional<Body<Scalar>> coarse_if_sound(const TriangleMesh<Scalar>& mesh, const PrepareOptions& options,
                                            const IsSound& is_sound) {
    std::optional<Body<Scalar>> coarse;
    std::atomic<bool> is_wanted = is_too_fine(mesh, options);
    if (!is_wanted) {
        is_sound();
        return coarse;
    }
    core::in_parallel([&] { is_wanted = is_sound() && is_without_noise(mesh, options.denoise); },
                      [&] {
                          if (!is_wanted) return;
                          try {
                              coarse = body_as_is(
                                  coarser(ChosenPiece<Scalar>{}, cluster_vertices(mesh, options.most_faces / 2)), {});
                          } catch (const Error&) { // it has no area, and will not be found to be sound
                          }
                      });
    if (!is_wanted) coarse.reset();
    return coarse;
}

} // namespace detail

template <typename Scalar>
BodyMaterial<Scalar> gather(const TriangleMesh<Scalar>& mesh, const PrepareOptions& options) {
    constexpr Scalar nearly_all = Scalar(0.98), nearly_as_far = Scalar(0.85), much = Scalar(0.4);
    constexpr double wide_open = 0.1;
    constexpr Eigen::Index few_vertices = 3000; // as many as the curve's proxy has
    require_surface(mesh);
    validate(options);
    BodyMaterial<Scalar> out;
    BodyFaces chosen;
    std::optional<Body<Scalar>> coarse = detail::coarse_if_sound(mesh, options, [&] {
        out.clean = clean_in_own_axes(mesh);
        chosen = faces_of_body(out.clean.mesh, options.component, out.clean.is_sound);
        return out.clean.is_sound && chosen.faces.rows() == mesh.faces.rows();
    });
    if (options.component > chosen.bodies)
        throw Error(ErrorCode::usage, "there is no body number " + std::to_string(options.component) + ", only " +
                                          std::to_string(chosen.bodies));
    out.bodies = chosen.bodies;
    out.dropped_pieces = chosen.dropped_pieces;
    out.stood_on_plate = chosen.stood_on_plate;
    out.clean.notes.insert(out.clean.notes.end(), chosen.notes.begin(), chosen.notes.end());
    if (chosen.all_things.rows() > 0 && options.component == 0) {
        out.apart = out.clean;
        detail::keep_faces(*out.apart, std::move(chosen.all_things));
    }
    if (chosen.faces.rows() < out.clean.mesh.faces.rows()) detail::keep_faces(out.clean, std::move(chosen.faces));

    const std::vector<Remedy> for_one_piece = out.clean.mesh.vertices.rows() < few_vertices
                                                  ? std::vector<Remedy>{Remedy::largest_piece, Remedy::rounded}
                                                  : std::vector<Remedy>{Remedy::largest_piece};
    if (out.clean.is_sound) {
        out.coarse = std::move(coarse);
        out.remedies = for_one_piece;
        return out;
    }
    const TriangleMesh<Scalar> part = largest_manifold_part(out.clean.mesh).mesh;
    const FilledSurface<Scalar> filled = fill_holes(part, detail::small_hole);
    const Scalar share = core::surface_area(part) / core::surface_area(out.clean.mesh);
    const Vector3<Scalar> extent = detail::extent_of(part), whole_extent = detail::extent_of(out.clean.mesh);
    const bool reaches_as_far = extent.maxCoeff() >= nearly_as_far * whole_extent.maxCoeff();
    if (filled.open == 0 && share >= nearly_all)
        out.remedies = for_one_piece;
    else if (filled.open_area <= wide_open && reaches_as_far && share >= much)
        out.remedies = {Remedy::largest_piece, Remedy::envelope};
    else
        out.remedies = {Remedy::envelope, Remedy::largest_piece};
    detail::add_paired_pieces(out);
    if (out.apart) out.remedies.push_back(Remedy::bridged);
    return out;
}

template <typename Scalar>
Points<Scalar> input_vertices(const BodyMaterial<Scalar>& material) {
    const TriangleMesh<Scalar>& mesh = material.clean.mesh;
    std::vector<bool> is_used(static_cast<std::size_t>(mesh.vertices.rows()), false);
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) is_used[static_cast<std::size_t>(mesh.faces(f, k))] = true;
    Points<Scalar> out(std::count(is_used.begin(), is_used.end(), true), 3);
    Eigen::Index row = 0;
    for (std::size_t v = 0; v < is_used.size(); ++v)
        if (is_used[v])
            out.row(row++) =
                material.clean.similarity.to_input(core::point(mesh.vertices, static_cast<Eigen::Index>(v)));
    return out;
}

template <typename Scalar>
Outcome<Body<Scalar>> make_body_by(Remedy remedy, BodyMaterial<Scalar> material, const PrepareOptions& options) {
    if (remedy == Remedy::bridged && material.apart) {
        material.clean = *std::move(material.apart);
        material.dropped_pieces = 0;
    }
    const Similarity<Scalar> cleaned = material.clean.similarity;
    if (remedy == Remedy::alike_pieces && material.paired) {
        detail::keep_faces(material.clean, std::move(material.paired->faces));
        material.dropped_pieces += material.paired->dropped;
    }
    Outcome<Body<Scalar>> body =
        remedy == Remedy::largest_piece ? detail::body_of_largest_piece(std::move(material), options)
        : remedy == Remedy::rounded     ? detail::body_of_rounded_piece(material, options)
                                        : detail::body_of_envelope(material, options, remedy == Remedy::bridged);
    if (body) body->similarity = cleaned.then(body->similarity);
    return body;
}

template <typename Scalar>
Body<Scalar> prepare(const TriangleMesh<Scalar>& mesh, const PrepareOptions& options) {
    require_surface(mesh);
    BodyMaterial<Scalar> material;
    material.coarse = detail::coarse_if_sound(mesh, options, [&] {
        material.clean = clean(mesh);
        return material.clean.is_sound;
    });
    return detail::body_of_largest_piece(std::move(material), options);
}

} // namespace skelgen::surface
