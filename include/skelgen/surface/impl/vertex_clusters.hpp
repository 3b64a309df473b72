#pragma once

#include <skelgen/surface/vertex_clusters.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/surface/canonical_form.hpp>

namespace skelgen::surface {
namespace detail {

/// Per vertex the cell of a grid in which it lies, its numbers along x, y and z in one.
template <typename Scalar>
std::vector<std::uint64_t> grid_cells(const Points<Scalar>& places, Scalar width) {
    constexpr std::int64_t middle = std::int64_t(1) << 20; // of 21 bits
    constexpr std::uint64_t mask = (std::uint64_t(1) << 21) - 1;
    constexpr Scalar odd = Scalar(0.382); // of a cell: no plane of the grid goes through the middle of the surface
    constexpr auto most = static_cast<Scalar>(middle - 1); // beyond are vertices that no face has
    std::vector<std::uint64_t> out(static_cast<std::size_t>(places.rows()), 0);
    constexpr std::size_t in_a_row = 1 << 15;
    core::parallel_for(out.size(), in_a_row, [&](std::size_t v) {
        for (int k = 0; k < 3; ++k) {
            const Scalar along = std::floor(places(static_cast<Eigen::Index>(v), k) / width + odd);
            const auto cell =
                static_cast<std::uint64_t>(static_cast<std::int64_t>(std::max(-most, std::min(most, along))) + middle);
            out[v] = out[v] << 21 | (cell & mask);
        }
    });
    return out;
}

/// The vertices on the boundary of a manifold surface: those that an edge leaves to a neighbour from which none comes.
inline std::vector<bool> boundary_vertices(const Triangles& faces, std::size_t vertices) {
    std::vector<std::int64_t> sum(vertices, 0); // of the numbers of those it leaves to, less those it comes from
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            sum[static_cast<std::size_t>(faces(f, k))] += faces(f, (k + 1) % 3);
            sum[static_cast<std::size_t>(faces(f, (k + 1) % 3))] -= faces(f, k);
        }
    std::vector<bool> out(vertices);
    for (std::size_t v = 0; v < vertices; ++v) out[v] = sum[v] != 0;
    return out;
}

/// Vertices that become one: per vertex the lowest of its cluster, itself where it stays alone.
using Clusters = std::vector<int>;

/// Those of each cell that its edges join; those on the boundary stay alone.
template <typename Scalar>
Clusters clusters_in_cells(const TriangleMesh<Scalar>& mesh, const std::vector<std::uint64_t>& cells,
                           const std::vector<bool>& is_boundary) {
    core::DisjointSets joined(cells.size());
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto a = static_cast<std::size_t>(mesh.faces(f, k)),
                       b = static_cast<std::size_t>(mesh.faces(f, (k + 1) % 3));
            if (a < b && cells[a] == cells[b] && !is_boundary[a] && !is_boundary[b]) joined.unite(a, b);
        }
    Clusters out(cells.size());
    for (std::size_t v = 0; v < out.size(); ++v) out[v] = static_cast<int>(joined.find(v));
    return out;
}

/// Where the vertices of each cluster are in the middle, known by its lowest vertex.
struct ClusterMiddles {
    std::vector<Vector3<core::Accumulator>> places;
    std::vector<int> count; ///< of vertices; 0 for those that are not the lowest of a cluster
};

template <typename Scalar>
ClusterMiddles middles_of(const Clusters& clusters, const Points<Scalar>& places) {
    ClusterMiddles out{{clusters.size(), Vector3<core::Accumulator>::Zero()}, std::vector<int>(clusters.size(), 0)};
    for (std::size_t v = 0; v < clusters.size(); ++v) {
        const auto cluster = static_cast<std::size_t>(clusters[v]);
        for (int k = 0; k < 3; ++k) out.places[cluster][k] += places(static_cast<Eigen::Index>(v), k);
        ++out.count[cluster];
    }
    for (std::size_t v = 0; v < clusters.size(); ++v)
        if (out.count[v] > 0) out.places[v] /= out.count[v];
    return out;
}

