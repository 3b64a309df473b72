#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::applications {

namespace detail {

/// How many times faces surround a place: the solid angle under which it sees them, of all directions.
inline core::Accumulator winding_around(const Vector3<core::Accumulator>& place,
                                        const Points<core::Accumulator>& vertices, const Triangles& faces,
                                        const std::vector<int>& which) {
    using core::Accumulator;
    Accumulator sum = 0;
    for (const int f : which) {
        Vector3<Accumulator> corners[3];
        for (int k = 0; k < 3; ++k) corners[k] = core::point(vertices, faces(f, k)) - place;
        const auto& [a, b, c] = corners;
        const Accumulator la = a.norm(), lb = b.norm(), lc = c.norm();
        sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return sum / (4 * std::numbers::pi_v<Accumulator>);
}

/// An edge of a part's rim, the smaller end first, and how much more often faces run along it than back.
struct RimEdge {
    int from = 0, to = 0, times = 0;
};

inline std::vector<RimEdge> rims_of(const Triangles& part) {
    std::vector<RimEdge> edges;
    edges.reserve(static_cast<std::size_t>(part.size()));
    for (Eigen::Index f = 0; f < part.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = part(f, k), b = part(f, (k + 1) % 3);
            edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
        }
    const auto ends = [](const RimEdge& edge) { return std::pair(edge.from, edge.to); };
    std::sort(edges.begin(), edges.end(), [&](const RimEdge& a, const RimEdge& b) { return ends(a) < ends(b); });
    std::vector<RimEdge> rim;
    for (const RimEdge& edge : edges) {
        if (!rim.empty() && ends(rim.back()) == ends(edge))
            rim.back().times += edge.times;
        else {
            if (!rim.empty() && rim.back().times == 0) rim.pop_back();
            rim.push_back(edge);
        }
    }
    if (!rim.empty() && rim.back().times == 0) rim.pop_back();
    return rim;
}

} // namespace detail

/// The faces whose corners follow a joint most: `strongest` per vertex the joint that it follows most. O(faces).
inline Triangles faces_following(const Triangles& faces, const std::vector<int>& strongest, int joint) {
    Triangles out(faces.rows(), 3);
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        const auto follows = [&](int k) { return strongest[static_cast<std::size_t>(faces(f, k))] == joint; };
        if (follows(0) && follows(1) && follows(2)) out.row(kept++) = faces.row(f);
    }
    out.conservativeResize(kept, 3);
    return out;
}

/// Of the connected pieces of a part of a surface the one that surrounds a bone most: a limb's own skin, or the sleeve
/// that stands for it. Half a skirt and a shield follow bones, too, but what they hold with their rims closed is no
/// volume of a limb. None of them surrounds it: none. O(vertices + faces log faces).
inline Triangles around_bone(const Points<core::Accumulator>& vertices, const Triangles& part,
                             const Vector3<core::Accumulator>& from, const Vector3<core::Accumulator>& to) {
    core::DisjointSets sets(static_cast<std::size_t>(vertices.rows()));
    for (Eigen::Index f = 0; f < part.rows(); ++f)
        for (int k = 0; k < 2; ++k)
            sets.unite(static_cast<std::size_t>(part(f, k)), static_cast<std::size_t>(part(f, k + 1)));
    std::map<std::size_t, std::vector<int>> pieces;
    for (int f = 0; f < part.rows(); ++f) pieces[sets.find(static_cast<std::size_t>(part(f, 0)))].push_back(f);
    std::vector<int> best;
    core::Accumulator most = 0;
    for (const auto& [unused, faces] : pieces) {
        core::Accumulator winding = 0;
        for (const core::Accumulator along : {0.25, 0.5, 0.75})
            winding += detail::winding_around(from + along * (to - from), vertices, part, faces);
        if (!(std::abs(winding) > most)) continue; // scans may be inside out
        most = std::abs(winding);
        best = faces;
    }
    return part(best, Eigen::all);
}

/// Volume of a part of a surface, each rim of which is closed by a fan around its middle, cube of the vertices' unit;
/// negative where faces look inwards. Edges count as often as faces run along them one way more than the other: where
/// sheets meet in an edge, or faces lie twice, all is closed, too, and what moves rigidly keeps its volume.
/// O(vertices + faces log faces).
inline core::Accumulator closed_volume(const Points<core::Accumulator>& vertices, const Triangles& part) {
    using core::Accumulator;
    struct Rim {
        Vector3<Accumulator> sum = Vector3<Accumulator>::Zero(); ///< of places along it, by length
        Accumulator length = 0;
    };
    const std::vector<detail::RimEdge> edges = detail::rims_of(part);
    core::DisjointSets loops(static_cast<std::size_t>(vertices.rows()));
    for (const auto& edge : edges) loops.unite(static_cast<std::size_t>(edge.from), static_cast<std::size_t>(edge.to));
    std::map<std::size_t, Rim> rims;
    for (const auto& edge : edges) {
        const Vector3<Accumulator> a = core::point(vertices, edge.from), b = core::point(vertices, edge.to);
        const Accumulator length = std::abs(edge.times) * (a - b).norm();
        Rim& rim = rims[loops.find(static_cast<std::size_t>(edge.from))];
        rim.sum += length / 2 * (a + b);
        rim.length += length;
    }
    Accumulator volume = core::enclosed_volume(TriangleMesh<Accumulator>{vertices, part});
    for (const auto& edge : edges) {
        const Rim& rim = rims.at(loops.find(static_cast<std::size_t>(edge.from)));
        if (!(rim.length > 0)) continue;
        const Vector3<Accumulator> a = core::point(vertices, edge.from), b = core::point(vertices, edge.to);
        volume += edge.times * b.dot(a.cross(rim.sum / rim.length)) / 6;
    }
    return volume;
}

} // namespace skelgen::applications
