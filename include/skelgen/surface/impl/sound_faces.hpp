#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/face_tree.hpp>
#include <skelgen/surface/impl/visibility.hpp>

namespace skelgen::surface {

/// Faces without those that bound nothing, and how many of each kind went.
struct SoundFaces {
    Triangles faces;    ///< those that stay, in their order
    int degenerate = 0; ///< repeated a vertex
    int duplicate = 0;  ///< had the same three vertices as an earlier one
    int spikes = 0;     ///< reached far away with a corner of theirs alone, from an edge that is short beside that way
    int fins = 0;       ///< stuck out of the surface: patches up to a hundredth of its area with a free edge, joined to
                        ///< it where two other faces meet
    int walls = 0;      ///< inside: patches that start where two other faces meet and that no ray from outside reaches
};

namespace detail {

/// The rows of `faces` that are marked.
inline Triangles marked_faces(const Triangles& faces, const std::vector<bool>& marked) {
    Triangles out(std::count(marked.begin(), marked.end(), true), 3);
    Eigen::Index row = 0;
    for (std::size_t f = 0; f < marked.size(); ++f)
        if (marked[f]) out.row(row++) = faces.row(static_cast<Eigen::Index>(f));
    return out;
}

/// Leaves out faces that repeat a vertex, and the later of those with the same three.
inline SoundFaces distinct_faces(const Triangles& faces) {
    struct Key {
        std::array<int, 3> corners;
        std::size_t face;
    };
    SoundFaces out;
    std::vector<Key> keys;
    std::vector<bool> keep(static_cast<std::size_t>(faces.rows()), true);
    keys.reserve(keep.size());
    for (std::size_t f = 0; f < keep.size(); ++f) {
        const auto row = static_cast<Eigen::Index>(f);
        std::array<int, 3> corners{faces(row, 0), faces(row, 1), faces(row, 2)};
        std::sort(corners.begin(), corners.end());
        keep[f] = corners[0] != corners[1] && corners[1] != corners[2];
        if (keep[f])
            keys.push_back({corners, f});
        else
            ++out.degenerate;
    }
    std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
        return a.corners != b.corners ? a.corners < b.corners : a.face < b.face;
    });
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (keys[i].corners == keys[i - 1].corners) {
            keep[keys[i].face] = false;
            ++out.duplicate;
        }
    out.faces = out.degenerate + out.duplicate == 0 ? faces : marked_faces(faces, keep);
    return out;
}

/// Leaves out faces of which one corner has been torn away, as by a fault of the file: no other face has it, and both
/// edges to it are far longer than the third one and than the faces of the mesh are wide.
template <typename Scalar>
SoundFaces without_spikes(const Points<Scalar>& vertices, SoundFaces counted) {
    constexpr Scalar beside_third = 4, beside_width = 6;
    const TriangleMesh<Scalar> mesh{vertices, counted.faces};
    const auto m = static_cast<std::size_t>(mesh.faces.rows());
    if (m == 0) return counted;
    const Scalar width = std::sqrt(static_cast<Scalar>(core::surface_area(mesh)) / static_cast<Scalar>(m));
    std::vector<int> faces_at(static_cast<std::size_t>(vertices.rows()), 0);
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) ++faces_at[static_cast<std::size_t>(mesh.faces.data()[i])];
    const auto is_spike = [&](Eigen::Index f) {
        for (int k = 0; k < 3; ++k) {
            if (faces_at[static_cast<std::size_t>(mesh.faces(f, k))] != 1) continue;
            const Vector3<Scalar> tip = core::point(vertices, mesh.faces(f, k));
            const Vector3<Scalar> a = core::point(vertices, mesh.faces(f, (k + 1) % 3));
            const Vector3<Scalar> b = core::point(vertices, mesh.faces(f, (k + 2) % 3));
            const Scalar shorter = std::min((tip - a).norm(), (tip - b).norm());
            if (shorter > beside_third * (a - b).norm() && shorter > beside_width * width) return true;
        }
        return false;
    };
    std::vector<bool> keep(m, true);
    for (std::size_t f = 0; f < m; ++f)
        if (is_spike(static_cast<Eigen::Index>(f))) {
            keep[f] = false;
            ++counted.spikes;
        }
    if (counted.spikes > 0) counted.faces = marked_faces(counted.faces, keep);
    return counted;
}

