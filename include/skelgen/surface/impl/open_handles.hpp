#pragma once

#include <skelgen/surface/open_handles.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/cut_surface.hpp>
#include <skelgen/surface/handle_loops.hpp>

namespace skelgen::surface {
namespace detail {

/// Lengths of loops as handle_loops weighs them, in units of the square root of the area, 1.34 m on an adult. A wrist's
/// girth is 0.12, a finger's 0.05.
inline constexpr double short_loop = 0.1;

/// A loop that counts no more than half its length runs along creases; it may be this long.
inline constexpr double crease_share = 0.5, short_seam = 0.15;

/// Fingers, hands and heels make up to a dozen handles; torn surfaces have hundreds. So many are looked at, and of the
/// loops of each search so many, the shortest: a second's work.
inline constexpr int most_handles = 24;
inline constexpr std::size_t most_loops = 16;

/// How many handles a closed connected surface has.
template <typename Scalar>
int genus(const TriangleMesh<Scalar>& mesh) {
    const Eigen::Index vertices = mesh.vertices.rows(), faces = mesh.faces.rows();
    return static_cast<int>(1 - (vertices - faces / 2) / 2);
}

template <typename Scalar>
Scalar girth(const TriangleMesh<Scalar>& mesh, const std::vector<int>& loop) {
    Scalar sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        sum += (core::point(mesh.vertices, loop[i]) - core::point(mesh.vertices, loop[(i + 1) % loop.size()])).norm();
    return sum;
}

template <typename Scalar>
bool is_short(const TriangleMesh<Scalar>& mesh, const HandleLoop<Scalar>& loop) {
    return girth(mesh, loop.vertices) < static_cast<Scalar>(short_loop);
}

template <typename Scalar>
bool is_contact(const TriangleMesh<Scalar>& mesh, const HandleLoop<Scalar>& loop, Contacts contacts) {
    if (contacts == Contacts::short_alone) return is_short(mesh, loop);
    if (loop.length < static_cast<Scalar>(short_loop)) return true;
    return loop.length < static_cast<Scalar>(short_seam) &&
           loop.length < static_cast<Scalar>(crease_share) * girth(mesh, loop.vertices);
}

/// Of each quarter of a loop the vertex in the deepest crease: a loop that leads from one limb to another crosses the
/// seam between them.
template <typename Scalar>
std::vector<int> seam_crossings(const HandleLoop<Scalar>& loop, const std::vector<Scalar>& creases) {
    constexpr std::size_t parts = 4;
    const auto at = [&](std::size_t part) {
        return loop.vertices.begin() + static_cast<std::ptrdiff_t>(part * loop.vertices.size() / parts);
    };
    std::vector<int> out;
    for (std::size_t part = 0; part < parts; ++part)
        if (at(part) != at(part + 1))
            out.push_back(*std::min_element(at(part), at(part + 1), [&](int a, int b) {
                return creases[static_cast<std::size_t>(a)] < creases[static_cast<std::size_t>(b)];
            }));
    return out;
}

/// Roots are on a loop, not on the tightest one beside it: that is looked for within so many times the loop's length.
inline constexpr double looked_around = 1.5;

/// A contact's loop on a surface in canonical form, as tight as it is found: of those through the vertex farthest along
/// x, each shortest first, the loops through where it crosses seams are looked at. Loops far from a root are not tight.
template <typename Scalar>
std::optional<HandleLoop<Scalar>> find_contact(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency,
                                               Contacts contacts) {
    constexpr auto longest = static_cast<Scalar>(looked_around * std::max(short_loop, short_seam));
    Eigen::Index farthest = 0;
    mesh.vertices.col(0).maxCoeff(&farthest);
    const CreaseGraph<Scalar> creases = crease_graph(mesh, adjacency);
    std::vector<HandleLoop<Scalar>> loops = handle_loops(creases, static_cast<int>(farthest));
    if (loops.size() > most_loops) loops.resize(most_loops);
    for (const HandleLoop<Scalar>& loop : loops) {
        HandleLoop<Scalar> tightest = loop;
        for (const int root : seam_crossings(loop, creases.factors)) {
            const Scalar limit = std::min(longest, static_cast<Scalar>(looked_around) * tightest.length);
            std::vector<HandleLoop<Scalar>> tighter = handle_loops(creases, root, limit);
            if (!tighter.empty() && tighter.front().length < tightest.length) tightest = std::move(tighter.front());
        }
        if (is_contact(mesh, tightest, contacts) && tightest.vertices.size() >= 3) return tightest;
    }
    return std::nullopt;
}

/// The surface cut open at one contact after another.
template <typename Scalar>
std::optional<OpenedBody<Scalar>> opened_on(const Body<Scalar>& body, OpenedSurface<Scalar> surface,
                                            Contacts contacts) {
    const int handles = genus(body.mesh);
    if (handles < 1 || handles > most_handles || !body.is_closed) return std::nullopt;
    OpenedBody<Scalar> out;
    auto& [mesh, adjacency, source, opened] = surface;
    for (; opened < handles; ++opened) {
        const auto loop = find_contact(mesh, adjacency, contacts);
        if (!loop) break;
        // No edge counts more than its length: the short loops are contacts in any case, and come in the same order.
        if (!out.before_creases && !is_short(mesh, *loop)) out.before_creases = surface;
        CutSurface<Scalar> cut = cut_along(mesh, adjacency, {loop->vertices});
        mesh = std::move(cut.mesh);
        adjacency = core::face_adjacency(mesh.faces);
        source = opened > 0 ? composed(std::move(cut.source), source) : std::move(cut.source);
    }
    if (opened == 0) return std::nullopt;
    out.body = resurfaced(body, std::move(mesh), std::move(source));
    out.body.repairs.push_back("the body has grown together with itself in " + std::to_string(opened) +
                               (opened == 1 ? " place" : " places") + ": it was opened there");
    return out;
}

} // namespace detail

template <typename Scalar>
std::optional<OpenedBody<Scalar>> open_handles(const Body<Scalar>& body, Contacts contacts) {
    return detail::opened_on(body, {body.mesh, body.adjacency, {}, 0}, contacts);
}

template <typename Scalar>
std::optional<OpenedBody<Scalar>> open_short_handles(const Body<Scalar>& body, const OpenedBody<Scalar>& opened) {
    return opened.before_creases ? detail::opened_on(body, *opened.before_creases, Contacts::short_alone) : opened;
}

} // namespace skelgen::surface
