#pragma once

#include <skelgen/curve/surgery.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::curve {
namespace detail {

template <typename Scalar>
using Quadric = Eigen::Matrix<Scalar, 4, 4>;

/// Quadric of squared distances to the line through `a` and `b`: K^T K with K = [ [d]_x | -(d x a) ].
template <typename Scalar>
Quadric<Scalar> line_quadric(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
    Vector3<Scalar> d = b - a;
    const Scalar length = d.norm();
    if (length > 0) d /= length;
    const Vector3<Scalar> moment = a.cross(d);
    const Scalar k[3][4] = {{0, -d[2], d[1], moment[0]}, {d[2], 0, -d[0], moment[1]}, {-d[1], d[0], 0, moment[2]}};
    Quadric<Scalar> quadric;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) quadric(i, j) = k[0][i] * k[0][j] + k[1][i] * k[1][j] + k[2][i] * k[2][j];
    return quadric;
}

template <typename Scalar>
Scalar squared_distance(const Quadric<Scalar>& quadric, const Vector3<Scalar>& p) {
    const Scalar point[4] = {p[0], p[1], p[2], 1};
    Scalar sum = 0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) sum += point[i] * quadric(i, j) * point[j];
    return sum;
}

/// The contracted mesh as a complex of vertices, edges and faces that shrinks to a graph. Each vertex knows the
/// cheapest of the collapses that take it along one of its edges, and all vertices queue with theirs.
template <typename Scalar>
class Complex {
public:
    Complex(const Points<Scalar>& points, const Triangles& faces, const SurgeryOptions& options)
        : points_(points), shape_weight_(static_cast<Scalar>(options.shape_weight)),
          sampling_weight_(static_cast<Scalar>(options.sampling_weight)), vertices_(count(points)),
          faces_left_(faces.rows()) {
        constexpr std::size_t usual = 8; // edges and faces of a vertex of a regular mesh, and a few more
        for (Vertex& vertex : vertices_) {
            vertex.edges.reserve(usual);
            vertex.faces.reserve(usual);
        }
        faces_.reserve(static_cast<std::size_t>(faces.rows()));
        for (Eigen::Index f = 0; f < faces.rows(); ++f) {
            faces_.push_back({faces(f, 0), faces(f, 1), faces(f, 2)});
            for (const int v : faces_.back()) {
                at(v).faces.push_back(static_cast<int>(f));
                for (const int w : faces_.back())
                    if (w != v) link(v, w);
            }
        }
        const auto n = static_cast<int>(vertices_.size());
        for (int v = 0; v < n; ++v) {
            for (const Edge& edge : at(v).edges) at(v).quadric += line_quadric<Scalar>(point(v), point(edge.to));
            at(v).own_error = squared_distance<Scalar>(at(v).quadric, point(v));
            measure_reach(v);
        }
        for (int v = 0; v < n; ++v) {
            for (Edge& edge : at(v).edges) edge.cost = cost(v, edge);
            find_cheapest(v);
        }
    }

    void collapse_all_faces() {
        while (faces_left_ > 0 && !queue_.empty()) {
            const Candidate next = queue_.top();
            queue_.pop();
            Vertex& vertex = at(next.vertex);
            if (vertex.is_gone() || vertex.queued != next.cost) continue;
            vertex.queued = forbidden;
            Edge& edge = vertex.edges[static_cast<std::size_t>(vertex.cheapest)];
            if (shares_a_face(next.vertex, edge.to)) {
                collapse(next.vertex, edge.to);
            } else { // part of the graph, until its ends change
                edge.cost = forbidden;
                find_cheapest(next.vertex);
            }
        }
    }

    [[nodiscard]] CurveSkeleton<Scalar> graph() const {
        CurveSkeleton<Scalar> out;
        std::vector<int> index(vertices_.size(), -1);
        int count = 0;
        for (std::size_t v = 0; v < vertices_.size(); ++v)
            if (!vertices_[v].is_gone()) index[v] = count++;
        out.nodes.resize(count, 3);
        out.regions.resize(static_cast<std::size_t>(count));
        for (std::size_t v = 0; v < vertices_.size(); ++v) {
            auto stays = static_cast<int>(v);
            while (at(stays).is_gone()) stays = at(stays).heir;
            const int node = index[static_cast<std::size_t>(stays)];
            out.regions[static_cast<std::size_t>(node)].push_back(static_cast<int>(v));
            if (vertices_[v].is_gone()) continue;
            out.nodes.row(node) = points_.row(static_cast<Eigen::Index>(v));
            for (const Edge& edge : vertices_[v].edges)
                if (edge.to > stays) out.edges.push_back({node, index[static_cast<std::size_t>(edge.to)]});
        }
        return out;
    }

private:
    static constexpr Scalar forbidden = std::numeric_limits<Scalar>::infinity();

    struct Edge {
        int to;
        Scalar length;
        Scalar cost; ///< of the collapse to there
    };
    struct Vertex {
        std::vector<Edge> edges; ///< in ascending order of their ends
        std::vector<int> faces;
        Quadric<Scalar> quadric = Quadric<Scalar>::Zero();
        Scalar own_error = 0;      ///< of its quadric at the vertex itself
        Scalar reach = 0;          ///< sum of its edges' lengths
        int cheapest = -1;         ///< of its edges, the first of equals; -1 where none may collapse
        Scalar queued = forbidden; ///< cost with which it waits in the queue
        int heir = -1;             ///< the vertex that it has collapsed to

        [[nodiscard]] bool is_gone() const { return heir >= 0; }
    };
    struct Candidate {
        Scalar cost;
        int vertex;
        bool operator<(const Candidate& other) const { // cheapest on top; ties by index, for reproducible results
            return cost != other.cost ? cost > other.cost : vertex > other.vertex;
        }
    };

