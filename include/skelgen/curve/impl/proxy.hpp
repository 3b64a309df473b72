#pragma once

#include <skelgen/curve/proxy.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/PropertyManager.hh>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::curve {
namespace detail {

template <typename Scalar>
struct MeshTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::VectorT<Scalar, 3>;
    using Normal = OpenMesh::VectorT<Scalar, 3>;
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
};
template <typename Scalar>
using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits<Scalar>>;
template <typename Scalar>
using MeshPoint = OpenMesh::VectorT<Scalar, 3>;
using OpenMesh::EdgeHandle, OpenMesh::HalfedgeHandle, OpenMesh::VertexHandle;
using Source = OpenMesh::VProp<int>; ///< the original vertex that a vertex stems from, -1 for those made by a split

/// Fills `out`, whose vertices then have the same numbers as those of `mesh`.
template <typename Scalar>
void to_halfedges(const TriangleMesh<Scalar>& mesh, HalfedgeMesh<core::Accumulator>& out, Source& source) {
    const auto n = static_cast<std::size_t>(mesh.vertices.rows()), m = static_cast<std::size_t>(mesh.faces.rows());
    out.reserve(n, n + m, m);
    std::vector<VertexHandle> handles;
    handles.reserve(n);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        const Vector3<core::Accumulator> p = core::point(mesh.vertices, v).template cast<core::Accumulator>();
        handles.push_back(out.add_vertex({p[0], p[1], p[2]}));
        source[handles.back()] = static_cast<int>(v);
    }
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const auto at = [&](Eigen::Index k) { return handles[static_cast<std::size_t>(mesh.faces(f, k))]; };
        if (!out.add_face(at(0), at(1), at(2)).is_valid())
            throw Error(ErrorCode::bad_input, "the surface is not manifold; cut it into manifold parts first");
    }
}

template <typename Scalar>
Proxy<Scalar> to_proxy(const HalfedgeMesh<core::Accumulator>& mesh, const Source& source) {
    Proxy<Scalar> out;
    out.mesh.vertices.resize(static_cast<Eigen::Index>(mesh.n_vertices()), 3);
    out.mesh.faces.resize(static_cast<Eigen::Index>(mesh.n_faces()), 3);
    for (const auto v : mesh.vertices()) {
        const MeshPoint<core::Accumulator>& p = mesh.point(v);
        for (int k = 0; k < 3; ++k) out.mesh.vertices(v.idx(), k) = static_cast<Scalar>(p[k]);
        out.source.push_back(source[v]);
    }
    for (const auto f : mesh.faces()) {
        Eigen::Index k = 0;
        for (const auto v : f.vertices()) out.mesh.faces(f.idx(), k++) = v.idx();
    }
    return out;
}

template <typename Scalar>
Scalar squared_length(const HalfedgeMesh<Scalar>& mesh, EdgeHandle e) {
    return mesh.calc_edge_sqr_length(e);
}

/// From one threshold of a sequence of splits or collapses to the next; calibrated.
inline constexpr double threshold_ratio = 1.5;

/// `length` times the ratio to the power of `steps`.
template <typename Scalar>
Scalar threshold(Scalar length, int steps) {
    return static_cast<Scalar>(length * std::pow(threshold_ratio, steps));
}

/// Edges made by a split are left alone. \throws Error bad_input when there come to be more than `most` vertices.
template <typename Scalar>
void split_long_edges(HalfedgeMesh<Scalar>& mesh, Source& source, Scalar longest, std::size_t most) {
    const std::size_t edges = mesh.n_edges();
    for (std::size_t i = 0; i < edges; ++i) {
        const auto e = mesh.edge_handle(static_cast<unsigned>(i));
        if (squared_length(mesh, e) <= longest * longest) continue;
        if (mesh.n_vertices() >= most)
            throw Error(ErrorCode::bad_input, "a triangle is far longer than the rest of the surface: remove the stray "
                                              "vertex that it reaches to");
        const auto h = mesh.halfedge_handle(e, 0);
        const MeshPoint<Scalar> middle =
            Scalar(0.5) * (mesh.point(mesh.from_vertex_handle(h)) + mesh.point(mesh.to_vertex_handle(h)));
        const auto v = mesh.add_vertex(middle);
        source[v] = -1;
        mesh.split(e, v);
    }
}

