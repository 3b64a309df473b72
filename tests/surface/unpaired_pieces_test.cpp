// Pieces without a twin are left out, wherever the body stands; parts that do not touch are joined.

#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/impl/bridges.hpp>
#include <skelgen/surface/manifold_parts.hpp>
#include <skelgen/surface/prepare.hpp>
#include <skelgen/surface/unpaired_pieces.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::surface;
using namespace skelgen::test;
using core::enclosed_volume;

namespace {

Mesh joined(const std::vector<Mesh>& pieces) {
    Mesh out = pieces.front();
    for (std::size_t i = 1; i < pieces.size(); ++i) out = side_by_side(out, pieces[i]);
    return out;
}

/// Along z.
Mesh limb() { return capsule(0.1, 1); }

Mesh trunk() { return moved_by(sphere(0.4, 3), Vec3(0, 0, 0.5)); }

/// Two arms that are held differently: one hangs, one points forward.
std::vector<Mesh> in_a_pose() {
    Mesh forward = limb();
    for (Eigen::Index v = 0; v < forward.vertices.rows(); ++v)
        forward.vertices.row(v) =
            Vec3(forward.vertices(v, 0) + 0.5, -forward.vertices(v, 2), forward.vertices(v, 1) + 0.9).transpose();
    return {trunk(), moved_by(limb(), Vec3(-0.5, 0, 0)), forward};
}

} // namespace

TEST_CASE("what one hand holds is left out, what has a twin and what lies in the middle stay") {
    const std::vector<Mesh> body{trunk(), moved_by(limb(), Vec3(-0.5, 0, 0)), moved_by(limb(), Vec3(0.5, 0, 0)),
                                 moved_by(sphere(0.15, 2), Vec3(0, -0.6, 0.5))};
    const Mesh whole = joined(body);
    const Mesh shield = moved_by(sphere(0.2, 2), Vec3(0.75, 0.1, 0.3));
    CHECK_FALSE(without_lone_pieces(whole));
    const Mesh armed = side_by_side(whole, shield);
    const double turn = GENERATE(0.0, 1.1);
    const Mesh given = moved(
        armed, {Eigen::AngleAxisd(turn, Vec3(1, 2, -1).normalized()).toRotationMatrix(), 1, Vec3(turn, -3 * turn, 0)});
    const auto kept = without_lone_pieces(given);
    REQUIRE(kept);
    CHECK(kept->faces == whole.faces);
    CHECK(kept->dropped == 1);
    CHECK(kept->left_out == Approx(core::surface_area(shield) / core::surface_area(armed)).epsilon(1e-9));
}

TEST_CASE("twins stay however they are held: bodies may be in any pose") {
    std::vector<Mesh> pieces = in_a_pose();
    for (const double side : {-0.2, 0.2}) pieces.push_back(moved_by(sphere(0.08, 2), Vec3(side, -0.3, 0.9))); // eyes
    CHECK_FALSE(without_lone_pieces(joined(pieces)));
    pieces.push_back(moved_by(sphere(0.2, 2), Vec3(-1.2, 0.1, 0.3)));
    const auto kept = without_lone_pieces(joined(pieces));
    REQUIRE(kept);
    CHECK(kept->dropped == 1);
}

TEST_CASE("one piece alone, or pieces of which no two are alike, have no twins") {
    CHECK_FALSE(without_lone_pieces(trunk()));
    CHECK_FALSE(without_lone_pieces(side_by_side(trunk(), limb())));
    CHECK_FALSE(without_lone_pieces(Mesh{}));
}

TEST_CASE("a bridge joins parts that do not touch, where the gap is narrowest") {
    const std::vector<Mesh> parts{trunk(), moved_by(limb(), Vec3(0, 0, 1.02))}; // 0.02 above it
    const std::vector<Mesh> bridges = bridges_between(parts);
    REQUIRE(bridges.size() == 1);
    const Mesh& bridge = bridges.front();
    CHECK(is_closed(bridge.faces));
    CHECK(enclosed_volume(bridge) > 0);
    CHECK(bridge.vertices.leftCols(2).rowwise().norm().maxCoeff() < 0.1); // within the limb
    CHECK(bridge.vertices.col(2).minCoeff() < 0.9);
    CHECK(bridge.vertices.col(2).maxCoeff() > 0.92);
    const BodyMaterial<double> material = gather(joined(parts));
    const Outcome<Body<double>> body = make_body_by(Remedy::envelope, material);
    REQUIRE(body);
    const double volume = enclosed_volume(parts[0]) + enclosed_volume(parts[1]);
    CHECK(std::pow(body->similarity.scale, 3) * enclosed_volume(body->mesh) == Approx(volume).epsilon(0.06));
}

TEST_CASE("parts far apart, and crumbs, stay apart") {
    CHECK(bridges_between<double>({}).empty());
    CHECK(bridges_between<double>({trunk()}).empty());
    CHECK(bridges_between<double>({trunk(), moved_by(limb(), Vec3(0, 0, 1.8))}).empty());
    CHECK(bridges_between<double>({trunk(), moved_by(sphere(0.05, 2), Vec3(0, 0, 1))}).empty());
}
