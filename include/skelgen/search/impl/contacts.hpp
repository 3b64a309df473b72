#pragma once

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/curve/regions.hpp>
#include <skelgen/embedding/loop_cuts.hpp>
#include <skelgen/embedding/spectral_matching.hpp>
#include <skelgen/surface/body.hpp>
#include <skelgen/surface/cut_surface.hpp>
#include <skelgen/surface/manifold_parts.hpp>

namespace skelgen::search {

/// Most places in which a body may touch itself: head, trunk, arms and legs, each two of them once. Torn surfaces have
/// dozens of loops.
inline constexpr int most_contacts = 15;

namespace detail {

/// Vertices that belong to these curve nodes, ascending; `nodes` are indices below `node_count`.
inline std::vector<int> vertices_at(const std::vector<int>& nodes, const std::vector<int>& node_of_vertex,
                                    Eigen::Index node_count) {
    std::vector<bool> wanted(static_cast<std::size_t>(node_count), false);
    for (const int n : nodes) wanted[static_cast<std::size_t>(n)] = true;
    std::vector<int> out;
    for (std::size_t v = 0; v < node_of_vertex.size(); ++v)
        if (node_of_vertex[v] >= 0 && wanted[static_cast<std::size_t>(node_of_vertex[v])])
            out.push_back(static_cast<int>(v));
    return out;
}

/// The same with vertices that are new in the mesh, or belonged to no node, at the node of a neighbour.
template <typename Scalar>
std::vector<int> filled_from_neighbours(std::vector<int> node_of_vertex, const TriangleMesh<Scalar>& mesh) {
    node_of_vertex.resize(static_cast<std::size_t>(mesh.vertices.rows()), -1);
    const auto node = [&](Eigen::Index f, int k) -> int& {
        return node_of_vertex[static_cast<std::size_t>(mesh.faces(f, k))];
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
            for (int k = 0; k < 3; ++k) {
                if (node(f, k) >= 0) continue;
                node(f, k) = std::max(node(f, (k + 1) % 3), node(f, (k + 2) % 3));
                changed = changed || node(f, k) >= 0;
            }
    }
    return node_of_vertex;
}

/// The body with its surface cut; none when that takes off a limb.
template <typename Scalar>
std::optional<Body<Scalar>> with_cuts(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                                      const embedding::LoopCuts& cuts) {
    TriangleMesh<Scalar> mesh = body.mesh;
    std::vector<int> source(static_cast<std::size_t>(mesh.vertices.rows()));
    std::iota(source.begin(), source.end(), 0);
    std::vector<int> node = curve::node_of_vertex(curve, mesh.vertices.rows());
    const auto vertices_of = [&](const std::vector<int>& nodes) {
        return vertices_at(nodes, node, curve.nodes.rows());
    };
    for (const embedding::LoopCut& cut : cuts) {
        surface::CutSurface<Scalar> parted = surface::cut_surface(mesh, vertices_of(cut.limb), vertices_of(cut.other));
        mesh = std::move(parted.mesh);
        source = surface::composed(std::move(parted.source), source);
        node = filled_from_neighbours(std::move(node), mesh);
    }
    surface::ManifoldParts<Scalar> whole = surface::largest_manifold_part(mesh);
    // Of the area: a hand with its forearm is 5.5 % of it (LB44), and the holes' lids add less.
    constexpr auto nearly_all = static_cast<Scalar>(0.95);
    if (core::surface_area(whole.mesh) < nearly_all * core::surface_area(body.mesh)) return std::nullopt;
    return surface::resurfaced(body, std::move(whole.mesh), surface::composed(std::move(whole.source), source));
}

} // namespace detail

/// A body cut where it touches itself: at the loops of its `curve`, where the template then fits best (see
/// embedding::find_loop_cuts). `curve` is connected and its regions index the body's vertices. Vertices along the cuts
/// are there twice, and new ones close the holes. \returns a body for each way to cut, best first; not those where a
/// cut takes off a limb; none when `curve` has no loop or more than `most_contacts`, or when no way to cut it lets the
/// template in. As find_loop_cuts, and O(n log n) for each way. \throws Error usage when an option is out of its range.
template <typename Scalar>
std::vector<Body<Scalar>> cut_at_contacts(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                                          const SkeletonTemplate& skeleton_template,
                                          const embedding::MatchingOptions& matching = {}) {
    if (core::cycle_count(curve) > most_contacts) return {};
    std::vector<Body<Scalar>> out;
    for (const embedding::LoopCuts& cuts : embedding::find_loop_cuts(curve, skeleton_template, matching))
        if (auto cut = detail::with_cuts(body, curve, cuts)) out.push_back(*std::move(cut));
    return out;
}

} // namespace skelgen::search