/// Faces that hang together by edges of two faces, and how the patch ends.
struct Patch {
    std::vector<int> faces;
    std::vector<std::size_t> shared_edges; ///< those with more than two faces, once for each face of the patch there
    bool has_free_edge = false;
    core::Accumulator area = 0;
};

/// A surface's patches, and how many faces each of the edges has that more than two share.
struct Patches {
    std::vector<Patch> patches;
    std::vector<int> faces_at_shared_edge;
};

template <typename Scalar>
Patches patches_of(const TriangleMesh<Scalar>& mesh) {
    const auto m = static_cast<std::size_t>(mesh.faces.rows());
    const std::vector<core::DirectedEdge> edges = core::directed_edges(mesh.faces);
    core::DisjointSets joined(m);
    struct Ending {
        std::size_t face, edge;
    };
    std::vector<Ending> endings; // at shared edges
    std::vector<std::size_t> free_faces;
    Patches out;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        while (end < edges.size() && edges[end].joins_same(edges[i])) ++end;
        if (end - i == 1) free_faces.push_back(edges[i].corner / 3);
        if (end - i == 2) joined.unite(edges[i].corner / 3, edges[i + 1].corner / 3);
        if (end - i > 2) {
            for (std::size_t k = i; k < end; ++k)
                endings.push_back({edges[k].corner / 3, out.faces_at_shared_edge.size()});
            out.faces_at_shared_edge.push_back(static_cast<int>(end - i));
        }
        i = end;
    }
    if (endings.empty()) return out;
    std::vector<std::size_t> number(m, m);
    for (std::size_t f = 0; f < m; ++f) {
        std::size_t& patch = number[joined.find(f)];
        if (patch == m) {
            patch = out.patches.size();
            out.patches.emplace_back();
        }
        out.patches[patch].faces.push_back(static_cast<int>(f));
        out.patches[patch].area += core::face_area_vector(mesh, static_cast<Eigen::Index>(f)).norm();
    }
    for (const Ending& ending : endings)
        out.patches[number[joined.find(ending.face)]].shared_edges.push_back(ending.edge);
    for (const std::size_t f : free_faces) out.patches[number[joined.find(f)]].has_free_edge = true;
    return out;
}

/// Can a patch go without tearing the surface open: do two faces stay at each of its shared edges?
inline bool is_spare(const Patch& patch, const std::vector<int>& faces_at_shared_edge) {
    return !patch.shared_edges.empty() && std::all_of(patch.shared_edges.begin(), patch.shared_edges.end(),
                                                      [&](std::size_t edge) { return faces_at_shared_edge[edge] > 2; });
}

/// Marks what stays of a surface where more than two faces share an edge: small patches go first, hidden ones before.
template <typename Scalar>
SoundFaces without_fins_and_walls(TriangleMesh<Scalar> mesh, SoundFaces counted) {
    constexpr double most_of_area = 0.01; // of a fin: a hand is 2.5 % (LB44)
    constexpr double hidden = 0.15; // part of the rays: some slip out through holes, and walls bulge through the skin
    constexpr int samples = 32;
    Patches found = patches_of(mesh);
    counted.faces = mesh.faces;
    if (found.patches.empty()) return counted;
    const FaceTree<Scalar> tree(mesh);
    core::Accumulator area = 0;
    for (const Patch& patch : found.patches) area += patch.area;
    std::stable_sort(found.patches.begin(), found.patches.end(),
                     [](const Patch& a, const Patch& b) { return a.area < b.area; });
    std::vector<bool> keep(static_cast<std::size_t>(mesh.faces.rows()), true);
    const auto leave_out = [&](Patch& patch) {
        for (const int f : patch.faces) keep[static_cast<std::size_t>(f)] = false;
        for (const std::size_t edge : patch.shared_edges) --found.faces_at_shared_edge[edge];
        patch.shared_edges.clear();
        return static_cast<int>(patch.faces.size());
    };
    for (Patch& patch : found.patches) {
        if (!is_spare(patch, found.faces_at_shared_edge)) continue;
        const Visibility seen = look_out(mesh, tree, patch.faces, samples);
        if (seen.rays > 0 && seen.front <= hidden && seen.back <= hidden) counted.walls += leave_out(patch);
    }
    for (Patch& patch : found.patches)
        if (patch.has_free_edge && patch.area <= most_of_area * area && is_spare(patch, found.faces_at_shared_edge))
            counted.fins += leave_out(patch);
    counted.faces = marked_faces(mesh.faces, keep);
    return counted;
}

} // namespace detail

