#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

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

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/half_edges.hpp>
#endif