/// Tells apart what is as large or as near: how far a place is along a direction in which no two are level.
inline core::Accumulator askew_height(const Vector3<core::Accumulator>& place) {
    return Vector3<core::Accumulator>(1, 0.7548776662466927, 0.5698402909980532).dot(place);
}

/// The clusters beside each cluster, as long as they are few.
class FewNeighbours {
public:
    static constexpr int most = 3;

    explicit FewNeighbours(std::size_t clusters) : lists_(clusters, {-1, -1, -1, -1}) {}

    void add(int cluster, int neighbour) {
        auto& list = lists_[static_cast<std::size_t>(cluster)];
        for (int& entry : list) {
            if (entry == neighbour) return;
            if (entry < 0) {
                entry = neighbour;
                return;
            }
        }
    }
    /// Those of a cluster, the first `most` + 1; behind them, -1.
    [[nodiscard]] const std::array<int, most + 1>& of(int cluster) const {
        return lists_[static_cast<std::size_t>(cluster)];
    }
    [[nodiscard]] bool are_few(int cluster) const { return of(cluster)[most] < 0; }

private:
    std::vector<std::array<int, most + 1>> lists_;
};

/// Clusters that have but three others or fewer around them, where a corner of a cell cuts the surface, become part of
/// the largest of those. \returns whether there were any.
template <typename Scalar>
bool absorb_slivers(Clusters& clusters, const TriangleMesh<Scalar>& mesh, const Points<Scalar>& places, Scalar width,
                    const std::vector<bool>& is_boundary) {
    const ClusterMiddles middles = middles_of(clusters, places);
    FewNeighbours around(clusters.size());
    std::vector<bool> is_close(clusters.size(), true); // all neighbours within the width of a cell
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3);
            if (a > b) continue; // its other side, or on the boundary, where no cluster is a sliver
            const int one = clusters[static_cast<std::size_t>(a)], other = clusters[static_cast<std::size_t>(b)];
            if (one == other) continue;
            around.add(one, other);
            around.add(other, one);
            if (!around.are_few(one) && !around.are_few(other)) continue;
            if ((core::point(places, a) - core::point(places, b)).squaredNorm() > width * width)
                is_close[static_cast<std::size_t>(one)] = is_close[static_cast<std::size_t>(other)] = false;
        }
    const auto is_sliver = [&](std::size_t c) {
        return middles.count[c] > 0 && !is_boundary[c] && is_close[c] && around.are_few(static_cast<int>(c));
    };
    const auto precedes = [&](std::size_t a, std::size_t b) {
        return middles.count[a] != middles.count[b] ? middles.count[a] > middles.count[b]
                                                    : askew_height(middles.places[a]) > askew_height(middles.places[b]);
    };
    Clusters part_of(clusters.size());
    std::iota(part_of.begin(), part_of.end(), 0);
    bool any = false;
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        if (!is_sliver(c)) continue;
        int largest = -1;
        for (const int other : around.of(static_cast<int>(c))) {
            const auto o = static_cast<std::size_t>(other);
            if (other < 0 || is_boundary[o] || is_sliver(o)) continue;
            if (largest < 0 || precedes(o, static_cast<std::size_t>(largest))) largest = other;
        }
        if (largest < 0) continue;
        part_of[c] = largest;
        any = true;
    }
    if (!any) return false;
    Clusters lowest(clusters.size(), std::numeric_limits<int>::max());
    for (int& cluster : clusters) cluster = part_of[static_cast<std::size_t>(cluster)];
    for (std::size_t v = clusters.size(); v-- > 0;) lowest[static_cast<std::size_t>(clusters[v])] = static_cast<int>(v);
    for (int& cluster : clusters) cluster = lowest[static_cast<std::size_t>(cluster)];
    return true;
}

/// Leaves the vertices of marked clusters alone. \returns whether there were any.
inline bool dissolve(Clusters& clusters, const std::vector<bool>& marked) {
    bool any = false;
    for (std::size_t v = clusters.size(); v-- > 0;) { // the lowest, by which they are known, last
        if (!marked[static_cast<std::size_t>(clusters[v])] || clusters[v] == static_cast<int>(v)) continue;
        clusters[v] = static_cast<int>(v);
        any = true;
    }
    return any;
}

