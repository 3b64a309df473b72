#pragma once

#include <skelgen/surface/clean.hpp>

#include <string_view>
#include <utility>

#include <skelgen/core/error.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/surface/orientation.hpp>
#include <skelgen/surface/sound_faces.hpp>
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

} // namespace detail

template <typename Scalar>
CleanMesh<Scalar> clean(const TriangleMesh<Scalar>& mesh) {
    constexpr auto millionth = Scalar(1e-6);
    const TriangleMesh<Scalar> near{mesh.vertices, faces_within_reach(mesh)};
    const Scalar tolerance = millionth * robust_box(near).diagonal().norm();
    WeldedMesh<Scalar> welded = weld(near, tolerance);
    if (welded.welded + welded.unused == 0 && near.faces.rows() == mesh.faces.rows() && is_sound(mesh)) {
        CleanMesh<Scalar> out;
        out.mesh = mesh;
        out.is_sound = true;
        return out;
    }
    const std::vector<int> placed = welded.placed;
    const int all_seams = welded.welded;
    CleanMesh<Scalar> out = detail::clean_welded(std::move(welded), mesh.faces.rows());
    if (all_seams == 0 || is_sound(out.mesh)) return out;
    WeldedMesh<Scalar> in_pieces = weld(near, tolerance, in_closed_pieces(near, placed));
    return in_pieces.welded < all_seams ? detail::clean_welded(std::move(in_pieces), mesh.faces.rows()) : out;
}

} // namespace skelgen::surface
