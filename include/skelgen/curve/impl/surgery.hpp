#pragma once

#include <skelgen/curve/surgery.hpp>

#include <algorithm>
#include <array>
#include <queue>
#include <utility>
#include <vector>

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

/// The contracted mesh as a complex of vertices, edges and faces that shrinks to a graph.
template <typename Scalar>
class Complex {
public:
    Complex(const Points<Scalar>& points, const Triangles& faces, const SurgeryOptions& options)
        : points_(points), shape_weight_(static_cast<Scalar>(options.shape_weight)),
          sampling_weight_(static_cast<Scalar>(options.sampling_weight)), neighbours_(count(points)),
          faces_of_(count(points)), quadrics_(count(points), Quadric<Scalar>::Zero()), regions_(count(points)),
          reach_(count(points), 0), version_(count(points), 0), alive_(count(points), true), faces_left_(faces.rows()) {
        faces_.reserve(static_cast<std::size_t>(faces.rows()));
        for (Eigen::Index f = 0; f < faces.rows(); ++f) {
            faces_.push_back({faces(f, 0), faces(f, 1), faces(f, 2)});
            for (const int v : faces_.back()) {
                faces_of_[at(v)].push_back(static_cast<int>(f));
                for (const int w : faces_.back())
                    if (w != v) insert_sorted(neighbours_[at(v)], w);
            }
        }
        for (std::size_t v = 0; v < neighbours_.size(); ++v) {
            regions_[v].push_back(static_cast<int>(v));
            for (const int w : neighbours_[v])
                quadrics_[v] += line_quadric<Scalar>(point(static_cast<int>(v)), point(w));
        }
        for (std::size_t v = 0; v < neighbours_.size(); ++v) measure_reach(static_cast<int>(v));
        for (std::size_t v = 0; v < neighbours_.size(); ++v) push_edges_of(static_cast<int>(v));
    }

    void collapse_all_faces() {
        while (faces_left_ > 0 && !queue_.empty()) {
            const Candidate next = queue_.top();
            queue_.pop();
            if (is_current(next) && shares_a_face(next.from, next.to)) collapse(next.from, next.to);
        }
    }

    [[nodiscard]] CurveSkeleton<Scalar> graph() const {
        CurveSkeleton<Scalar> out;
        std::vector<int> index(alive_.size(), -1);
        for (std::size_t v = 0; v < alive_.size(); ++v)
            if (alive_[v]) {
                index[v] = static_cast<int>(out.regions.size());
                out.regions.push_back(regions_[v]);
                std::sort(out.regions.back().begin(), out.regions.back().end());
            }
        out.nodes.resize(static_cast<Eigen::Index>(out.regions.size()), 3);
        for (std::size_t v = 0; v < alive_.size(); ++v) {
            if (!alive_[v]) continue;
            out.nodes.row(index[v]) = points_.row(static_cast<Eigen::Index>(v));
            for (const int w : neighbours_[v])
                if (at(w) > v) out.edges.push_back({index[v], index[at(w)]});
        }
        return out;
    }

private:
    struct Candidate {
        Scalar cost;
        int from, to, from_version, to_version;
        bool operator<(const Candidate& other) const { // cheapest on top; ties by index, for reproducible results
            if (cost != other.cost) return cost > other.cost;
            return from != other.from ? from > other.from : to > other.to;
        }
    };

    static std::size_t at(int v) { return static_cast<std::size_t>(v); }
    static std::size_t count(const Points<Scalar>& points) { return static_cast<std::size_t>(points.rows()); }
    [[nodiscard]] Vector3<Scalar> point(int v) const { return points_.row(v); }

    static void insert_sorted(std::vector<int>& list, int value) {
        const auto place = std::lower_bound(list.begin(), list.end(), value);
        if (place == list.end() || *place != value) list.insert(place, value);
    }
    static void erase_sorted(std::vector<int>& list, int value) {
        const auto place = std::lower_bound(list.begin(), list.end(), value);
        if (place != list.end() && *place == value) list.erase(place);
    }