/// Is a mesh one piece, each edge of which two faces share that run along it in opposite senses, with the inside behind
/// them? Vertices where fans of faces touch are allowed. O(n).
template <typename Scalar>
bool is_sound(const TriangleMesh<Scalar>& mesh) {
    // The edges that leave each vertex, one list after the other.
    struct Edge {
        int to;
        std::uint32_t face;
    };
    const auto n = static_cast<std::size_t>(mesh.vertices.rows()), m = static_cast<std::size_t>(mesh.faces.rows());
    const auto vertex = [&](std::size_t f, int k) { return mesh.faces(static_cast<Eigen::Index>(f), k % 3); };
    std::vector<std::size_t> end(n + 1, 0);
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) ++end[static_cast<std::size_t>(mesh.faces.data()[i]) + 1];
    for (std::size_t v = 0; v < n; ++v) end[v + 1] += end[v];
    std::vector<Edge> edges(3 * m);
    for (std::size_t f = 0; f < m; ++f)
        for (int k = 0; k < 3; ++k) {
            if (vertex(f, k) == vertex(f, k + 1)) return false;
            edges[end[static_cast<std::size_t>(vertex(f, k))]++] = {vertex(f, k + 1), static_cast<std::uint32_t>(f)};
        }
    const auto list_of = [&](std::size_t v) {
        const std::size_t begin = v > 0 ? end[v - 1] : 0;
        return std::span<const Edge>(edges).subspan(begin, end[v] - begin);
    };
    // Each runs there once, and back: as many run to higher vertices as to lower ones, each of the former has one back.
    std::size_t upwards = 0;
    core::DisjointSets joined(m);
    for (std::size_t v = 0; v < n; ++v) {
        const std::span<const Edge> list = list_of(v);
        for (std::size_t i = 0; i < list.size(); ++i) {
            for (std::size_t k = 0; k < i; ++k)
                if (list[k].to == list[i].to) return false;
            const auto to = static_cast<std::size_t>(list[i].to);
            if (to < v) continue;
            ++upwards;
            const std::span<const Edge> beyond = list_of(to);
            const auto back = std::find_if(beyond.begin(), beyond.end(),
                                           [&](const Edge& edge) { return edge.to == static_cast<int>(v); });
            if (back == beyond.end()) return false;
            joined.unite(list[i].face, back->face);
        }
    }
    return 2 * upwards == edges.size() && joined.count() == 1 && core::enclosed_volume(mesh) > 0;
}

/// The faces of a welded mesh that can bound a body. Patches end where more than two faces share an edge. Of a surface
/// without such edges nothing but degenerate and duplicate faces goes, and of one without free edges no spikes. O(n log
/// n).
template <typename Scalar>
SoundFaces sound_faces(const TriangleMesh<Scalar>& mesh) {
    SoundFaces kept = detail::without_spikes(mesh.vertices, detail::distinct_faces(mesh.faces));
    TriangleMesh<Scalar> rest{mesh.vertices, kept.faces};
    return detail::without_fins_and_walls(std::move(rest), std::move(kept));
}

} // namespace skelgen::surface
