#include <skelgen/synth/pieces.hpp>

#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <skelgen/core/geometry.hpp>
#include <skelgen/synth/sets.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "synth/surface_mesher.hpp"

using namespace skelgen;
using namespace skelgen::synth;

namespace {

using Mesh = TriangleMesh<double>;

BodyPlan planned(const std::string& name) {
    for (BodyPlan plan : body_set("pieces", 1))
        if (plan.name == name) {
            plan.faces = 5000;
            return plan;
        }
    throw std::runtime_error("no plan " + name);
}

/// The same body in one piece.
Mesh whole(BodyPlan plan) {
    plan.pieces = {};
    plan.clothes.clear();
    return synthesize_body(plan).mesh;
}

/// Edges of one face, by the positions of their ends, and how many of them are there.
std::map<std::pair<std::tuple<double, double, double>, std::tuple<double, double, double>>, int>
boundary(const Mesh& mesh) {
    const auto place = [&](int v) { return std::tuple(mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2)); };
    std::map<std::pair<int, int>, int> count;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) ++count[std::minmax({mesh.faces(f, k), mesh.faces(f, (k + 1) % 3)})];
    std::map<std::pair<std::tuple<double, double, double>, std::tuple<double, double, double>>, int> edges;
    for (const auto& [edge, faces] : count)
        if (faces == 1) ++edges[std::minmax(place(edge.first), place(edge.second))];
    return edges;
}

} // namespace

TEST_CASE("seams part the surface and leave it where it is") {
    const BodyPlan plan = planned("seams-a");
    const Mesh split = synthesize_body(plan).mesh, before = whole(plan);
    CHECK(split.faces.rows() == before.faces.rows());
    CHECK(core::enclosed_volume(split) == Approx(core::enclosed_volume(before)));
    CHECK(topology_of(split).components >= 28); // front and back of 14 limbs
    const auto seams = boundary(split);
    CHECK(seams.size() > 100);
    for (const auto& [edge, count] : seams) CHECK(count == 2); // both sides of the seam are there
}

TEST_CASE("a face has two eyes and two rows of teeth, closed, at the head") {
    const BodyPlan plan = planned("face-a");
    const SynthBody body = synthesize_body(plan);
    const Mesh before = whole(plan);
    CHECK(body.mesh.vertices.topRows(before.vertices.rows()) == before.vertices);
    CHECK(topology_of(body.mesh).components == 5);
    CHECK(test::is_closed(body.mesh.faces));
    const Vector3<double> head = body.truth.joints[static_cast<std::size_t>(BodyJoint::head)];
    const auto added = body.mesh.vertices.bottomRows(body.mesh.vertices.rows() - before.vertices.rows());
    CHECK((added.rowwise() - head.transpose()).rowwise().norm().maxCoeff() < 0.2);
    CHECK(core::enclosed_volume(body.mesh) > core::enclosed_volume(before)); // they look outwards
}

TEST_CASE("limbs are closed by themselves and overlap, or open where they are hidden") {
    BodyPlan plan = planned("closed-limbs-a");
    const Mesh closed = synthesize_body(plan).mesh;
    CHECK(topology_of(closed).components == 14);
    CHECK(test::is_closed(closed.faces));
    CHECK(core::enclosed_volume(closed) > core::enclosed_volume(whole(plan)));
    plan.pieces.limbs = LimbPieces::open;
    const Mesh open = synthesize_body(plan).mesh;
    CHECK(topology_of(open).components >= 14);
    CHECK_FALSE(test::is_closed(open.faces));
    CHECK(core::surface_area(open) < core::surface_area(closed));
}

TEST_CASE("clothes are open shells around the naked body") {
    const BodyPlan plan = planned("clothes-a");
    const SynthBody body = synthesize_body(plan);
    const Topology topology = topology_of(body.mesh);
    CHECK(topology.components >= 2);
    CHECK_FALSE(boundary(body.mesh).empty());
    BodyPlan dressed = plan, naked = plan;
    dressed.pieces = {};
    naked.pieces = {};
    naked.clothes.clear();
    const double shells = core::surface_area(body.mesh) - core::surface_area(synthesize_body(naked).mesh);
    CHECK(shells > 0);
    CHECK(shells < core::surface_area(synthesize_body(dressed).mesh));
}
