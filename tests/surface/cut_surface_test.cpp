#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/cut_surface.hpp>
#include <skelgen/surface/manifold_parts.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::surface;
using namespace skelgen::test;

namespace {

/// Vertices where `wanted` of their position holds.
template <typename Wanted>
std::vector<int> vertices_where(const Mesh& mesh, Wanted&& wanted) {
    std::vector<int> out;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        if (wanted(Vec3(mesh.vertices.row(v).transpose()))) out.push_back(static_cast<int>(v));
    return out;
}

/// 1 minus half the Euler characteristic of a closed mesh.
Eigen::Index genus(const Mesh& mesh) { return 1 - (mesh.vertices.rows() - mesh.faces.rows() / 2) / 2; }

/// A ring around the z axis, and a cut through it at x > 0 in the plane y = 0.
CutSurface<double> cut_ring(const Mesh& ring) {
    const auto before = vertices_where(ring, [](const Vec3& p) { return p.x() > 0 && p.y() < 0; });
    const auto behind = vertices_where(ring, [](const Vec3& p) { return p.x() > 0 && p.y() >= 0; });
    return cut_surface(ring, before, behind);
}

} // namespace

TEST_CASE("a torus cut through becomes a closed bent tube") {
    const Mesh ring = torus(1, 0.2);
    REQUIRE(genus(ring) == 1);
    const CutSurface<double> cut = cut_ring(ring);
    CHECK(is_closed(cut.mesh.faces));
    CHECK(genus(cut.mesh) == 0);
    const double both_caps = 2 * pi * 0.2 * 0.2;
    CHECK(surface_area(cut.mesh) > surface_area(ring)); // by the caps less the gap
    CHECK(surface_area(cut.mesh) < surface_area(ring) + both_caps);
    CHECK(enclosed_volume(cut.mesh) < enclosed_volume(ring));
    CHECK(enclosed_volume(cut.mesh) > 0.97 * enclosed_volume(ring));
}

TEST_CASE("the old vertices come first, and the new ones know where they come from") {
    const Mesh ring = torus(1, 0.2);
    const CutSurface<double> cut = cut_ring(ring);
    REQUIRE(cut.source.size() == static_cast<std::size_t>(cut.mesh.vertices.rows()));
    int hubs = 0;
    for (std::size_t v = 0; v < cut.source.size(); ++v) {
        if (v < static_cast<std::size_t>(ring.vertices.rows())) CHECK(cut.source[v] == static_cast<int>(v));
        if (cut.source[v] < 0) {
            ++hubs;
            continue;
        }
        const double moved =
            (cut.mesh.vertices.row(static_cast<Eigen::Index>(v)) - ring.vertices.row(cut.source[v])).norm();
        CHECK(moved < 0.1); // an edge of the torus is that long
    }
    CHECK(hubs == 2);
}

TEST_CASE("two parts that meet nowhere are not cut") {
    const Mesh ring = torus(1, 0.2);
    const CutSurface<double> cut = cut_surface(ring, vertices_where(ring, [](const Vec3& p) { return p.x() > 0.9; }),
                                               vertices_where(ring, [](const Vec3& p) { return p.x() < -0.9; }));
    CHECK(cut.mesh.faces == ring.faces);
    CHECK(cut.mesh.vertices == ring.vertices);
}

TEST_CASE("a capsule cut in the middle falls into two closed halves") {
    const Mesh body = capsule(0.3, 4);
    const CutSurface<double> cut = cut_surface(body, vertices_where(body, [](const Vec3& p) { return p.z() < 2; }),
                                               vertices_where(body, [](const Vec3& p) { return p.z() >= 2; }));
    const ManifoldParts<double> half = largest_manifold_part(cut.mesh);
    CHECK(half.dropped_pieces == 1);
    CHECK(is_closed(half.mesh.faces));
    CHECK(enclosed_volume(half.mesh) == Approx(enclosed_volume(body) / 2).epsilon(0.1));
}