    [[nodiscard]] Scalar cost(int from, int to) const {
        const Scalar shape = squared_distance<Scalar>(quadrics_[at(from)], point(to)) +
                             squared_distance<Scalar>(quadrics_[at(to)], point(to));
        return shape_weight_ * shape + sampling_weight_ * (point(from) - point(to)).norm() * reach_[at(from)];
    }

    /// After its neighbours have changed.
    void measure_reach(int v) {
        Scalar sum = 0;
        for (const int k : neighbours_[at(v)]) sum += (point(v) - point(k)).norm();
        reach_[at(v)] = sum;
    }

    void push_edges_of(int v) {
        for (const int w : neighbours_[at(v)]) queue_.push({cost(v, w), v, w, version_[at(v)], version_[at(w)]});
    }

    [[nodiscard]] bool is_current(const Candidate& c) const {
        return alive_[at(c.from)] && alive_[at(c.to)] && version_[at(c.from)] == c.from_version &&
               version_[at(c.to)] == c.to_version;
    }

    [[nodiscard]] bool shares_a_face(int a, int b) const {
        return std::any_of(faces_of_[at(a)].begin(), faces_of_[at(a)].end(), [&](int f) {
            const std::array<int, 3>& face = faces_[at(f)];
            return std::find(face.begin(), face.end(), b) != face.end();
        });
    }

    void remove_face(int f) {
        for (const int v : faces_[at(f)]) std::erase(faces_of_[at(v)], f);
        --faces_left_;
    }

    void move_faces(int from, int to) {
        const std::vector<int> touched = faces_of_[at(from)];
        for (const int f : touched) {
            std::array<int, 3>& face = faces_[at(f)];
            if (std::find(face.begin(), face.end(), to) != face.end()) {
                remove_face(f);
                continue;
            }
            std::replace(face.begin(), face.end(), from, to);
            std::array<int, 3> key = face;
            std::sort(key.begin(), key.end());
            const bool doubled = std::any_of(faces_of_[at(to)].begin(), faces_of_[at(to)].end(), [&](int g) {
                std::array<int, 3> other = faces_[at(g)];
                std::sort(other.begin(), other.end());
                return other == key;
            });
            if (doubled) {
                std::replace(face.begin(), face.end(), to, from);
                remove_face(f);
                continue;
            }
            faces_of_[at(to)].push_back(f);
        }
        faces_of_[at(from)].clear();
    }

    void collapse(int from, int to) {
        move_faces(from, to);
        for (const int w : neighbours_[at(from)]) {
            erase_sorted(neighbours_[at(w)], from);
            if (w == to) continue;
            insert_sorted(neighbours_[at(w)], to);
            insert_sorted(neighbours_[at(to)], w);
            measure_reach(w);
        }
        measure_reach(to);
        neighbours_[at(from)].clear();
        quadrics_[at(to)] += quadrics_[at(from)];
        regions_[at(to)].insert(regions_[at(to)].end(), regions_[at(from)].begin(), regions_[at(from)].end());
        regions_[at(from)].clear();
        alive_[at(from)] = false;

        ++version_[at(to)];
        push_edges_of(to);
        for (const int w : neighbours_[at(to)]) queue_.push({cost(w, to), w, to, version_[at(w)], version_[at(to)]});
    }

    const Points<Scalar>& points_;
    Scalar shape_weight_, sampling_weight_;
    std::vector<std::array<int, 3>> faces_;
    std::vector<std::vector<int>> neighbours_; ///< sorted
    std::vector<std::vector<int>> faces_of_;
    std::vector<Quadric<Scalar>> quadrics_;
    std::vector<std::vector<int>> regions_;
    std::vector<Scalar> reach_; ///< sum of the lengths of a vertex's edges
    std::vector<int> version_;
    std::vector<bool> alive_;
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
