#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/synth/sets.hpp>

#include "catch.hpp"

using namespace skelgen;

namespace {

/// Undirected edges and the number of their faces.
std::map<std::pair<int, int>, int> edges_of(const TriangleMesh<double>& mesh) {
    std::map<std::pair<int, int>, int> count;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) ++count[std::minmax({mesh.faces(f, k), mesh.faces(f, (k + 1) % 3)})];
    return count;
}

int euler(const TriangleMesh<double>& mesh) {
    return static_cast<int>(mesh.vertices.rows() - static_cast<Eigen::Index>(edges_of(mesh).size()) +
                            mesh.faces.rows());
}

bool is_closed(const TriangleMesh<double>& mesh) {
    for (const auto& [edge, faces] : edges_of(mesh))
        if (faces != 2) return false;
    return true;
}

BodyPlan planned(const std::string& set, const std::string& name) {
    for (const BodyPlan& plan : body_set(set, 1))
        if (plan.name == name) return plan;
    throw std::runtime_error("no plan " + name);
}

BodyPlan coarse(BodyPlan plan) {
    plan.faces = 6000;
    return plan;
}

} // namespace

TEST_CASE("the sets have their sizes, distinct names and the same plans for the same seed") {
    const std::map<std::string, std::size_t> sizes{{"scape", 71}, {"faust", 100}};
    for (const auto& [name, size] : sizes) {
        const auto plans = body_set(name, 1), again = body_set(name, 1), other = body_set(name, 2);
        REQUIRE(plans.size() == size);
        std::set<std::string> names;
        int moved = 0;
        for (std::size_t i = 0; i < size; ++i) {
            names.insert(plans[i].name);
            CHECK(plans[i].pose.at(BodyJoint::left_knee).bend == again[i].pose.at(BodyJoint::left_knee).bend);
            moved += plans[i].pose.at(BodyJoint::left_knee).bend != other[i].pose.at(BodyJoint::left_knee).bend;
        }
        CHECK(names.size() == size);
        CHECK(moved > 10); // the random poses
    }
}

TEST_CASE("an unknown set is refused with the known ones") {
    try {
        (void)body_set("giraffes", 0);
        FAIL("accepted");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
        for (const std::string& name : set_names()) CHECK(std::string(error.what()).find(name) != std::string::npos);
    }
}

TEST_CASE("what is missing is not in the mesh and the truth says so") {
    const BodyPlan plan = coarse(planned("partial", "no-feet-a"));
    BodyPlan whole = plan;
    whole.missing.clear();
    const SynthBody cut = synthesize_body(plan), full = synthesize_body(whole);
    const auto height = [](const SynthBody& body) { return body.mesh.vertices.col(2).maxCoeff(); };
    CHECK(height(full) - height(cut) > 0.03);
    CHECK(is_closed(cut.mesh));
    CHECK(euler(cut.mesh) == 2);
    CHECK(cut.truth.missing == std::vector<BodyJoint>{BodyJoint::left_foot, BodyJoint::right_foot});
    CHECK(cut.truth.end_points.size() == 3);
    const auto json = nlohmann::json::parse(truth_to_json(cut.truth, "x.off"));
    CHECK(json["missing"].size() == 2);
    CHECK(json["joints"].size() == 21);
    CHECK(json["markers"].size() == 11);
    CHECK(json["scale"].get<double>() == cut.truth.geodesic_diameter);
    CHECK(nlohmann::json::parse(truth_to_json(full.truth, "x.off")).count("missing") == 0);
}

TEST_CASE("joined parts make handles, in a closed mesh") {
    const SynthBody body = synthesize_body(coarse(planned("joined", "hands-on-waist-man")));
    CHECK(is_closed(body.mesh));
    CHECK(euler(body.mesh) <= -2); // a handle for each arm
}

TEST_CASE("scan faults are what they are called") {
    const SynthBody clean = synthesize_body({}, named_pose("a"), 5000);
    const auto faulty = [&](const ScanFaults& faults) { return with_scan_faults(clean.mesh, faults); };
    CHECK(faulty({}).faces == clean.mesh.faces);

    ScanFaults noise;
    noise.noise = 0.001;
    const TriangleMesh<double> rough = faulty(noise);
    const double moved = (rough.vertices - clean.mesh.vertices).rowwise().norm().mean();
    CHECK(moved == Approx(0.001 * std::sqrt(2 / 3.14159265)).epsilon(0.05)); // mean of |normal|

    ScanFaults holes;
    holes.holes = 5;
    CHECK(!is_closed(faulty(holes)));
    CHECK(faulty(holes).faces.rows() < clean.mesh.faces.rows());

    ScanFaults floating;
    floating.floating_pieces = 3;
    CHECK(faulty(floating).faces.rows() > clean.mesh.faces.rows());

    ScanFaults flipped;
    flipped.flipped_patches = 3;
    CHECK(is_closed(faulty(flipped)));
    CHECK(faulty(flipped).faces != clean.mesh.faces);

    ScanFaults pinched;
    pinched.pinched_vertices = 4;
    CHECK(euler(faulty(pinched)) == 2 - 4);
    CHECK(faulty(pinched).vertices.rows() == clean.mesh.vertices.rows() - 4);
}
