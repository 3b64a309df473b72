#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::curve {

/// A manifold surface that is being remeshed: its half-edges in one list, of which 2 e and 2 e + 1 are the two sides of
/// edge e. What an operation deletes keeps its place until `remove_deleted`. Vertices, edges, half-edges and faces are
/// plain indices, -1 for none.
class HalfEdges {
public:
    using Place = Vector3<core::Accumulator>;

    /// Vertices and faces keep their numbers. O(n + m) where vertices have few edges.
    /// \throws Error bad_input where the surface is not manifold.
    HalfEdges(const Points<core::Accumulator>& vertices, const Triangles& faces);

    [[nodiscard]] int vertices() const { return static_cast<int>(places_.size()); }
    [[nodiscard]] int edges() const { return static_cast<int>(sides_.size() / 2); }
    [[nodiscard]] int faces() const { return static_cast<int>(side_of_face_.size()); }

    [[nodiscard]] const Place& place(int vertex) const { return places_[at(vertex)]; }
    void move(int vertex, const Place& place) { places_[at(vertex)] = place; }
    /// The original vertex that a vertex stems from, -1 for those made by a split.
    [[nodiscard]] int source(int vertex) const { return sources_[at(vertex)]; }
    void set_source(int vertex, int source) { sources_[at(vertex)] = source; }

    [[nodiscard]] int to(int side) const { return sides_[at(side)].to; }
    [[nodiscard]] int from(int side) const { return sides_[at(other(side))].to; }
    [[nodiscard]] int next(int side) const { return sides_[at(side)].next; }
    [[nodiscard]] static int other(int side) { return side ^ 1; }
    /// The next half-edge from the same vertex, clockwise.
    [[nodiscard]] int turned(int side) const { return next(other(side)); }
    /// A half-edge from a vertex, that on the boundary where it lies there; -1 where it has no edge.
    [[nodiscard]] int first(int vertex) const { return first_[at(vertex)]; }
    [[nodiscard]] int side_of_face(int face) const { return side_of_face_[at(face)]; }

    [[nodiscard]] bool is_boundary(int side) const { return sides_[at(side)].face < 0; }
    [[nodiscard]] bool is_boundary_vertex(int vertex) const { return first(vertex) < 0 || is_boundary(first(vertex)); }
    [[nodiscard]] bool is_boundary_edge(int edge) const { return is_boundary(2 * edge) || is_boundary(2 * edge + 1); }
    [[nodiscard]] bool is_deleted(int edge) const { return deleted_edges_[at(edge)]; }

    [[nodiscard]] core::Accumulator squared_length(int edge) const {
        return (place(to(2 * edge)) - place(to(2 * edge + 1))).squaredNorm();
    }

    /// Calls `visit` with each half-edge from a vertex, clockwise, until it returns true. Whether it did.
    template <typename Visit>
    bool any_around(int vertex, Visit&& visit) const {
        const int start = first(vertex);
        if (start < 0) return false;
        int side = start;
        do {
            if (visit(side)) return true;
            side = turned(side);
        } while (side != start);
        return false;
    }

    /// Does the surface stay manifold when a half-edge's first vertex goes to its second one? (HDDMS93 section 4)
    [[nodiscard]] bool may_collapse(int side);
    void collapse(int side);

    /// Divides an edge, and the faces there, by a new vertex.
    void split(int edge, const Place& place);

    /// Does a flipped edge join two vertices that have none between them, inside the surface?
    [[nodiscard]] bool may_flip(int edge) const;
    void flip(int edge);

    /// The last ones take the places of those that are deleted.
    void remove_deleted();

    [[nodiscard]] Triangles triangles() const;

private:
    struct Side {
        int to, next, previous, face;
    };

    static std::size_t at(int index) { return static_cast<std::size_t>(index); }
    Side& side(int index) { return sides_[at(index)]; }
    void link(int before, int after) {
        side(before).next = after;
        side(after).previous = before;
    }
    int add_edge(int from, int to);
    int add_face();
    void begin_at_boundary(int vertex);
    void remove_loop(int side);
    void require_single_fans(const std::vector<int>& corners) const;

