#include "surface_mesher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <CGAL/Complex_2_in_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_with_circumcenter_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/facets_in_complex_2_to_triangle_mesh.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Robust_circumcenter_traits_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_cell_base_3.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/Surface_mesh_vertex_base_3.h>
#include <CGAL/Surface_mesher/Standard_criteria.h>
#include <CGAL/Triangulation_data_structure_3.h>
#include <CGAL/make_surface_mesh.h>
#include <CGAL/subdivision_method_3.h>
#include <boost/optional.hpp>

#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/error.hpp>

namespace skelgen::synth {
namespace {

/// A vertex or cell that knows when it was made. CGAL then orders handles by that instead of by address, which would
/// differ from one call to the next.
template <typename Base>
class Stamped : public Base {
public:
    using Base::Base;
    using Has_timestamp = CGAL::Tag_true;

    template <typename DataStructure>
    struct Rebind_TDS {
        using Other = Stamped<typename Base::template Rebind_TDS<DataStructure>::Other>;
    };

    [[nodiscard]] std::size_t time_stamp() const { return stamp_; }
    void set_time_stamp(const std::size_t& stamp) { stamp_ = stamp; }

private:
    std::size_t stamp_ = static_cast<std::size_t>(-1); // "none yet" to CGAL
};

using Kernel = CGAL::Robust_circumcenter_traits_3<CGAL::Exact_predicates_inexact_constructions_kernel>;
using VertexBase = Stamped<CGAL::Surface_mesh_vertex_base_3<Kernel>>;
using CellBase =
    Stamped<CGAL::Delaunay_triangulation_cell_base_with_circumcenter_3<Kernel, CGAL::Surface_mesh_cell_base_3<Kernel>>>;
using Triangulation =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Complex = CGAL::Complex_2_in_triangulation_3<Triangulation>;
using Point = Triangulation::Geom_traits::Point_3;
using Sphere = Triangulation::Geom_traits::Sphere_3;
using Surface = CGAL::Implicit_surface_3<Triangulation::Geom_traits, std::function<double(Point)>>;
using Mesh = CGAL::Surface_mesh<Point>;
using Criterion = CGAL::Surface_mesher::Refine_criterion<Triangulation>;

Vec3 vec(const Point& p) { return {p.x(), p.y(), p.z()}; }

/// Bounds the radius of a facet's surface ball by a size that varies over the surface.
class SizeField : public Criterion {
public:
    SizeField(const std::function<double(const Vec3&)>& grain, double edge) : grain_(&grain), edge_(edge) {}

    bool is_bad(const Triangulation::Facet& facet, Quality& quality) const override {
        const Point& centre = facet.first->get_facet_surface_center(facet.second);
        const Point& corner = facet.first->vertex((facet.second + 1) & 3)->point();
        const double bound = edge_ * (*grain_)(vec(centre)) / std::sqrt(3.0); // of a regular triangle's circumcircle
        quality = bound * bound / CGAL::squared_distance(corner, centre);
        return quality < 1;
    }

private:
    const std::function<double(const Vec3&)>* grain_;
    double edge_;
};

class Criteria {
public:
    using Quality = std::vector<Criterion::Quality>;

    Criteria(const std::function<double(const Vec3&)>& grain, double edge, double angle)
        : size_(grain, edge), angle_(angle) {}

