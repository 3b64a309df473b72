#pragma once

#include <skelgen/surface/clean.hpp>

#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/surface/canonical_form.hpp>
#include <skelgen/surface/impl/orientation.hpp>
#include <skelgen/surface/impl/sound_faces.hpp>
#include <skelgen/surface/weld.hpp>

namespace skelgen::surface {
namespace detail {

/// "1 face", "2 faces".
SKELGEN_INLINE std::string counted(int count, std::string_view one, std::string_view several) {
    return std::to_string(count) + " " + std::string(count == 1 ? one : several);
}

/// The clean mesh of a welded one; `input_faces` were there at first.
template <typename Scalar>
CleanMesh<Scalar> clean_welded(WeldedMesh<Scalar> welded, Eigen::Index input_faces) {
    CleanMesh<Scalar> out;
    const auto note = [&](std::string_view what, int count, std::string_view one, std::string_view several) {
        if (count > 0) out.notes.push_back(std::string(what) + ": " + counted(count, one, several));
    };
    const auto far = static_cast<int>(input_faces - welded.mesh.faces.rows());
    if (welded.welded + welded.unused > 0) out.placed = std::move(welded.placed);
    const SoundFaces sound = sound_faces(welded.mesh);
    if (sound.faces.rows() < 4)
        throw Error(ErrorCode::bad_input,
                    "only " + std::to_string(sound.faces.rows()) + " of " + std::to_string(input_faces) +
                        " faces are neither degenerate nor doubled; a body needs a closed surface");
    OrientedMesh<Scalar> oriented = orient(TriangleMesh<Scalar>{std::move(welded.mesh.vertices), sound.faces});
    out.mesh = std::move(oriented.mesh);

    note("seams welded", welded.welded, "vertex", "vertices");
    note("faces that reach far away left out", far, "face", "faces");
    note("vertices without a face ignored", welded.unused, "vertex", "vertices");
    note("degenerate faces left out", sound.degenerate, "face", "faces");
    note("duplicate faces left out", sound.duplicate, "face", "faces");
    note("spikes left out", sound.spikes, "face", "faces");
    note("fins left out", sound.fins, "face", "faces");
    note("inner walls left out", sound.walls, "face", "faces");
    note("faces turned outwards", oriented.turned, "face", "faces");
    return out;
}

/// The places of a mesh where a similarity brings them, rounded: by more than turning it leaves of rounding.
template <typename Scalar>
TriangleMesh<Scalar> placed_by(const Similarity<Scalar>& similarity, TriangleMesh<Scalar> mesh) {
    constexpr auto steps = static_cast<Scalar>(1 << 24); // in the square root of the area
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        const Vector3<Scalar> place = similarity.to_canonical(core::point(mesh.vertices, v));
        for (int k = 0; k < 3; ++k) mesh.vertices(v, k) = std::round(place[k] * steps) / steps;
    }
    return mesh;
}

enum class Axes { given, own };

template <typename Scalar>
CleanMesh<Scalar> clean_in(Axes axes, const TriangleMesh<Scalar>& mesh) {
    constexpr auto millionth = Scalar(1e-6);
    Eigen::AlignedBox<Scalar, 3> box = robust_box(mesh);
    std::optional<TriangleMesh<Scalar>> nearer; // where not all is
    if (auto near_faces = faces_within_reach(mesh, box)) {
        nearer = TriangleMesh<Scalar>{mesh.vertices, *std::move(near_faces)};
        box = robust_box(*nearer);
    }
    const TriangleMesh<Scalar>& near = nearer ? *nearer : mesh;
    const Scalar tolerance = millionth * box.diagonal().norm();
    std::optional<Welding> welding;
    bool is_sound_already = false;
    core::in_parallel([&] { welding = find_welds(near, tolerance); }, [&] { is_sound_already = is_sound(mesh); });
    if (!nearer && welding->keeps(mesh.vertices.rows()) && is_sound_already) {
        CleanMesh<Scalar> out;
        out.mesh = mesh;
        out.is_sound = true;
        return out;
    }
    WeldedMesh<Scalar> welded = weld(near, *std::move(welding));
    const std::vector<int> placed = welded.placed;
    const int all_seams = welded.welded;
    std::optional<Similarity<Scalar>> similarity;
    if (axes == Axes::own && core::surface_area(welded.mesh) > 0) similarity = canonical_places(welded.mesh).similarity;
    const auto cleaned = [&](WeldedMesh<Scalar> each) {
        if (similarity) each.mesh = placed_by(*similarity, std::move(each.mesh));
        CleanMesh<Scalar> out = clean_welded(std::move(each), mesh.faces.rows());
        if (similarity) out.similarity = *similarity;
        return out;
    };
    CleanMesh<Scalar> out = cleaned(std::move(welded));
    if (all_seams == 0 || is_sound(out.mesh)) return out;
    WeldedMesh<Scalar> in_pieces = weld(near, tolerance, in_closed_pieces(near, placed));
    return in_pieces.welded < all_seams ? cleaned(std::move(in_pieces)) : out;
}

} // namespace detail

template <typename Scalar>
CleanMesh<Scalar> clean(const TriangleMesh<Scalar>& mesh) {
    return detail::clean_in(detail::Axes::given, mesh);
}

template <typename Scalar>
CleanMesh<Scalar> clean_in_own_axes(const TriangleMesh<Scalar>& mesh) {
    return detail::clean_in(detail::Axes::own, mesh);
}

} // namespace skelgen::surface