    std::vector<Place> places_;
    std::vector<int> sources_, first_, side_of_face_;
    std::vector<Side> sides_;
    std::vector<bool> deleted_vertices_, deleted_edges_, deleted_faces_;
    std::vector<int> mark_; ///< per vertex the last question that it was a neighbour in
    int question_ = 0;
    bool is_closed_ = true;
};

namespace detail {

[[noreturn]] inline void throw_not_manifold() {
    throw Error(ErrorCode::bad_input, "the surface is not manifold; cut it into manifold parts first");
}

/// Of each corner the one at which the same edge starts on its other side, -1 at the boundary.
inline std::vector<int> opposite_corners(const Triangles& faces) {
    const std::vector<core::DirectedEdge> edges = core::directed_edges(faces);
    std::vector<int> opposite(edges.size(), -1);
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        while (end < edges.size() && edges[end].joins_same(edges[i])) ++end;
        if (edges[i].low == edges[i].high || end - i > 2) throw_not_manifold();
        if (end - i == 2) {
            if (edges[i].forward == edges[i + 1].forward) throw_not_manifold();
            opposite[edges[i].corner] = static_cast<int>(edges[i + 1].corner);
            opposite[edges[i + 1].corner] = static_cast<int>(edges[i].corner);
        }
        i = end;
    }
    return opposite;
}

/// For the entries that stay when those marked are taken out and the last ones put in their places: where they go.
inline std::vector<int> compressed(const std::vector<bool>& deleted) {
    std::vector<int> place(deleted.size(), -1);
    std::size_t last = deleted.size();
    for (std::size_t i = 0; i < last; ++i) {
        std::size_t stays = i;
        if (deleted[i]) {
            do --last;
            while (last > i && deleted[last]);
            if (last == i) break;
            stays = last;
        }
        place[stays] = static_cast<int>(i);
    }
    return place;
}

/// The entries of a list at their new places.
template <typename Entry>
std::vector<Entry> rearranged(const std::vector<Entry>& list, const std::vector<int>& place, std::size_t count) {
    std::vector<Entry> out(count);
    for (std::size_t i = 0; i < list.size(); ++i)
        if (place[i] >= 0) out[static_cast<std::size_t>(place[i])] = list[i];
    return out;
}

} // namespace detail

inline HalfEdges::HalfEdges(const Points<core::Accumulator>& vertices, const Triangles& faces)
    : first_(static_cast<std::size_t>(vertices.rows()), -1), mark_(first_.size(), 0) {
    const std::vector<int> opposite = detail::opposite_corners(faces);
    places_.reserve(first_.size());
    sources_.reserve(first_.size());
    for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
        places_.push_back(core::point(vertices, v));
        sources_.push_back(static_cast<int>(v));
    }
    const auto vertex = [&](int corner) { return faces.data()[corner]; };
    const auto next_corner = [](int corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
    std::vector<int> side_at(opposite.size()), corners(first_.size(), 0);
    sides_.reserve(opposite.size() + opposite.size() / 8);
    deleted_edges_.reserve(sides_.capacity() / 2);
    for (int corner = 0; corner < static_cast<int>(opposite.size()); ++corner) {
        const int beyond = opposite[at(corner)];
        side_at[at(corner)] = beyond >= 0 && beyond < corner ? other(side_at[at(beyond)])
                                                             : add_edge(vertex(corner), vertex(next_corner(corner)));
        ++corners[at(vertex(corner))];
    }
    side_of_face_.resize(static_cast<std::size_t>(faces.rows()));
    for (int corner = 0; corner < static_cast<int>(opposite.size()); ++corner) {
        const int here = side_at[at(corner)];
        side(here).face = corner / 3;
        side_of_face_[at(corner / 3)] = here; // in the end, that from its last corner
        first_[at(vertex(corner))] = here;
        link(here, side_at[at(next_corner(corner))]);
    }
    std::vector<int> boundary(first_.size(), -1);
    for (int s = 0; s < static_cast<int>(sides_.size()); ++s) {
        if (!is_boundary(s)) continue;
        is_closed_ = false;
        if (boundary[at(from(s))] >= 0) detail::throw_not_manifold();
        boundary[at(from(s))] = first_[at(from(s))] = s;
    }
    for (int s = 0; s < static_cast<int>(sides_.size()); ++s)
        if (is_boundary(s)) link(s, boundary[at(to(s))]);
    deleted_vertices_.resize(places_.size(), false);
    deleted_faces_.resize(side_of_face_.size(), false);
    require_single_fans(corners);
}