/// Leaves alone what is no disc, as around a finger. A surface of which discs become points stays what it is (Moo25);
/// vertices, edges and faces of a disc, and of nothing else that hangs together on a surface, add up to one.
inline void dissolve_rings(Clusters& clusters, const Triangles& faces) {
    const auto cluster_of = [&](int v) { return clusters[static_cast<std::size_t>(v)]; };
    std::vector<int> twice(clusters.size(), 0); // that sum: inner edges are met twice
    for (const int cluster : clusters) twice[static_cast<std::size_t>(cluster)] += 2;
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        const int a = cluster_of(faces(f, 0)), b = cluster_of(faces(f, 1)), c = cluster_of(faces(f, 2));
        if (a == b) --twice[static_cast<std::size_t>(a)];
        if (b == c) --twice[static_cast<std::size_t>(b)];
        if (c == a) --twice[static_cast<std::size_t>(c)];
        if (a == b && b == c) twice[static_cast<std::size_t>(a)] += 2;
    }
    std::vector<bool> is_ring(clusters.size());
    for (std::size_t v = 0; v < twice.size(); ++v) is_ring[v] = clusters[v] == static_cast<int>(v) && twice[v] != 2;
    dissolve(clusters, is_ring);
}

/// The faces whose corners are in three clusters, on those clusters' lowest vertices.
inline Triangles faces_between(const Clusters& clusters, const Triangles& faces) {
    std::vector<std::array<int, 3>> kept;
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        std::array<int, 3> face{};
        for (int k = 0; k < 3; ++k) face[static_cast<std::size_t>(k)] = clusters[static_cast<std::size_t>(faces(f, k))];
        if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) kept.push_back(face);
    }
    Triangles out(static_cast<Eigen::Index>(kept.size()), 3);
    for (std::size_t f = 0; f < kept.size(); ++f)
        out.row(static_cast<Eigen::Index>(f)) << kept[f][0], kept[f][1], kept[f][2];
    return out;
}

/// Marks the vertices where faces do not make a manifold surface with the given boundary: those of edges that have not
/// two faces of one orientation, and those whose faces are not one fan.
inline std::vector<bool> singular_vertices(const Triangles& faces, const std::vector<bool>& is_boundary) {
    const auto next_corner = [](std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
    std::vector<bool> out(is_boundary.size(), false);
    const std::vector<core::DirectedEdge> edges = core::directed_edges(faces);
    core::DisjointSets fans(edges.size()); // of the corners that are at one vertex
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        while (end < edges.size() && edges[end].joins_same(edges[i])) ++end;
        const auto low = static_cast<std::size_t>(edges[i].low), high = static_cast<std::size_t>(edges[i].high);
        const bool is_inner = end - i == 2 && edges[i].forward != edges[i + 1].forward;
        if (is_inner) {
            fans.unite(edges[i].corner, next_corner(edges[i + 1].corner));
            fans.unite(next_corner(edges[i].corner), edges[i + 1].corner);
        } else if (end - i != 1 || !is_boundary[low] || !is_boundary[high]) {
            out[low] = out[high] = true;
        }
        i = end;
    }
    std::vector<std::size_t> fan_at(is_boundary.size(), edges.size());
    for (std::size_t corner = 0; corner < edges.size(); ++corner) {
        const auto v = static_cast<std::size_t>(faces.data()[corner]);
        const std::size_t fan = fans.find(corner);
        if (fan_at[v] == edges.size()) fan_at[v] = fan;
        if (fan_at[v] != fan) out[v] = true;
    }
    return out;
}