    bool is_bad(const Triangulation::Facet& facet, Quality& quality) const {
        quality.assign(2, 1.0);
        if (angle_.is_bad(facet, quality[0])) return true;
        return size_.is_bad(facet, quality[1]);
    }

private:
    SizeField size_;
    CGAL::Surface_mesher::Aspect_ratio_criterion<Triangulation> angle_;
};

/// Points on the surface where it crosses a grid of that spacing: the refinement has to start on every limb.
std::vector<Point> crossing_points(const ImplicitSurface& surface, double spacing) {
    const int n = static_cast<int>(std::ceil(surface.radius / spacing));
    const auto node = [&](int i, int j, int k) -> Vec3 { return surface.inside + spacing * Vec3(i, j, k); };
    const auto cross = [&surface](Vec3 in, Vec3 out) {
        for (int step = 0; step < 20; ++step) {
            const Vec3 middle = (in + out) / 2;
            (surface.field(middle) < 0 ? in : out) = middle;
        }
        const Vec3 p = (in + out) / 2;
        return Point(p.x(), p.y(), p.z());
    };
    std::vector<Point> points;
    const int width = 2 * n + 1;
    std::vector<double> below(static_cast<std::size_t>(width * width), 1.0), layer(below.size());
    for (int k = -n; k <= n; ++k) {
        for (int j = -n; j <= n; ++j) {
            int outside = 0; // nodes ahead that the last field value, close to a distance, tells to be outside
            for (int i = -n; i <= n; ++i) {
                const auto at = static_cast<std::size_t>((j + n) * width + i + n);
                const double value = layer[at] = outside > 0 ? 1.0 : surface.field(node(i, j, k));
                outside = outside > 0 ? outside - 1 : static_cast<int>(std::max(0.0, 0.5 * value / spacing));
                const auto join = [&](double other, const Vec3& there) {
                    if ((value < 0) != (other < 0))
                        points.push_back(value < 0 ? cross(node(i, j, k), there) : cross(there, node(i, j, k)));
                };
                if (i > -n) join(layer[at - 1], node(i - 1, j, k));
                if (j > -n) join(layer[at - static_cast<std::size_t>(width)], node(i, j - 1, k));
                if (k > -n) join(below[at], node(i, j, k - 1));
            }
        }
        std::swap(below, layer);
    }
    return points;
}

TriangleMesh<double> to_matrices(const Mesh& mesh) {
    TriangleMesh<double> result;
    result.vertices.resize(static_cast<Eigen::Index>(mesh.number_of_vertices()), 3);
    result.faces.resize(static_cast<Eigen::Index>(mesh.number_of_faces()), 3);
    for (const auto v : mesh.vertices()) result.vertices.row(static_cast<Eigen::Index>(v.idx())) = vec(mesh.point(v));
    Eigen::Index row = 0;
    for (const auto f : mesh.faces()) {
        int corner = 0;
        for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
            result.faces(row, corner++) = static_cast<int>(v.idx());
        ++row;
    }
    return result;
}

/// Faces that `edge` will give, from a coarse sampling of the surface: its area over that of a triangle, weighted by
/// the grain. The factor is what Delaunay refinement makes of it.
double expected_faces(const ImplicitSurface& surface, const std::vector<Point>& samples, double spacing, double edge) {
    constexpr double refinement_factor = 3.0;
    double weight = 0;
    for (const Point& p : samples) weight += 1 / std::pow(surface.grain(vec(p)), 2);
    return refinement_factor * weight * spacing * spacing / (edge * edge);
}

[[noreturn]] void refuse_contact() {
    throw Error(ErrorCode::internal,
                "the surface just touches itself, so no mesh of it ends; move what touches apart by "
                "some millimetres, or into each other");
}

/// Triangles of about `edge` times the grain, angles of 25 degrees and more. Where surfaces just touch, no refinement
/// makes a manifold of them: it would go on until coordinates round, so after `most` looks at the field it is an error.
Mesh refine(const ImplicitSurface& surface, double edge, double most) {
    CGAL::get_default_random() = CGAL::Random(1);
    Triangulation triangulation;
    const std::vector<Point> start = crossing_points(surface, 3 * edge);
    triangulation.insert(start.begin(), start.end());
    Complex complex(triangulation);
    double looks = 0;
    const auto field = [&](const Point& p) {
        if (++looks > most) refuse_contact();
        return surface.field(vec(p));
    };
    const Point centre(surface.inside.x(), surface.inside.y(), surface.inside.z());
    const Surface zero(field, Sphere(centre, surface.radius * surface.radius), 1e-4);
    try {
        CGAL::make_surface_mesh(complex, zero, Criteria(surface.grain, edge, 25), CGAL::Manifold_tag(), 0);
    } catch (const CGAL::Failure_exception&) { // they have rounded before
        refuse_contact();
    }
    Mesh mesh;
    CGAL::facets_in_complex_2_to_triangle_mesh(complex, mesh);
    return mesh;
}

/// Shortest edges first, measured in grains.
class GrainCost {
public:
    explicit GrainCost(const std::function<double(const Vec3&)>& grain) : grain_(&grain) {}