/// Splits with a threshold that falls to `longest`, so that the longest edges go first: bisected there, a triangle's
/// halves are better shaped than itself.
template <typename Scalar>
void refine(HalfedgeMesh<Scalar>& mesh, Source& source, Scalar longest, std::size_t most_vertices) {
    constexpr double most_steps = 40;
    Scalar largest = 0;
    for (const auto e : mesh.edges()) largest = std::max(largest, mesh.calc_edge_length(e));
    if (largest < longest) return;
    const double ratio = std::ceil(std::log(largest / longest) / std::log(threshold_ratio));
    for (int step = static_cast<int>(std::min(ratio, most_steps)); step >= 0; --step)
        split_long_edges(mesh, source, threshold(longest, step), most_vertices);
}

/// Twice a face's area below this part of its squared longest edge: the face is a segment. A millionth, but in float a
/// few roundings are more than that.
template <typename Scalar>
inline constexpr Scalar degenerate = std::max(Scalar(1e-6), 16 * std::numeric_limits<Scalar>::epsilon());

template <typename Scalar>
Scalar squared_size(const HalfedgeMesh<Scalar>& mesh, VertexHandle a, VertexHandle b, VertexHandle c) {
    return std::max({(mesh.point(a) - mesh.point(b)).sqrnorm(), (mesh.point(b) - mesh.point(c)).sqrnorm(),
                     (mesh.point(c) - mesh.point(a)).sqrnorm()});
}

/// Would moving vertex `v` to `target` turn over one of its faces (other than those that vanish)?
template <typename Scalar>
bool flips_a_face(const HalfedgeMesh<Scalar>& mesh, VertexHandle v, VertexHandle other,
                  const MeshPoint<Scalar>& target) {
    constexpr auto least_cosine = Scalar(0.2); // turned by more than 78 degrees; calibrated
    for (auto h = mesh.cvoh_iter(v); h.is_valid(); ++h) {
        if (mesh.is_boundary(*h)) continue;
        const auto a = mesh.to_vertex_handle(*h), b = mesh.to_vertex_handle(mesh.next_halfedge_handle(*h));
        if (a == other || b == other) continue;
        const MeshPoint<Scalar> before = (mesh.point(a) - mesh.point(v)) % (mesh.point(b) - mesh.point(v));
        const MeshPoint<Scalar> after = (mesh.point(a) - target) % (mesh.point(b) - target);
        // A face without area, as a split leaves behind, has a normal of rounding errors, or none at all where its
        // three vertices coincide: it must not decide anything.
        const Scalar size = squared_size(mesh, v, a, b);
        if (before.sqrnorm() <= degenerate<Scalar> * degenerate<Scalar> * size * size) continue;
        if ((before | after) <= least_cosine * before.norm() * after.norm()) return true;
    }
    return false;
}

/// Would moving vertex `v` to `target` make one of its edges too long? One that is so already is to be split in any
/// case; if it forbade the collapse, the short edges across a fan of needles would outlast it.
template <typename Scalar>
bool makes_a_long_edge(const HalfedgeMesh<Scalar>& mesh, VertexHandle v, const MeshPoint<Scalar>& target,
                       Scalar longest) {
    const Scalar bound = longest * longest;
    for (auto w = mesh.cvv_iter(v); w.is_valid(); ++w)
        if ((mesh.point(*w) - target).sqrnorm() > bound && (mesh.point(*w) - mesh.point(v)).sqrnorm() <= bound)
            return true;
    return false;
}