/// \param corners how many faces have each vertex: all must be met going once around it.
inline void HalfEdges::require_single_fans(const std::vector<int>& corners) const {
    for (int v = 0; v < vertices(); ++v) {
        int met = 0;
        any_around(v, [&](int s) {
            met += !is_boundary(s);
            return false;
        });
        if (met != corners[at(v)]) detail::throw_not_manifold();
    }
}

inline int HalfEdges::add_edge(int from, int to) {
    const int out = static_cast<int>(sides_.size());
    sides_.push_back({to, -1, -1, -1});
    sides_.push_back({from, -1, -1, -1});
    deleted_edges_.push_back(false);
    return out;
}

inline int HalfEdges::add_face() {
    side_of_face_.push_back(-1);
    deleted_faces_.push_back(false);
    return faces() - 1;
}

inline void HalfEdges::begin_at_boundary(int vertex) {
    if (is_closed_) return; // and stays so
    any_around(vertex, [&](int s) {
        if (!is_boundary(s)) return false;
        first_[at(vertex)] = s;
        return true;
    });
}

inline bool HalfEdges::may_collapse(int s) {
    const int back = other(s), a = from(s), b = to(s);
    const auto apex = [&](int here) { // opposite, -1 at the boundary; -2 where that corner hangs by it alone
        if (is_boundary(here)) return -1;
        const int second = next(here), third = next(second);
        return is_boundary(other(second)) && is_boundary(other(third)) ? -2 : to(second);
    };
    const int left = apex(s), right = apex(back);
    if (left == -2 || right == -2 || left == right) return false;
    ++question_;
    any_around(b, [&](int around) {
        mark_[at(to(around))] = question_;
        return false;
    });
    if (any_around(a, [&](int around) {
            const int v = to(around);
            return mark_[at(v)] == question_ && v != left && v != right;
        }))
        return false;
    return !is_boundary_vertex(a) || !is_boundary_vertex(b) || is_boundary(s) || is_boundary(back);
}

inline void HalfEdges::collapse(int s) {
    const int back = other(s), after = next(s), before = side(s).previous;
    const int back_after = next(back), back_before = side(back).previous;
    const int face = side(s).face, back_face = side(back).face, kept = to(s), gone = to(back);
    any_around(gone, [&](int out) {
        side(other(out)).to = kept;
        return false;
    });
    link(before, after);
    link(back_before, back_after);
    if (face >= 0) side_of_face_[at(face)] = after;
    if (back_face >= 0) side_of_face_[at(back_face)] = back_after;
    if (first(kept) == back) first_[at(kept)] = after;
    begin_at_boundary(kept);
    first_[at(gone)] = -1;
    deleted_edges_[at(s / 2)] = true;
    deleted_vertices_[at(gone)] = true;
    if (next(next(after)) == after) remove_loop(next(after));
    if (next(next(back_after)) == back_after) remove_loop(back_after);
}

/// Makes one edge of the two of a face that has no more.
inline void HalfEdges::remove_loop(int s) {
    const int kept = next(s), beyond = other(s);
    const int face = side(s).face, face_beyond = side(beyond).face;
    const int a = to(s), b = to(kept);
    link(kept, next(beyond));
    link(side(beyond).previous, kept);
    side(kept).face = face_beyond;
    first_[at(a)] = kept;
    begin_at_boundary(a);
    first_[at(b)] = other(kept);
    begin_at_boundary(b);
    if (face_beyond >= 0 && side_of_face_[at(face_beyond)] == beyond) side_of_face_[at(face_beyond)] = kept;
    if (face >= 0) deleted_faces_[at(face)] = true;
    deleted_edges_[at(s / 2)] = true;
}

