#pragma once

#include <skelgen/curve/proxy.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/curve/impl/half_edges.hpp>

namespace skelgen::curve {
namespace detail {

using core::Accumulator;
using Place = HalfEdges::Place;

/// Inner product, summed in the order of the axes.
inline Accumulator inner(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Accumulator squared_norm(const Place& a) { return inner(a, a); }
inline Accumulator norm(const Place& a) { return std::sqrt(squared_norm(a)); }
inline Place cross(const Place& a, const Place& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <typename Scalar>
Proxy<Scalar> to_proxy(const HalfEdges& mesh) {
    Proxy<Scalar> out;
    out.mesh.vertices.resize(mesh.vertices(), 3);
    for (int v = 0; v < mesh.vertices(); ++v) {
        for (int k = 0; k < 3; ++k) out.mesh.vertices(v, k) = static_cast<Scalar>(mesh.place(v)[k]);
        out.source.push_back(mesh.source(v));
    }
    out.mesh.faces = mesh.triangles();
    return out;
}

/// From one threshold of a sequence of splits or collapses to the next; calibrated.
inline constexpr double threshold_ratio = 1.5;

/// `length` times the ratio to the power of `steps`.
inline Accumulator threshold(Accumulator length, int steps) { return length * std::pow(threshold_ratio, steps); }

/// Edges made by a split are left alone. \throws Error bad_input when there come to be more than `most` vertices.
inline void split_long_edges(HalfEdges& mesh, Accumulator longest, std::size_t most) {
    const int edges = mesh.edges();
    for (int e = 0; e < edges; ++e) {
        if (mesh.squared_length(e) <= longest * longest) continue;
        if (static_cast<std::size_t>(mesh.vertices()) >= most)
            throw Error(ErrorCode::bad_input, "a triangle is far longer than the rest of the surface: remove the stray "
                                              "vertex that it reaches to");
        mesh.split(e, 0.5 * (mesh.place(mesh.from(2 * e)) + mesh.place(mesh.to(2 * e))));
    }
}

/// Splits with a threshold that falls to `longest`, so that the longest edges go first: bisected there, a triangle's
/// halves are better shaped than itself.
inline void refine(HalfEdges& mesh, Accumulator longest, std::size_t most_vertices) {
    constexpr double most_steps = 40;
    Accumulator largest = 0;
    for (int e = 0; e < mesh.edges(); ++e) largest = std::max(largest, mesh.squared_length(e));
    largest = std::sqrt(largest);
    if (largest < longest) return;
    const double ratio = std::ceil(std::log(largest / longest) / std::log(threshold_ratio));
    for (int step = static_cast<int>(std::min(ratio, most_steps)); step >= 0; --step)
        split_long_edges(mesh, threshold(longest, step), most_vertices);
}

/// Twice a face's area below this part of its squared longest edge: the face is a segment.
inline constexpr Accumulator degenerate = 1e-6;

/// Would moving vertex `v` to `target` turn over one of its faces (other than those that vanish)?
inline bool flips_a_face(const HalfEdges& mesh, int v, int other, const Place& target) {
    constexpr Accumulator least_cosine = 0.2; // turned by more than 78 degrees; calibrated
    const Place& p = mesh.place(v);
    return mesh.any_around(v, [&](int side) {
        if (mesh.is_boundary(side)) return false;
        const int a = mesh.to(side), b = mesh.to(mesh.next(side));
        if (a == other || b == other) return false;
        const Place &pa = mesh.place(a), &pb = mesh.place(b);
        const Place before = cross(pa - p, pb - p), after = cross(pa - target, pb - target);
        // A face without area, as a split leaves behind, has a normal of rounding errors, or none at all where its
        // three vertices coincide: it must not decide anything.
        const Accumulator size = std::max({squared_norm(p - pa), squared_norm(pa - pb), squared_norm(pb - p)});
        const Accumulator area = squared_norm(before);
        if (area <= degenerate * degenerate * size * size) return false;
        return inner(before, after) <= least_cosine * std::sqrt(area) * norm(after);
    });
}

/// Would moving vertex `v` to `target` make one of its edges too long? One that is so already is to be split in any
/// case; if it forbade the collapse, the short edges across a fan of needles would outlast it.
inline bool makes_a_long_edge(const HalfEdges& mesh, int v, const Place& target, Accumulator longest) {
    const Accumulator bound = longest * longest;
    const Place& p = mesh.place(v);
    return mesh.any_around(v, [&](int side) {
        const Place& q = mesh.place(mesh.to(side));
        return squared_norm(q - target) > bound && squared_norm(q - p) <= bound;
    });
}

inline void collapse_short_edges(HalfEdges& mesh, Accumulator shortest, Accumulator longest) {
    for (int e = 0; e < mesh.edges(); ++e) {
        if (mesh.is_deleted(e) || mesh.squared_length(e) >= shortest * shortest) continue;
        const int side = mesh.is_boundary_vertex(mesh.from(2 * e)) ? 2 * e + 1 : 2 * e;
        const int from = mesh.from(side), to = mesh.to(side);
        const bool joins_boundary = mesh.is_boundary_vertex(to) && !mesh.is_boundary_vertex(from);
        const Place target = joins_boundary ? mesh.place(to) : Place(0.5 * (mesh.place(from) + mesh.place(to)));
        if (makes_a_long_edge(mesh, from, target, longest) || makes_a_long_edge(mesh, to, target, longest)) continue;
        if (!mesh.may_collapse(side)) continue; // which also keeps apart two vertices on the boundary of an inner edge
        if (flips_a_face(mesh, from, to, target) || flips_a_face(mesh, to, from, target)) continue;
        mesh.move(to, target);
        if (mesh.source(to) < 0) mesh.set_source(to, mesh.source(from));
        mesh.collapse(side);
    }
    mesh.remove_deleted();
}

/// Collapses with a threshold that rises to `shortest`, so that a fine input shrinks evenly.
inline void coarsen(HalfEdges& mesh, Accumulator shortest, Accumulator longest) {
    constexpr double most_steps = 20;
    Accumulator sum = 0;
    std::size_t count = 0;
    for (int e = 0; e < mesh.edges(); ++e) {
        const Accumulator squared = mesh.squared_length(e);
        if (squared >= shortest * shortest) continue;
        sum += std::sqrt(squared);
        ++count;
    }
    if (count == 0) return;
    // Counted down from `shortest`: a regular mesh has edges of exactly the mean length, which must not be a threshold.
    const double ratio = sum > 0 ? std::log(shortest * static_cast<double>(count) / sum) / std::log(threshold_ratio)
                                 : most_steps; // edges without any length
    for (int step = static_cast<int>(std::min(ratio, most_steps)); step >= 0; --step)
        collapse_short_edges(mesh, threshold(shortest, -step), longest);
}

/// Of each vertex the number of its edges above that of a regular mesh: six, four on the boundary.
inline std::vector<int> excess_valences(const HalfEdges& mesh) {
    std::vector<int> out(static_cast<std::size_t>(mesh.vertices()));
    for (std::size_t v = 0; v < out.size(); ++v) out[v] = mesh.is_boundary_vertex(static_cast<int>(v)) ? -4 : -6;
    for (int e = 0; e < mesh.edges(); ++e)
        for (const int side : {2 * e, 2 * e + 1}) ++out[static_cast<std::size_t>(mesh.to(side))];
    return out;
}

/// Do the two faces made by flipping an edge keep the orientation of those they replace?
inline bool flip_keeps_orientation(const HalfEdges& mesh, int edge) {
    const int side = 2 * edge, back = 2 * edge + 1;
    const Place &a = mesh.place(mesh.from(side)), &b = mesh.place(mesh.to(side));
    const Place &c = mesh.place(mesh.to(mesh.next(side))), &d = mesh.place(mesh.to(mesh.next(back)));
    const Place before = cross(b - a, c - a) + cross(d - a, b - a);
    const Place first = cross(d - a, c - a), second = cross(c - b, d - b);
    const Accumulator bar = 0.5 * norm(before); // turned by less than 60 degrees; calibrated
    // A new face without area would have a normal of rounding errors.
    const Accumulator least = degenerate * squared_norm(b - a);
    const Accumulator of_first = norm(first), of_second = norm(second);
    if (of_first < least || of_second < least) return false;
    return inner(first, before) > bar * of_first && inner(second, before) > bar * of_second;
}

inline void flip_towards_valence_six(HalfEdges& mesh) {
    std::vector<int> excess = excess_valences(mesh);
    const auto squared = [](int value) { return value * value; };
    const auto excess_of = [&](int v) -> int& { return excess[static_cast<std::size_t>(v)]; };
    for (int e = 0; e < mesh.edges(); ++e) {
        if (mesh.is_boundary_edge(e)) continue;
        const int side = 2 * e, back = 2 * e + 1;
        int &a = excess_of(mesh.from(side)), &b = excess_of(mesh.to(side));
        int &c = excess_of(mesh.to(mesh.next(side))), &d = excess_of(mesh.to(mesh.next(back)));
        const int now = squared(a) + squared(b) + squared(c) + squared(d);
        const int then = squared(a - 1) + squared(b - 1) + squared(c + 1) + squared(d + 1);
        if (then >= now || !mesh.may_flip(e) || !flip_keeps_orientation(mesh, e)) continue;
        mesh.flip(e);
        --a, --b, ++c, ++d;
    }
}

inline void relax_tangentially(HalfEdges& mesh) {
    std::vector<Place> moved(static_cast<std::size_t>(mesh.vertices()));
    for (int v = 0; v < mesh.vertices(); ++v) {
        const Place& p = mesh.place(v);
        moved[static_cast<std::size_t>(v)] = p;
        if (mesh.is_boundary_vertex(v)) continue;
        Place mean = Place::Zero(), normal = Place::Zero();
        Accumulator count = 0;
        mesh.any_around(v, [&](int side) {
            const Place& q = mesh.place(mesh.to(side));
            mean += q;
            count += 1;
            normal += cross(q - p, mesh.place(mesh.to(mesh.next(side))) - p);
            return false;
        });
        const Accumulator length = norm(normal);
        if (count < 3 || !(length > 0)) continue;
        normal /= length;
        const Place step = mean / count - p;
        moved[static_cast<std::size_t>(v)] = p + (step - inner(step, normal) * normal);
    }
    for (int v = 0; v < mesh.vertices(); ++v) mesh.move(v, moved[static_cast<std::size_t>(v)]);
}

} // namespace detail

SKELGEN_INLINE void validate(const ProxyOptions& options) {
    core::require_in_range("proxy.vertices", options.vertices, 100, most_proxy_vertices);
    core::require_in_range("proxy.rounds", options.rounds, 0, 100);
}

template <typename Scalar>
Proxy<Scalar> build_proxy(const TriangleMesh<Scalar>& mesh, const ProxyOptions& options) {
    validate(options);
    // Remeshing is double whatever the mesh: it is a long chain of comparisons, of lengths that on a regular mesh are
    // nearly equal, and in float rounding would decide them.
    using core::Accumulator;
    const Accumulator area = core::surface_area(mesh);
    if (!(area > 0) || !std::isfinite(area))
        throw Error(ErrorCode::bad_input, "the surface has no area; all faces are degenerate");
    HalfEdges work(mesh.vertices.template cast<Accumulator>(), mesh.faces);
    // n vertices in equilateral triangles of edge l cover the area n * l^2 * sqrt(3) / 2.
    const Accumulator edge = std::sqrt(2 * area / (std::sqrt(Accumulator(3)) * options.vertices));
    const Accumulator longest = Accumulator(4) / 3 * edge, shortest = Accumulator(4) / 5 * edge; // BK04 section 4
    // Splitting adds no more than the wanted vertices, but for needles: the pieces of one are needles again, and as
    // many as the square of its length in edges. What may be left of them after the collapses is a few times as many.
    constexpr int most_added = 10;
    const auto most = static_cast<std::size_t>(work.vertices()) +
                      static_cast<std::size_t>(most_added) * static_cast<std::size_t>(options.vertices);
    for (int round = 0; round < options.rounds; ++round) {
        detail::coarsen(work, shortest, longest);
        detail::refine(work, longest, most);
        detail::flip_towards_valence_six(work);
        detail::relax_tangentially(work);
    }
    return detail::to_proxy<Scalar>(work);
}

} // namespace skelgen::curve
