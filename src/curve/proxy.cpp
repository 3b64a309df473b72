#include <skelgen/curve/proxy.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/PropertyManager.hh>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen {
namespace {

struct MeshTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
};
using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits>;
using OpenMesh::Vec3d;
using Source = OpenMesh::VProp<int>; ///< the original vertex that a vertex stems from, -1 for those made by a split

/// Fills `out`, whose vertices then have the same numbers as those of `mesh`.
void to_halfedges(const TriangleMesh<double>& mesh, HalfedgeMesh& out, Source& source) {
    const auto n = static_cast<std::size_t>(mesh.vertices.rows()), m = static_cast<std::size_t>(mesh.faces.rows());
    out.reserve(n, n + m, m);
    std::vector<HalfedgeMesh::VertexHandle> handles;
    handles.reserve(n);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        handles.push_back(out.add_vertex({mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2)}));
        source[handles.back()] = static_cast<int>(v);
    }
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const auto at = [&](Eigen::Index k) { return handles[static_cast<std::size_t>(mesh.faces(f, k))]; };
        if (!out.add_face(at(0), at(1), at(2)).is_valid())
            throw Error(ErrorCode::bad_input, "the surface is not manifold; cut it into manifold parts first");
    }
}

Proxy to_matrices(const HalfedgeMesh& mesh, const Source& source) {
    Proxy out;
    out.mesh.vertices.resize(static_cast<Eigen::Index>(mesh.n_vertices()), 3);
    out.mesh.faces.resize(static_cast<Eigen::Index>(mesh.n_faces()), 3);
    for (const auto v : mesh.vertices()) {
        const Vec3d& p = mesh.point(v);
        out.mesh.vertices.row(v.idx()) << p[0], p[1], p[2];
        out.source.push_back(source[v]);
    }
    for (const auto f : mesh.faces()) {
        Eigen::Index k = 0;
        for (const auto v : f.vertices()) out.mesh.faces(f.idx(), k++) = v.idx();
    }
    return out;
}

double squared_length(const HalfedgeMesh& mesh, HalfedgeMesh::EdgeHandle e) { return mesh.calc_edge_sqr_length(e); }

/// From one threshold of a sequence of splits or collapses to the next.
constexpr double threshold_ratio = 1.5;

/// Edges made by a split are left alone.
void split_long_edges(HalfedgeMesh& mesh, Source& source, double longest) {
    const std::size_t edges = mesh.n_edges();
    for (std::size_t i = 0; i < edges; ++i) {
        const auto e = mesh.edge_handle(static_cast<unsigned>(i));
        if (squared_length(mesh, e) <= longest * longest) continue;
        const auto h = mesh.halfedge_handle(e, 0);
        const Vec3d middle = 0.5 * (mesh.point(mesh.from_vertex_handle(h)) + mesh.point(mesh.to_vertex_handle(h)));
        const auto v = mesh.add_vertex(middle);
        source[v] = -1;
        mesh.split(e, v);
    }
}

/// Splits with a threshold that falls to `longest`, so that the longest edges go first: bisected there, a triangle's
/// halves are better shaped than itself.
void refine(HalfedgeMesh& mesh, Source& source, double longest) {
    double largest = 0;
    for (const auto e : mesh.edges()) largest = std::max(largest, mesh.calc_edge_length(e));
    const int steps = static_cast<int>(std::ceil(std::log(largest / longest) / std::log(threshold_ratio)));
    for (int step = steps; step >= 0; --step) split_long_edges(mesh, source, longest * std::pow(threshold_ratio, step));
}

/// Twice a face's area below this part of its squared longest edge: the face is a segment.
constexpr double degenerate = 1e-6;

double squared_size(const HalfedgeMesh& mesh, HalfedgeMesh::VertexHandle a, HalfedgeMesh::VertexHandle b,
                    HalfedgeMesh::VertexHandle c) {
    return std::max({(mesh.point(a) - mesh.point(b)).sqrnorm(), (mesh.point(b) - mesh.point(c)).sqrnorm(),
                     (mesh.point(c) - mesh.point(a)).sqrnorm()});
}