    template <typename Profile>
    boost::optional<double> operator()(const Profile& edge, const boost::optional<Point>&) const {
        const Vec3 a = vec(edge.p0()), b = vec(edge.p1());
        return (a - b).squaredNorm() / std::pow((*grain_)((a + b) / 2), 2);
    }

private:
    const std::function<double(const Vec3&)>* grain_;
};

void collapse(Mesh& mesh, const ImplicitSurface& surface, int faces) {
    namespace sms = CGAL::Surface_mesh_simplification;
    // Three edges for two faces; the predicate stops below its number.
    const sms::Count_stop_predicate<Mesh> stop(static_cast<std::size_t>(faces) * 3 / 2 + 1);
    const sms::Bounded_normal_change_placement<sms::Midpoint_placement<Mesh>> placement;
    sms::edge_collapse(mesh, stop, CGAL::parameters::get_cost(GrainCost(surface.grain)).get_placement(placement));
    mesh.collect_garbage();
}

Vec3 gradient(const ImplicitSurface& surface, const Vec3& p, double step) {
    Vec3 g;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 h = step * Vec3::Unit(axis);
        g[axis] = (surface.field(p + h) - surface.field(p - h)) / (2 * step);
    }
    return g;
}

/// Newton steps to where the field vanishes; stays put where that does not get nearer.
Vec3 on_surface(const ImplicitSurface& surface, Vec3 p, double reach) {
    double value = surface.field(p);
    for (int step = 0; step < 4 && std::abs(value) > 1e-7 * surface.radius; ++step) {
        const Vec3 g = gradient(surface, p, 1e-4 * surface.radius);
        Vec3 move = -value / std::max(g.squaredNorm(), 1e-6) * g;
        if (move.norm() > reach) move *= reach / move.norm();
        const double better = surface.field(p + move);
        if (std::abs(better) >= std::abs(value)) break;
        p += move;
        value = better;
    }
    return p;
}

double shortest_edge_around(const Mesh& mesh, Mesh::Vertex_index v) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v)))
        shortest = std::min(shortest, CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(v)));
    return std::sqrt(shortest);
}

void project(Mesh& mesh, const ImplicitSurface& surface) {
    for (const auto v : mesh.vertices()) {
        const Vec3 p = on_surface(surface, vec(mesh.point(v)), shortest_edge_around(mesh, v) / 3);
        mesh.point(v) = Point(p.x(), p.y(), p.z());
    }
}

/// Each triangle into four, the new vertices on the surface.
void subdivide(Mesh& mesh, const ImplicitSurface& surface) {
    CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(1));
    project(mesh, surface);
}

bool is_one_body(const Topology& topology) {
    return topology.closed_manifold && topology.components == 1 && topology.euler == 2;
}

std::string described(const Topology& topology) {
    return ": its mesh has " + std::to_string(topology.components) + " piece(s), and " +
           std::to_string(topology.components - topology.euler / 2) + " handle(s) where parts touch";
}

} // namespace

Topology topology_of(const TriangleMesh<double>& mesh) {
    std::vector<std::array<int, 2>> directed;
    core::DisjointSets components(static_cast<std::size_t>(mesh.vertices.rows()));
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3);
            directed.push_back({a, b});
            components.unite(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
        }
    std::sort(directed.begin(), directed.end());
    Topology result;
    const bool once = std::adjacent_find(directed.begin(), directed.end()) == directed.end();
    const bool paired = std::all_of(directed.begin(), directed.end(), [&](const std::array<int, 2>& e) {
        return std::binary_search(directed.begin(), directed.end(), std::array<int, 2>{e[1], e[0]});
    });
    result.closed_manifold = once && paired;
    result.components = static_cast<int>(components.count());
    result.euler =
        static_cast<int>(mesh.vertices.rows() - static_cast<Eigen::Index>(directed.size()) / 2 + mesh.faces.rows());
    return result;
}

TriangleMesh<double> mesh_surface(const ImplicitSurface& surface, int faces, bool one_body) {
    constexpr int finest_refinement = 60000, coarsest_refinement = 9000;
    constexpr double most_looks = 600; // at the field for each face: our sets take 210 at most, what almost touches 430
    int wanted = faces, subdivisions = 0;
    for (; wanted > finest_refinement; wanted /= 4) ++subdivisions;

    const double spacing = surface.radius / 50;
    const std::vector<Point> samples = crossing_points(surface, spacing);
    if (samples.empty()) throw Error(ErrorCode::internal, "the surface to be meshed is empty");
    double edge = spacing;
    edge *=
        std::sqrt(expected_faces(surface, samples, spacing, edge) / std::max(1.06 * wanted, 1.0 * coarsest_refinement));
    std::string found_last;
    for (int attempt = 0; attempt < 5; ++attempt) {
        Mesh mesh = refine(surface, edge, most_looks * expected_faces(surface, samples, spacing, edge));
        const auto found = static_cast<double>(mesh.number_of_faces());
        if (found < wanted) {
            edge *= std::sqrt(found / (1.08 * wanted));
            continue;
        }
        if (const Topology topology = topology_of(to_matrices(mesh)); one_body && !is_one_body(topology)) {
            found_last = described(topology);
            edge *= 0.8;
            continue;
        }
        collapse(mesh, surface, wanted);
        project(mesh, surface);
        for (int k = 0; k < subdivisions; ++k) subdivide(mesh, surface);
        return to_matrices(mesh);
    }
    throw Error(ErrorCode::internal, "the surface could not be meshed as one closed piece" + found_last +
                                         "; ask for more faces or another pose");
}

} // namespace skelgen::synth
