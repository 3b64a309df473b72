#pragma once

#include <skelgen/surface/vertex_clusters.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

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

/// Vertices that become one.
struct Clusters {
    std::vector<int> of_vertex;
    std::vector<int> lowest; ///< per cluster its lowest vertex; in ascending order

    [[nodiscard]] std::size_t count() const { return lowest.size(); }
    [[nodiscard]] std::size_t of(int vertex) const {
        return static_cast<std::size_t>(of_vertex[static_cast<std::size_t>(vertex)]);
    }
};

/// The clusters of vertices with the same label, below `labels`, in the order of their lowest vertices.
inline Clusters clusters_labelled(std::vector<int> label, std::size_t labels) {
    Clusters out;
    std::vector<int> number(labels, -1);
    for (std::size_t v = 0; v < label.size(); ++v) {
        int& cluster = number[static_cast<std::size_t>(label[v])];
        if (cluster < 0) {
            cluster = static_cast<int>(out.count());
            out.lowest.push_back(static_cast<int>(v));
        }
        label[v] = cluster;
    }
    out.of_vertex = std::move(label);
    return out;
}

/// Of each cluster, whether it has a vertex on the boundary, which is then its only one.
inline std::vector<bool> boundary_clusters(const Clusters& clusters, const std::vector<bool>& is_boundary) {
    std::vector<bool> out(clusters.count());
    for (std::size_t c = 0; c < out.size(); ++c) out[c] = is_boundary[static_cast<std::size_t>(clusters.lowest[c])];
    return out;
}

/// Clusters of a surface's vertices, and its edges from one to another, the lower vertex first; not all of those on the
/// boundary.
struct ClustersAndEdges {
    Clusters clusters;
    std::vector<std::array<int, 2>> edges;
};

/// Those of each cell that its edges join; those on the boundary stay alone.
inline ClustersAndEdges clusters_in_cells(const Triangles& faces, const std::vector<std::uint64_t>& cells,
                                          const std::vector<bool>& is_boundary) {
    ClustersAndEdges out;
    out.edges.reserve(static_cast<std::size_t>(faces.rows()));
    core::DisjointSets joined(cells.size());
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int low = faces(f, k), high = faces(f, (k + 1) % 3);
            if (low > high) continue; // its other side, or on the boundary
            const auto a = static_cast<std::size_t>(low), b = static_cast<std::size_t>(high);
            if (cells[a] == cells[b] && !is_boundary[a] && !is_boundary[b])
                joined.unite(a, b);
            else
                out.edges.push_back({low, high});
        }
    std::vector<int> label(cells.size());
    for (std::size_t v = 0; v < label.size(); ++v) label[v] = static_cast<int>(joined.find(v));
    out.clusters = clusters_labelled(std::move(label), cells.size());
    return out;
}

/// Where the vertices of each cluster are in the middle.
struct ClusterMiddles {
    std::vector<Vector3<core::Accumulator>> places;
    std::vector<int> count; ///< of vertices
};