    Vertex& at(int v) { return vertices_[static_cast<std::size_t>(v)]; }
    const Vertex& at(int v) const { return vertices_[static_cast<std::size_t>(v)]; }
    static std::size_t count(const Points<Scalar>& points) { return static_cast<std::size_t>(points.rows()); }
    [[nodiscard]] Vector3<Scalar> point(int v) const { return core::point(points_, v); }

    /// The edge from v to w or, where there is none, the one before which it belongs.
    typename std::vector<Edge>::iterator place_of(int v, int w) {
        std::vector<Edge>& edges = at(v).edges;
        return std::find_if(edges.begin(), edges.end(), [&](const Edge& edge) { return edge.to >= w; });
    }
    void link(int v, int w) {
        const auto place = place_of(v, w);
        if (place != at(v).edges.end() && place->to == w) return;
        at(v).edges.insert(place, {w, (point(v) - point(w)).norm(), forbidden});
    }
    void unlink(int v, int w) {
        const auto place = place_of(v, w);
        if (place != at(v).edges.end() && place->to == w) at(v).edges.erase(place);
    }

    [[nodiscard]] Scalar cost(int from, const Edge& edge) const {
        const Scalar shape = squared_distance<Scalar>(at(from).quadric, point(edge.to)) + at(edge.to).own_error;
        return shape_weight_ * shape + sampling_weight_ * edge.length * at(from).reach;
    }

    /// After its edges have changed.
    void measure_reach(int v) {
        Scalar sum = 0;
        for (const Edge& edge : at(v).edges) sum += edge.length;
        at(v).reach = sum;
    }

    /// After the costs of its edges have changed.
    void find_cheapest(int v) {
        Vertex& vertex = at(v);
        vertex.cheapest = -1;
        Scalar least = forbidden;
        for (std::size_t i = 0; i < vertex.edges.size(); ++i) {
            if (!(vertex.edges[i].cost < least)) continue;
            least = vertex.edges[i].cost;
            vertex.cheapest = static_cast<int>(i);
        }
        if (least != vertex.queued && vertex.cheapest >= 0) queue_.push({least, v});
        vertex.queued = least;
    }

    [[nodiscard]] bool has_corner(int face, int v) const {
        const std::array<int, 3>& corners = faces_[static_cast<std::size_t>(face)];
        return corners[0] == v || corners[1] == v || corners[2] == v;
    }

    [[nodiscard]] bool shares_a_face(int a, int b) const {
        return std::any_of(at(a).faces.begin(), at(a).faces.end(), [&](int f) { return has_corner(f, b); });
    }

    void remove_face(int f) {
        for (const int v : faces_[static_cast<std::size_t>(f)]) std::erase(at(v).faces, f);
        --faces_left_;
    }

    /// Those with both vertices vanish, as do those that another face then covers.
    void move_faces(int from, int to) {
        const std::vector<int> touched = at(from).faces;
        for (const int f : touched) {
            std::array<int, 3>& face = faces_[static_cast<std::size_t>(f)];
            const bool is_covered =
                has_corner(f, to) || std::any_of(at(to).faces.begin(), at(to).faces.end(), [&](int g) {
                    return std::all_of(face.begin(), face.end(), [&](int v) { return v == from || has_corner(g, v); });
                });
            if (is_covered) {
                remove_face(f);
                continue;
            }
            std::replace(face.begin(), face.end(), from, to);
            at(to).faces.push_back(f);
        }
        at(from).faces.clear();
    }

    void collapse(int from, int to) {
        move_faces(from, to);
        for (const Edge& edge : at(from).edges) {
            unlink(edge.to, from);
            if (edge.to == to) continue;
            link(edge.to, to);
            link(to, edge.to);
            measure_reach(edge.to);
        }
        measure_reach(to);
        at(from).edges.clear();
        at(from).heir = to;
        at(to).quadric += at(from).quadric;
        at(to).own_error = squared_distance<Scalar>(at(to).quadric, point(to));
        for (Edge& edge : at(to).edges) {
            edge.cost = cost(to, edge);
            const auto back = place_of(edge.to, to);
            back->cost = cost(edge.to, *back);
            find_cheapest(edge.to);
        }
        find_cheapest(to);
    }

    const Points<Scalar>& points_;
    Scalar shape_weight_, sampling_weight_;
    std::vector<std::array<int, 3>> faces_;
    std::vector<Vertex> vertices_;
    Eigen::Index faces_left_;
    std::priority_queue<Candidate> queue_;
};

} // namespace detail

SKELGEN_INLINE void validate(const SurgeryOptions& options) {
    core::require_in_range("surgery.shape_weight", options.shape_weight, 0.0, 1e6);
    core::require_in_range("surgery.sampling_weight", options.sampling_weight, 0.0, 1e6);
}

template <typename Scalar>
CurveSkeleton<Scalar> connectivity_surgery(const Points<Scalar>& contracted, const Triangles& faces,
                                           const SurgeryOptions& options) {
    validate(options);
    // Double whatever the mesh: a quadric sums squared distances to many lines in coordinates far larger than those
    // distances, and in float, what rounding leaves of them would decide the order of collapses.
    using core::Accumulator;
    const Points<Accumulator> points = contracted.template cast<Accumulator>();
    detail::Complex<Accumulator> complex(points, faces, options);
    complex.collapse_all_faces();
    CurveSkeleton<Accumulator> graph = complex.graph();
    return {graph.nodes.template cast<Scalar>(), std::move(graph.edges), std::move(graph.regions), {}};
}

} // namespace skelgen::curve
