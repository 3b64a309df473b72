#pragma once

#include <skelgen/surface/open_handles.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/impl/cut_surface.hpp>
#include <skelgen/surface/impl/handle_loops.hpp>

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
bool is_contact(const TriangleMesh<Scalar>& mesh, const HandleLoop<Scalar>& loop) {
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

/// The tightest loop found around the contact of a loop, among those through where that crosses seams.
template <typename Scalar>
HandleLoop<Scalar> tightened(const CreaseGraph<Scalar>& creases, HandleLoop<Scalar> loop) {
    constexpr auto longest = static_cast<Scalar>(looked_around * std::max(short_loop, short_seam));
    for (const int root : seam_crossings(loop, creases.factors)) {
        const Scalar limit = std::min(longest, static_cast<Scalar>(looked_around) * loop.length);
        std::vector<HandleLoop<Scalar>> tighter = handle_loops(creases, root, limit);
        if (!tighter.empty() && tighter.front().length < loop.length) loop = std::move(tighter.front());
    }
    return loop;
}

/// Short loops that can be cut at once: the surface hangs together without all of them, and each is farther from the
/// others than what a cut there changes of the ways around it. They are then what they are one after the other.
template <typename Scalar>
class LoopsApart {
public:
    explicit LoopsApart(const CreaseGraph<Scalar>& creases)
        : creases_(creases), next_(creases.factors.size(), -1), is_beside_(creases.factors.size(), false) {}

    /// Adds a loop if it can be cut with those that were added. \returns whether it can.
    bool add_if_apart(const HandleLoop<Scalar>& loop) {
        const std::vector<int>& line = loop.vertices;
        if (std::any_of(line.begin(), line.end(), [&](int v) { return is_beside_[at(v)]; })) return false;
        for (std::size_t i = 0; i < line.size(); ++i) next_[at(line[i])] = line[(i + 1) % line.size()];
        if (!loops_.empty() && !hangs_together()) {
            for (const int v : line) next_[at(v)] = -1;
            return false;
        }
        loops_.push_back(line);
        const std::vector<Scalar> way =
            core::shortest_paths(creases_.graph, line.front(), static_cast<Scalar>(short_loop)).distance;
        for (std::size_t v = 0; v < way.size(); ++v)
            if (std::isfinite(way[v])) is_beside_[v] = true;
        for (const int v : line) is_beside_[at(v)] = true;
        return true;
    }
    [[nodiscard]] const std::vector<std::vector<int>>& loops() const { return loops_; }

private:
    static std::size_t at(int i) { return static_cast<std::size_t>(i); }
    [[nodiscard]] bool hangs_together() const {
        core::DisjointSets across(creases_.faces);
        for (const auto& [ends, faces, weight] : creases_.edges)
            if (next_[at(ends[0])] != ends[1] && next_[at(ends[1])] != ends[0])
                across.unite(at(faces[0]), at(faces[1]));
        return across.count() == 1;
    }

    const CreaseGraph<Scalar>& creases_;
    std::vector<int> next_;       ///< per vertex the next one on its loop, -1 off them
    std::vector<bool> is_beside_; ///< per vertex, is it on a loop or near one?
    std::vector<std::vector<int>> loops_;
};

/// Contacts' loops on a surface in canonical form, as tight as they are found, `most` of them: of those through the
/// vertex farthest along x, each shortest first, the loops through where it crosses seams are looked at, up to the
/// first that is no short contact apart from those before it. Loops far from a root are not tight.
template <typename Scalar>
std::vector<std::vector<int>> find_contacts(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency,
                                            std::size_t most) {
    Eigen::Index farthest = 0;
    mesh.vertices.col(0).maxCoeff(&farthest);
    const CreaseGraph<Scalar> creases = crease_graph(mesh, adjacency);
    std::vector<HandleLoop<Scalar>> loops = handle_loops(creases, static_cast<int>(farthest));
    if (loops.size() > most_loops) loops.resize(most_loops);
    LoopsApart<Scalar> found(creases);
    for (const HandleLoop<Scalar>& loop : loops) {
        if (found.loops().size() == most) break;
        const HandleLoop<Scalar> tightest = tightened(creases, loop);
        const bool is_first = found.loops().empty();
        if (!is_contact(mesh, tightest) || tightest.vertices.size() < 3) {
            if (is_first) continue;
            break;
        }
        if (!is_short(mesh, tightest)) {
            if (is_first) return {tightest.vertices};
            break;
        }
        if (!found.add_if_apart(tightest)) break;
    }
    return found.loops();
}

} // namespace detail

template <typename Scalar>
std::optional<Body<Scalar>> open_handles(const Body<Scalar>& body) {
    const int handles = detail::genus(body.mesh);
    if (handles < 1 || handles > detail::most_handles || !body.is_closed) return std::nullopt;
    TriangleMesh<Scalar> mesh = body.mesh;
    Triangles adjacency = body.adjacency;
    std::vector<int> source; // per vertex that of the body, -1 for new ones
    int opened = 0;
    while (opened < handles) {
        const auto loops = detail::find_contacts(mesh, adjacency, static_cast<std::size_t>(handles - opened));
        if (loops.empty()) break;
        CutSurface<Scalar> cut = cut_along(mesh, adjacency, loops);
        mesh = std::move(cut.mesh);
        adjacency = core::face_adjacency(mesh.faces);
        source = opened > 0 ? composed(std::move(cut.source), source) : std::move(cut.source);
        opened += static_cast<int>(loops.size());
    }
    if (opened == 0) return std::nullopt;
    Body<Scalar> out = resurfaced(body, std::move(mesh), std::move(source));
    out.repairs.push_back("the body has grown together with itself in " + std::to_string(opened) +
                          (opened == 1 ? " place" : " places") + ": it was opened there");
    return out;
}

} // namespace skelgen::surface