/// Would moving vertex `v` to `target` turn over one of its faces (other than those that vanish)?
bool flips_a_face(const HalfedgeMesh& mesh, HalfedgeMesh::VertexHandle v, HalfedgeMesh::VertexHandle other,
                  const Vec3d& target) {
    for (auto h = mesh.cvoh_iter(v); h.is_valid(); ++h) {
        if (mesh.is_boundary(*h)) continue;
        const auto a = mesh.to_vertex_handle(*h), b = mesh.to_vertex_handle(mesh.next_halfedge_handle(*h));
        if (a == other || b == other) continue;
        const Vec3d before = (mesh.point(a) - mesh.point(v)) % (mesh.point(b) - mesh.point(v));
        const Vec3d after = (mesh.point(a) - target) % (mesh.point(b) - target);
        // A face without area, as a split leaves behind, has a normal of rounding errors: it must not decide anything.
        if (before.sqrnorm() < degenerate * degenerate * squared_size(mesh, v, a, b) * squared_size(mesh, v, a, b))
            continue;
        if ((before | after) <= 0.2 * before.norm() * after.norm()) return true;
    }
    return false;
}

/// Would moving vertex `v` to `target` make one of its edges too long? One that is so already is to be split in any
/// case; if it forbade the collapse, the short edges across a fan of needles would outlast it.
bool makes_a_long_edge(const HalfedgeMesh& mesh, HalfedgeMesh::VertexHandle v, const Vec3d& target, double longest) {
    const double bound = longest * longest;
    for (auto w = mesh.cvv_iter(v); w.is_valid(); ++w)
        if ((mesh.point(*w) - target).sqrnorm() > bound && (mesh.point(*w) - mesh.point(v)).sqrnorm() <= bound)
            return true;
    return false;
}

void collapse_short_edges(HalfedgeMesh& mesh, Source& source, double shortest, double longest) {
    for (const auto e : mesh.edges()) {
        if (mesh.status(e).deleted() || squared_length(mesh, e) >= shortest * shortest) continue;
        auto h = mesh.halfedge_handle(e, 0);
        if (mesh.is_boundary(mesh.from_vertex_handle(h))) h = mesh.opposite_halfedge_handle(h);
        const auto from = mesh.from_vertex_handle(h), to = mesh.to_vertex_handle(h);
        if (!mesh.is_collapse_ok(h)) continue; // which also keeps apart two vertices on the boundary of an inner edge
        const bool joins_boundary = mesh.is_boundary(to) && !mesh.is_boundary(from);
        const Vec3d target = joins_boundary ? mesh.point(to) : 0.5 * (mesh.point(from) + mesh.point(to));
        if (makes_a_long_edge(mesh, from, target, longest) || makes_a_long_edge(mesh, to, target, longest)) continue;
        if (flips_a_face(mesh, from, to, target) || flips_a_face(mesh, to, from, target)) continue;
        mesh.set_point(to, target);
        if (source[to] < 0) source[to] = source[from];
        mesh.collapse(h);
    }
    mesh.garbage_collection();
}

/// Collapses with a threshold that rises to `shortest`, so that a fine input shrinks evenly.
void coarsen(HalfedgeMesh& mesh, Source& source, double shortest, double longest) {
    double sum = 0, count = 0;
    for (const auto e : mesh.edges()) {
        const double length = mesh.calc_edge_length(e);
        if (length >= shortest) continue;
        sum += length;
        count += 1;
    }
    if (count == 0) return;
    // Counted down from `shortest`: a regular mesh has edges of exactly the mean length, which must not be a threshold.
    constexpr double most_steps = 20; // edges without any length
    const int steps =
        static_cast<int>(std::min(most_steps, std::log(shortest * count / sum) / std::log(threshold_ratio)));
    for (int step = steps; step >= 0; --step)
        collapse_short_edges(mesh, source, shortest * std::pow(threshold_ratio, -step), longest);
}