template <typename Scalar>
void collapse_short_edges(HalfedgeMesh<Scalar>& mesh, Source& source, Scalar shortest, Scalar longest) {
    for (const auto e : mesh.edges()) {
        if (mesh.status(e).deleted() || squared_length(mesh, e) >= shortest * shortest) continue;
        auto h = mesh.halfedge_handle(e, 0);
        if (mesh.is_boundary(mesh.from_vertex_handle(h))) h = mesh.opposite_halfedge_handle(h);
        const auto from = mesh.from_vertex_handle(h), to = mesh.to_vertex_handle(h);
        if (!mesh.is_collapse_ok(h)) continue; // which also keeps apart two vertices on the boundary of an inner edge
        const bool joins_boundary = mesh.is_boundary(to) && !mesh.is_boundary(from);
        const MeshPoint<Scalar> target =
            joins_boundary ? mesh.point(to) : Scalar(0.5) * (mesh.point(from) + mesh.point(to));
        if (makes_a_long_edge(mesh, from, target, longest) || makes_a_long_edge(mesh, to, target, longest)) continue;
        if (flips_a_face(mesh, from, to, target) || flips_a_face(mesh, to, from, target)) continue;
        mesh.set_point(to, target);
        if (source[to] < 0) source[to] = source[from];
        mesh.collapse(h);
    }
    mesh.garbage_collection();
}

/// Collapses with a threshold that rises to `shortest`, so that a fine input shrinks evenly.
template <typename Scalar>
void coarsen(HalfedgeMesh<Scalar>& mesh, Source& source, Scalar shortest, Scalar longest) {
    constexpr double most_steps = 20;
    core::Accumulator sum = 0; // over the whole surface
    std::size_t count = 0;
    for (const auto e : mesh.edges()) {
        const Scalar length = mesh.calc_edge_length(e);
        if (length >= shortest) continue;
        sum += length;
        ++count;
    }
    if (count == 0) return;
    // Counted down from `shortest`: a regular mesh has edges of exactly the mean length, which must not be a threshold.
    const double ratio = sum > 0 ? std::log(shortest * static_cast<double>(count) / sum) / std::log(threshold_ratio)
                                 : most_steps; // edges without any length
    for (int step = static_cast<int>(std::min(ratio, most_steps)); step >= 0; --step)
        collapse_short_edges(mesh, source, threshold(shortest, -step), longest);
}

/// Of each vertex the number of its edges above that of a regular mesh: six, four on the boundary.
template <typename Scalar>
std::vector<int> excess_valences(const HalfedgeMesh<Scalar>& mesh) {
    std::vector<int> out(mesh.n_vertices());
    for (const auto v : mesh.vertices()) out[static_cast<std::size_t>(v.idx())] = mesh.is_boundary(v) ? -4 : -6;
    for (const auto e : mesh.edges())
        for (const auto v : {e.v0(), e.v1()}) ++out[static_cast<std::size_t>(v.idx())];
    return out;
}

/// Do the two faces made by flipping `e` keep the orientation of those it replaces?
template <typename Scalar>
bool flip_keeps_orientation(const HalfedgeMesh<Scalar>& mesh, HalfedgeHandle h) {
    const auto o = mesh.opposite_halfedge_handle(h);
    const MeshPoint<Scalar>& a = mesh.point(mesh.from_vertex_handle(h));
    const MeshPoint<Scalar>& b = mesh.point(mesh.to_vertex_handle(h));
    const MeshPoint<Scalar>& c = mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(h)));
    const MeshPoint<Scalar>& d = mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(o)));
    const MeshPoint<Scalar> before = (b - a) % (c - a) + (d - a) % (b - a);
    const MeshPoint<Scalar> first = (d - a) % (c - a), second = (c - b) % (d - b);
    const Scalar bar = Scalar(0.5) * before.norm(); // turned by less than 60 degrees; calibrated
    // A new face without area would have a normal of rounding errors.
    const Scalar least = degenerate<Scalar> * (b - a).sqrnorm();
    if (first.norm() < least || second.norm() < least) return false;
    return (first | before) > bar * first.norm() && (second | before) > bar * second.norm();
}