inline void HalfEdges::split(int edge, const Place& place) {
    const int v = vertices();
    places_.push_back(place);
    sources_.push_back(-1);
    first_.push_back(-1);
    mark_.push_back(0);
    deleted_vertices_.push_back(false);

    const int s = 2 * edge, back = 2 * edge + 1, start = to(back);
    const int half = add_edge(v, start), half_back = other(half);
    const int face = side(s).face, back_face = side(back).face;
    first_[at(v)] = s;
    side(back).to = v;
    if (face >= 0) {
        const int second = next(s), third = next(second), spoke = add_edge(v, to(second)), spoke_back = other(spoke);
        const int added = add_face();
        side_of_face_[at(face)] = s;
        side_of_face_[at(added)] = third;
        side(spoke_back).face = face;
        side(third).face = side(half_back).face = side(spoke).face = added;
        link(second, spoke_back);
        link(spoke_back, s);
        link(spoke, third);
        link(third, half_back);
        link(half_back, spoke);
    } else {
        link(side(s).previous, half_back);
        link(half_back, s);
    }
    if (back_face >= 0) {
        const int second = next(back), third = next(second), spoke = add_edge(v, to(second)), spoke_back = other(spoke);
        const int added = add_face();
        side_of_face_[at(added)] = second;
        side_of_face_[at(back_face)] = back;
        side(second).face = side(spoke_back).face = side(half).face = added;
        side(spoke).face = back_face;
        link(half, second);
        link(second, spoke_back);
        link(spoke_back, half);
        link(back, spoke);
        link(spoke, third);
        link(third, back);
    } else {
        link(half, next(back));
        link(back, half);
        first_[at(v)] = half;
    }
    if (first(start) == s) first_[at(start)] = half_back;
}

inline bool HalfEdges::may_flip(int edge) const {
    if (is_boundary_edge(edge)) return false;
    const int a = to(next(2 * edge)), b = to(next(2 * edge + 1));
    return a != b && !any_around(a, [&](int s) { return to(s) == b; });
}

inline void HalfEdges::flip(int edge) {
    const int s = 2 * edge, back = 2 * edge + 1;
    const int second = next(s), third = next(second), back_second = next(back), back_third = next(back_second);
    const int end = to(s), start = to(back), face = side(s).face, back_face = side(back).face;
    side(s).to = to(second);
    side(back).to = to(back_second);
    link(s, third);
    link(third, back_second);
    link(back_second, s);
    link(back, back_third);
    link(back_third, second);
    link(second, back);
    side(second).face = back_face;
    side(back_second).face = face;
    side_of_face_[at(face)] = s;
    side_of_face_[at(back_face)] = back;
    if (first(end) == back) first_[at(end)] = second;
    if (first(start) == s) first_[at(start)] = back_second;
}

inline void HalfEdges::remove_deleted() {
    const std::vector<int> vertex = detail::compressed(deleted_vertices_), edge = detail::compressed(deleted_edges_),
                           face = detail::compressed(deleted_faces_);
    const auto count = [](const std::vector<bool>& deleted) {
        return static_cast<std::size_t>(std::count(deleted.begin(), deleted.end(), false));
    };
    const std::size_t n = count(deleted_vertices_), edges = count(deleted_edges_), m = count(deleted_faces_);
    const auto moved = [&](int s) { return s < 0 ? s : 2 * edge[at(s / 2)] + (s & 1); };
    std::vector<Side> sides(2 * edges);
    for (int s = 0; s < static_cast<int>(sides_.size()); ++s) {
        if (edge[at(s / 2)] < 0) continue;
        const Side& old = sides_[at(s)];
        sides[at(moved(s))] = {vertex[at(old.to)], moved(old.next), moved(old.previous),
                               old.face < 0 ? -1 : face[at(old.face)]};
    }
    sides_ = std::move(sides);
    places_ = detail::rearranged(places_, vertex, n);
    sources_ = detail::rearranged(sources_, vertex, n);
    first_ = detail::rearranged(first_, vertex, n);
    side_of_face_ = detail::rearranged(side_of_face_, face, m);
    for (int& s : first_) s = moved(s);
    for (int& s : side_of_face_) s = moved(s);
    mark_.assign(n, 0);
    question_ = 0;
    deleted_vertices_.assign(n, false);
    deleted_edges_.assign(edges, false);
    deleted_faces_.assign(m, false);
}

inline Triangles HalfEdges::triangles() const {
    Triangles out(static_cast<Eigen::Index>(side_of_face_.size()), 3);
    for (int f = 0; f < faces(); ++f) {
        int s = side_of_face(f);
        for (int k = 0; k < 3; ++k, s = next(s)) out(f, k) = to(s);
    }
    return out;
}

} // namespace skelgen::curve