template <typename Scalar>
ClusterMiddles middles_of(const Clusters& clusters, const Points<Scalar>& places) {
    ClusterMiddles out{{clusters.count(), Vector3<core::Accumulator>::Zero()}, std::vector<int>(clusters.count(), 0)};
    for (int v = 0; v < static_cast<int>(places.rows()); ++v) {
        const std::size_t cluster = clusters.of(v);
        for (int k = 0; k < 3; ++k) out.places[cluster][k] += places(v, k);
        ++out.count[cluster];
    }
    for (std::size_t c = 0; c < clusters.count(); ++c) out.places[c] /= out.count[c];
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

/// Clusters that have but three others or fewer around them, where a corner of a cell cuts the surface, as part of the
/// largest of those; none where there are no such ones. `edges` are those between clusters, and may be others besides.
template <typename Scalar>
std::optional<Clusters> without_slivers(const Clusters& clusters, const std::vector<std::array<int, 2>>& edges,
                                        const Points<Scalar>& places, Scalar width,
                                        const std::vector<bool>& is_boundary_vertex) {
    const ClusterMiddles middles = middles_of(clusters, places);
    const std::vector<bool> is_boundary = boundary_clusters(clusters, is_boundary_vertex);
    FewNeighbours around(clusters.count());
    std::vector<bool> is_close(clusters.count(), true); // all neighbours within the width of a cell
    for (const auto& [a, b] : edges) {
        const int one = clusters.of_vertex[static_cast<std::size_t>(a)],
                  other = clusters.of_vertex[static_cast<std::size_t>(b)];
        if (one == other || (!around.are_few(one) && !around.are_few(other))) continue;
        around.add(one, other);
        around.add(other, one);
        if ((core::point(places, a) - core::point(places, b)).squaredNorm() > width * width)
            is_close[static_cast<std::size_t>(one)] = is_close[static_cast<std::size_t>(other)] = false;
    }
    const auto is_sliver = [&](std::size_t c) {
        return !is_boundary[c] && is_close[c] && around.are_few(static_cast<int>(c));
    };
    const auto precedes = [&](std::size_t a, std::size_t b) {
        return middles.count[a] != middles.count[b] ? middles.count[a] > middles.count[b]
                                                    : askew_height(middles.places[a]) > askew_height(middles.places[b]);
    };
    std::vector<int> part_of(clusters.count());
    std::iota(part_of.begin(), part_of.end(), 0);
    bool any = false;
    for (std::size_t c = 0; c < clusters.count(); ++c) {
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
    if (!any) return std::nullopt;
    std::vector<int> label = clusters.of_vertex;
    for (int& cluster : label) cluster = part_of[static_cast<std::size_t>(cluster)];
    return clusters_labelled(std::move(label), clusters.count());
}

/// The vertices of marked clusters alone; none where they are so already.
inline std::optional<Clusters> dissolved(const Clusters& clusters, const std::vector<bool>& marked) {
    std::vector<int> label = clusters.of_vertex;
    auto labels = static_cast<int>(clusters.count());
    bool any = false;
    for (std::size_t v = 0; v < label.size(); ++v) {
        const auto cluster = static_cast<std::size_t>(label[v]);
        if (!marked[cluster] || clusters.lowest[cluster] == static_cast<int>(v)) continue;
        label[v] = labels++;
        any = true;
    }
    if (!any) return std::nullopt;
    return clusters_labelled(std::move(label), static_cast<std::size_t>(labels));
}

/// Marks what is no disc, as around a finger. A surface of which discs become points stays what it is (Moo25);
/// vertices, edges and faces of a disc, and of nothing else that hangs together on a surface, add up to one.
inline std::vector<bool> rings_of(const Clusters& clusters, const Triangles& faces) {
    std::vector<int> twice(clusters.count(), 0); // that sum: inner edges are met twice
    for (const int cluster : clusters.of_vertex) twice[static_cast<std::size_t>(cluster)] += 2;
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        const std::size_t a = clusters.of(faces(f, 0)), b = clusters.of(faces(f, 1)), c = clusters.of(faces(f, 2));
        if (a == b) --twice[a];
        if (b == c) --twice[b];
        if (c == a) --twice[c];
        if (a == b && b == c) twice[a] += 2;
    }
    std::vector<bool> out(clusters.count());
    for (std::size_t c = 0; c < out.size(); ++c) out[c] = twice[c] != 2;
    return out;
}

/// The faces whose corners are in three clusters, on those.
inline Triangles faces_between(const Clusters& clusters, const Triangles& faces) {
    std::vector<std::array<int, 3>> kept;
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        std::array<int, 3> face{};
        for (std::size_t k = 0; k < 3; ++k)
            face[k] = clusters.of_vertex[static_cast<std::size_t>(faces(f, static_cast<Eigen::Index>(k)))];
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

/// Of each cluster the vertex nearest to its vertices' centre; of those as near, as of two, the highest.
template <typename Scalar>
std::vector<int> middle_vertices(const Clusters& clusters, const Points<Scalar>& places, Scalar width) {
    using core::Accumulator;
    const auto near = static_cast<Accumulator>(width) * 1e-4; // what is so much nearer is nearest
    const ClusterMiddles middles = middles_of(clusters, places);
    const auto place = [&](int v) { return Vector3<Accumulator>(core::point(places, v).template cast<Accumulator>()); };
    const auto off_middle = [&](int v) { return (middles.places[clusters.of(v)] - place(v)).norm(); };
    const auto n = static_cast<int>(places.rows());
    std::vector<Accumulator> least(clusters.count(), std::numeric_limits<Accumulator>::infinity());
    for (int v = 0; v < n; ++v) {
        Accumulator& nearest = least[clusters.of(v)];
        nearest = std::min(nearest, off_middle(v));
    }
    std::vector<int> out(clusters.count(), -1);
    for (int v = 0; v < n; ++v) {
        if (off_middle(v) > least[clusters.of(v)] + near) continue;
        int& chosen = out[clusters.of(v)];
        if (chosen < 0 || askew_height(place(v)) > askew_height(place(chosen))) chosen = v;
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
    auto [clusters, edges] = detail::clusters_in_cells(mesh.faces, detail::grid_cells(places, width), is_boundary);
    constexpr int rounds = 2; // of slivers beside slivers
    for (int round = 0; round < rounds; ++round) {
        auto fewer = detail::without_slivers(clusters, edges, places, width, is_boundary);
        if (!fewer) break;
        clusters = *std::move(fewer);
    }
    if (auto discs = detail::dissolved(clusters, detail::rings_of(clusters, mesh.faces))) clusters = *std::move(discs);
    out.mesh.faces = detail::faces_between(clusters, mesh.faces);
    while (auto manifold = detail::dissolved(
               clusters, detail::singular_vertices(out.mesh.faces, detail::boundary_clusters(clusters, is_boundary)))) {
        clusters = *std::move(manifold);
        out.mesh.faces = detail::faces_between(clusters, mesh.faces);
    }
    out.source = detail::middle_vertices(clusters, places, width);
    out.cluster = std::move(clusters.of_vertex);
    out.mesh.vertices.resize(static_cast<Eigen::Index>(out.source.size()), 3);
    for (std::size_t v = 0; v < out.source.size(); ++v)
        out.mesh.vertices.row(static_cast<Eigen::Index>(v)) = mesh.vertices.row(out.source[v]);
    return out;
}

} // namespace skelgen::surface
