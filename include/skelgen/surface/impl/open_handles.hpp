#pragma once

#include <skelgen/surface/open_handles.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/cut_surface.hpp>
#include <skelgen/surface/handle_loops.hpp>

namespace skelgen::surface {
namespace detail {

/// Lengths of loops as handle_loops weighs them, in units of the square root of the area, 1.34 m on an adult. A wrist's
/// girth is 0.12, a finger's 0.05.
inline constexpr double short_loop = 0.09;

/// A loop that counts no more than half its length runs along creases; it may be this long.
inline constexpr double crease_share = 0.5, short_seam = 0.15;

inline constexpr int most_handles = 100;

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
bool is_contact(const TriangleMesh<Scalar>& mesh, const HandleLoop<Scalar>& loop) {
    if (loop.length < static_cast<Scalar>(short_loop)) return true;
    return loop.length < static_cast<Scalar>(short_seam) &&
           loop.length < static_cast<Scalar>(crease_share) * girth(mesh, loop.vertices);
}

/// Of loops that are contacts' those without a vertex in common, the shortest first: independent, as the basis is, they
/// leave the surface in one.
template <typename Scalar>
std::vector<std::vector<int>> contacts_apart(const TriangleMesh<Scalar>& mesh,
                                             const std::vector<HandleLoop<Scalar>>& loops) {
    std::vector<bool> taken(static_cast<std::size_t>(mesh.vertices.rows()), false);
    std::vector<std::vector<int>> out;
    for (const HandleLoop<Scalar>& loop : loops) {
        const bool is_free = std::none_of(loop.vertices.begin(), loop.vertices.end(),
                                          [&](int v) { return taken[static_cast<std::size_t>(v)]; });
        if (!is_free || loop.vertices.size() < 3 || !is_contact(mesh, loop)) continue;
        for (const int v : loop.vertices) taken[static_cast<std::size_t>(v)] = true;
        out.push_back(loop.vertices);
    }
    return out;
}

/// Of each quarter of each loop the vertex in the deepest crease: a loop that leads from one limb to another crosses
/// the seam between them.
template <typename Scalar>
std::vector<int> seam_crossings(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency,
                                const std::vector<HandleLoop<Scalar>>& loops) {
    constexpr std::size_t parts = 4;
    const std::vector<Scalar> factors = crease_factors(mesh, adjacency);
    const auto deeper = [&](int a, int b) {
        return factors[static_cast<std::size_t>(a)] < factors[static_cast<std::size_t>(b)];
    };
    std::vector<int> out;
    for (const HandleLoop<Scalar>& loop : loops)
        for (std::size_t part = 0; part < parts; ++part) {
            const auto at = [&](std::size_t i) {
                return loop.vertices.begin() + static_cast<std::ptrdiff_t>(i * loop.vertices.size() / parts);
            };
            if (at(part) == at(part + 1)) continue;
            const int v = *std::min_element(at(part), at(part + 1), deeper);
            if (std::find(out.begin(), out.end(), v) == out.end()) out.push_back(v);
        }
    return out;
}

/// Contacts' loops of a surface in canonical form, none where there are none: of those through its vertex farthest
/// along x, or else through where these cross seams.
template <typename Scalar>
std::vector<std::vector<int>> find_contacts(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency) {
    Eigen::Index farthest = 0;
    mesh.vertices.col(0).maxCoeff(&farthest);
    const std::vector<HandleLoop<Scalar>> loops = handle_loops(mesh, adjacency, static_cast<int>(farthest));
    std::vector<std::vector<int>> found = contacts_apart(mesh, loops);
    if (!found.empty()) return found;
    for (const int root : seam_crossings(mesh, adjacency, loops)) {
        found = contacts_apart(mesh, handle_loops(mesh, adjacency, root));
        if (!found.empty()) return found;
    }
    return {};
}

} // namespace detail

template <typename Scalar>
Body<Scalar> open_handles(Body<Scalar> body) {
    const int handles = detail::genus(body.mesh);
    if (handles < 1 || handles > detail::most_handles || body.adjacency.minCoeff() < 0) return body;
    std::size_t opened = 0;
    for (int left = handles; left > 0;) {
        const std::vector<std::vector<int>> loops = detail::find_contacts(body.mesh, body.adjacency);
        if (loops.empty()) break;
        CutSurface<Scalar> cut = cut_along(body.mesh, body.adjacency, loops);
        body = resurfaced(std::move(body), std::move(cut.mesh), cut.source);
        opened += loops.size();
        left -= static_cast<int>(loops.size());
    }
    if (opened > 0)
        body.repairs.push_back("the body has grown together with itself in " + std::to_string(opened) +
                               (opened == 1 ? " place" : " places") + ": it was opened there");
    return body;
}

} // namespace skelgen::surface