int valence_error(const HalfedgeMesh& mesh, HalfedgeMesh::VertexHandle v, int change) {
    const int error = static_cast<int>(mesh.valence(v)) + change - (mesh.is_boundary(v) ? 4 : 6);
    return error * error;
}

/// Do the two faces made by flipping `e` keep the orientation of those it replaces?
bool flip_keeps_orientation(const HalfedgeMesh& mesh, HalfedgeMesh::HalfedgeHandle h) {
    const auto o = mesh.opposite_halfedge_handle(h);
    const Vec3d& a = mesh.point(mesh.from_vertex_handle(h));
    const Vec3d& b = mesh.point(mesh.to_vertex_handle(h));
    const Vec3d& c = mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(h)));
    const Vec3d& d = mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(o)));
    const Vec3d before = (b - a) % (c - a) + (d - a) % (b - a);
    const Vec3d first = (d - a) % (c - a), second = (c - b) % (d - b);
    const double bar = 0.5 * before.norm();
    const double least =
        degenerate * (b - a).sqrnorm(); // a new face without area would have a normal of rounding errors
    if (first.norm() < least || second.norm() < least) return false;
    return (first | before) > bar * first.norm() && (second | before) > bar * second.norm();
}

void flip_towards_valence_six(HalfedgeMesh& mesh) {
    for (const auto e : mesh.edges()) {
        if (mesh.is_boundary(e) || !mesh.is_flip_ok(e)) continue;
        const auto h = mesh.halfedge_handle(e, 0), o = mesh.halfedge_handle(e, 1);
        const auto a = mesh.from_vertex_handle(h), b = mesh.to_vertex_handle(h);
        const auto c = mesh.to_vertex_handle(mesh.next_halfedge_handle(h));
        const auto d = mesh.to_vertex_handle(mesh.next_halfedge_handle(o));
        const int now = valence_error(mesh, a, 0) + valence_error(mesh, b, 0) + valence_error(mesh, c, 0) +
                        valence_error(mesh, d, 0);
        const int then = valence_error(mesh, a, -1) + valence_error(mesh, b, -1) + valence_error(mesh, c, 1) +
                         valence_error(mesh, d, 1);
        if (then < now && flip_keeps_orientation(mesh, h)) mesh.flip(e);
    }
}

void relax_tangentially(HalfedgeMesh& mesh) {
    std::vector<Vec3d> moved(mesh.n_vertices());
    for (const auto v : mesh.vertices()) {
        const Vec3d& p = mesh.point(v);
        moved[static_cast<std::size_t>(v.idx())] = p;
        if (mesh.is_boundary(v)) continue;
        Vec3d mean(0, 0, 0), normal(0, 0, 0);
        double count = 0;
        for (auto h = mesh.cvoh_iter(v); h.is_valid(); ++h) {
            const Vec3d& q = mesh.point(mesh.to_vertex_handle(*h));
            mean += q;
            count += 1;
            normal += (q - p) % (mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(*h))) - p);
        }
        const double length = normal.norm();
        if (count < 3 || !(length > 0)) continue;
        normal /= length;
        const Vec3d step = mean / count - p;
        moved[static_cast<std::size_t>(v.idx())] = p + (step - (step | normal) * normal);
    }
    for (const auto v : mesh.vertices()) mesh.set_point(v, moved[static_cast<std::size_t>(v.idx())]);
}

} // namespace

Proxy build_proxy(const TriangleMesh<double>& mesh, const ProxyOptions& options) {
    HalfedgeMesh work;
    Source source(work);
    to_halfedges(mesh, work, source);
    // n vertices in equilateral triangles of edge l cover the area n * l^2 * sqrt(3) / 2.
    const double edge = std::sqrt(2 * surface_area(mesh) / (std::sqrt(3.0) * options.vertices));
    const double longest = 4.0 / 3 * edge, shortest = 4.0 / 5 * edge;
    for (int round = 0; round < options.rounds; ++round) {
        coarsen(work, source, shortest, longest);
        refine(work, source, longest);
        flip_towards_valence_six(work);
        relax_tangentially(work);
    }
    return to_matrices(work, source);
}

} // namespace skelgen