/// Of each cluster the vertex nearest to its vertices' centre; of those as near, as of two, the highest. Per vertex
/// that of its cluster, where it is the lowest of it.
template <typename Scalar>
std::vector<int> middle_vertices(const Clusters& clusters, const Points<Scalar>& places, Scalar width) {
    using core::Accumulator;
    const auto near = static_cast<Accumulator>(width) * 1e-4; // what is so much nearer is nearest
    const ClusterMiddles middles = middles_of(clusters, places);
    const auto place = [&](std::size_t v) {
        return Vector3<Accumulator>(core::point(places, static_cast<Eigen::Index>(v)).template cast<Accumulator>());
    };
    const auto off_middle = [&](std::size_t v) {
        return (middles.places[static_cast<std::size_t>(clusters[v])] - place(v)).norm();
    };
    std::vector<Accumulator> least(clusters.size(), std::numeric_limits<Accumulator>::infinity());
    for (std::size_t v = 0; v < clusters.size(); ++v) {
        Accumulator& nearest = least[static_cast<std::size_t>(clusters[v])];
        nearest = std::min(nearest, off_middle(v));
    }
    std::vector<int> out(clusters.size(), -1);
    for (std::size_t v = 0; v < clusters.size(); ++v) {
        const auto cluster = static_cast<std::size_t>(clusters[v]);
        if (off_middle(v) > least[cluster] + near) continue;
        int& chosen = out[cluster];
        if (chosen < 0 || askew_height(place(v)) > askew_height(place(static_cast<std::size_t>(chosen))))
            chosen = static_cast<int>(v);
    }
    return out;
}

} // namespace detail

template <typename Scalar>
ClusteredMesh<Scalar> cluster_vertices(const TriangleMesh<Scalar>& mesh, Eigen::Index faces) {
    const auto n = static_cast<std::size_t>(mesh.vertices.rows());
    ClusteredMesh<Scalar> out;
    if (mesh.faces.rows() <= faces) {
        out.mesh = mesh;
        out.source.resize(n);
        std::iota(out.source.begin(), out.source.end(), 0);
        out.cluster = out.source;
        return out;
    }
    const Points<Scalar> places = canonical_places(mesh).vertices; // of unit area
    const std::vector<bool> is_boundary = detail::boundary_vertices(mesh.faces, n);
    // A surface of unit area meets 1.5 cells of unit width on average, less slivers 1.26 (measured), and has half as
    // many vertices as faces.
    const Scalar width = std::sqrt(Scalar(1.26) / (Scalar(0.5) * static_cast<Scalar>(faces)));
    detail::Clusters clusters = detail::clusters_in_cells(mesh, detail::grid_cells(places, width), is_boundary);
    constexpr int rounds = 2; // of slivers beside slivers
    for (int round = 0; round < rounds; ++round)
        if (!detail::absorb_slivers(clusters, mesh, places, width, is_boundary)) break;
    detail::dissolve_rings(clusters, mesh.faces);
    Triangles coarse = detail::faces_between(clusters, mesh.faces);
    while (detail::dissolve(clusters, detail::singular_vertices(coarse, is_boundary)))
        coarse = detail::faces_between(clusters, mesh.faces);

    const std::vector<int> middle = detail::middle_vertices(clusters, places, width);
    std::vector<int> index(n, -1);
    for (std::size_t v = 0; v < n; ++v)
        if (clusters[v] == static_cast<int>(v)) {
            index[v] = static_cast<int>(out.source.size());
            out.source.push_back(middle[v]);
        }
    out.cluster.resize(n);
    for (std::size_t v = 0; v < n; ++v) out.cluster[v] = index[static_cast<std::size_t>(clusters[v])];
    out.mesh.vertices.resize(static_cast<Eigen::Index>(out.source.size()), 3);
    for (std::size_t v = 0; v < out.source.size(); ++v)
        out.mesh.vertices.row(static_cast<Eigen::Index>(v)) = mesh.vertices.row(out.source[v]);
    out.mesh.faces = std::move(coarse);
    for (Eigen::Index i = 0; i < out.mesh.faces.size(); ++i)
        out.mesh.faces.data()[i] = index[static_cast<std::size_t>(out.mesh.faces.data()[i])];
    return out;
}

} // namespace skelgen::surface