template <typename Scalar>
void flip_towards_valence_six(HalfedgeMesh<Scalar>& mesh) {
    std::vector<int> excess = excess_valences(mesh);
    const auto squared = [](int value) { return value * value; };
    for (const auto e : mesh.edges()) {
        if (mesh.is_boundary(e)) continue;
        const auto h = mesh.halfedge_handle(e, 0), o = mesh.halfedge_handle(e, 1);
        const auto excess_of = [&](VertexHandle v) -> int& { return excess[static_cast<std::size_t>(v.idx())]; };
        int& a = excess_of(mesh.from_vertex_handle(h));
        int& b = excess_of(mesh.to_vertex_handle(h));
        int& c = excess_of(mesh.to_vertex_handle(mesh.next_halfedge_handle(h)));
        int& d = excess_of(mesh.to_vertex_handle(mesh.next_halfedge_handle(o)));
        const int now = squared(a) + squared(b) + squared(c) + squared(d);
        const int then = squared(a - 1) + squared(b - 1) + squared(c + 1) + squared(d + 1);
        if (then >= now || !mesh.is_flip_ok(e) || !flip_keeps_orientation(mesh, h)) continue;
        mesh.flip(e);
        --a, --b, ++c, ++d;
    }
}

template <typename Scalar>
void relax_tangentially(HalfedgeMesh<Scalar>& mesh) {
    std::vector<MeshPoint<Scalar>> moved(mesh.n_vertices());
    for (const auto v : mesh.vertices()) {
        const MeshPoint<Scalar>& p = mesh.point(v);
        moved[static_cast<std::size_t>(v.idx())] = p;
        if (mesh.is_boundary(v)) continue;
        MeshPoint<Scalar> mean(0, 0, 0), normal(0, 0, 0);
        Scalar count = 0;
        for (auto h = mesh.cvoh_iter(v); h.is_valid(); ++h) {
            const MeshPoint<Scalar>& q = mesh.point(mesh.to_vertex_handle(*h));
            mean += q;
            count += 1;
            normal += (q - p) % (mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(*h))) - p);
        }
        const Scalar length = normal.norm();
        if (count < 3 || !(length > 0)) continue;
        normal /= length;
        const MeshPoint<Scalar> step = mean / count - p;
        moved[static_cast<std::size_t>(v.idx())] = p + (step - (step | normal) * normal);
    }
    for (const auto v : mesh.vertices()) mesh.set_point(v, moved[static_cast<std::size_t>(v.idx())]);
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
    detail::HalfedgeMesh<Accumulator> work;
    detail::Source source(work);
    detail::to_halfedges(mesh, work, source);
    // n vertices in equilateral triangles of edge l cover the area n * l^2 * sqrt(3) / 2.
    const Accumulator edge = std::sqrt(2 * area / (std::sqrt(Accumulator(3)) * options.vertices));
    const Accumulator longest = Accumulator(4) / 3 * edge, shortest = Accumulator(4) / 5 * edge; // BK04 section 4
    // Splitting adds no more than the wanted vertices, but for needles: the pieces of one are needles again, and as
    // many as the square of its length in edges. What may be left of them after the collapses is a few times as many.
    constexpr std::size_t most_added = 10;
    const std::size_t most = work.n_vertices() + most_added * static_cast<std::size_t>(options.vertices);
    for (int round = 0; round < options.rounds; ++round) {
        detail::coarsen(work, source, shortest, longest);
        detail::refine(work, source, longest, most);
        detail::flip_towards_valence_six(work);
        detail::relax_tangentially(work);
    }
    return detail::to_proxy<Scalar>(work, source);
}

} // namespace skelgen::curve
