#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/synth/objects.hpp>
#include <skelgen/synth/sets.hpp>

#include "catch.hpp"
#include "synth/kinematics.hpp"

using namespace skelgen;
using namespace skelgen::synth;

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
    plan.faces = 5000;
    return plan;
}

} // namespace

TEST_CASE("the sets have their sizes, distinct names and the same plans for the same seed") {
    const std::map<std::string, std::size_t> sizes{{"scape", 71}, {"faust", 100}, {"cartoon", 24}, {"mouths", 9}};
    for (const auto& [name, size] : sizes) {
        const auto plans = body_set(name, 1), again = body_set(name, 1), other = body_set(name, 2);
        REQUIRE(plans.size() == size);
        std::set<std::string> names;
        int moved = 0;
        for (std::size_t i = 0; i < size; ++i) {
            names.insert(plans[i].name);
            CHECK(plans[i].pose.at(BodyJoint::left_knee).bend == again[i].pose.at(BodyJoint::left_knee).bend);
            const auto differs = [&](BodyJoint joint) {
                return plans[i].pose.at(joint).bend != other[i].pose.at(joint).bend;
            };
            moved += differs(BodyJoint::left_knee) || differs(BodyJoint::left_elbow);
        }
        CHECK(names.size() == size);
        CHECK(moved > 5); // the random poses
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
    SynthBody cut = synthesize_body(coarse(planned("partial", "no-feet-a")));
    CHECK(cut.truth.joints[static_cast<std::size_t>(BodyJoint::left_foot)].z() < 0); // it stands on its stumps
    CHECK(is_closed(cut.mesh));
    CHECK(euler(cut.mesh) == 2);
    CHECK(cut.truth.missing == std::vector<BodyJoint>{BodyJoint::left_foot, BodyJoint::right_foot});
    CHECK(cut.truth.end_points.size() == 3);
    const auto json = nlohmann::json::parse(truth_to_json(cut.truth, "x.off"));
    CHECK(json["missing"].size() == 2);
    CHECK(json["joints"].size() == 21);
    CHECK(json["markers"].size() == 11);
    CHECK(json["scale"].get<double>() == cut.truth.geodesic_diameter);
    cut.truth.missing.clear();
    CHECK(nlohmann::json::parse(truth_to_json(cut.truth, "x.off")).count("missing") == 0);
}

TEST_CASE("joined parts make handles, in a closed mesh") {
    const SynthBody body = synthesize_body(coarse(planned("joined", "hands-on-waist-man")));
    CHECK(is_closed(body.mesh));
    CHECK(euler(body.mesh) <= -2); // a handle for each arm
}

TEST_CASE("clothes change the surface and not the joints") {
    const BodyPlan plan = coarse(planned("dressed", "winter-a"));
    const SynthBody dressed = synthesize_body(plan);
    CHECK(is_closed(dressed.mesh));
    CHECK(euler(dressed.mesh) == 2);
    const double weight = complete_shape(plan.shape).weight;
    CHECK(1000 * core::enclosed_volume(dressed.mesh) > 1.4 * weight); // kilograms and litres of the naked body
    const auto height = dressed.mesh.vertices.col(2).maxCoeff();
    CHECK(height > complete_shape(plan.shape).height + 0.04); // the hat, the boots' soles
    const auto naked = synth::pose_skeleton(synth::proportions_of(plan.shape), plan.pose);
    for (int j = 1; j < body_joint_count; ++j) {
        const auto joint = static_cast<BodyJoint>(j);
        const Vector3<double> offset = dressed.truth.joints[static_cast<std::size_t>(j)] - dressed.truth.joints[0];
        CHECK((offset - (naked.position(joint) - naked.position(BodyJoint::crotch))).norm() < 1e-9);
    }
}

TEST_CASE("cartoons have heads, limbs, hands and feet of their own sizes") {
    const auto rest = [](const BodyShape& shape) { return synth::pose_skeleton(synth::proportions_of(shape), {}); };
    const auto length = [&rest](const BodyShape& shape, BodyJoint from, BodyJoint to) {
        const synth::PosedSkeleton skeleton = rest(shape);
        return (skeleton.position(to) - skeleton.position(from)).norm();
    };
    BodyShape figure;
    figure.height = 1.2, figure.head_size = 2.4, figure.leg_length = 0.5, figure.torso_length = 0.85;
    figure.hand_size = 1.5, figure.foot_size = 1.4, figure.limb_girth = 1.2;
    BodyShape even = figure;
    even.hand_size = even.foot_size = even.limb_girth = 1;
    CHECK(length(figure, BodyJoint::left_wrist, BodyJoint::left_hand) ==
          Approx(1.5 * length(even, BodyJoint::left_wrist, BodyJoint::left_hand)));
    const auto share_of_foot = [&](const BodyShape& shape) {
        return length(shape, BodyJoint::left_ankle, BodyJoint::left_foot) /
               length(shape, BodyJoint::left_knee, BodyJoint::left_ankle);
    };
    CHECK(share_of_foot(figure) == Approx(1.4 * share_of_foot(even)));

    const SynthBody body = synthesize_body(figure, spread_limbs(figure, named_pose("a")), 5000);
    CHECK(is_closed(body.mesh));
    CHECK(euler(body.mesh) == 2);
    const double height = body.mesh.vertices.col(2).maxCoeff();
    const double neck = body.truth.joints[static_cast<std::size_t>(BodyJoint::neck)].z();
    CHECK(height - neck > height / 3); // the head with the neck below it
    const SynthBody thin = synthesize_body(even, spread_limbs(even, named_pose("a")), 5000);
    CHECK(core::enclosed_volume(body.mesh) > 1.04 * core::enclosed_volume(thin.mesh));
}

TEST_CASE("horns, mittens and a tail are part of one surface") {
    BodyPlan plan = coarse(planned("cartoon", "horns-a"));
    plan.clothes.push_back(Garment::tail);
    const SynthBody costumed = synthesize_body(plan);
    CHECK(is_closed(costumed.mesh));
    CHECK(euler(costumed.mesh) == 2);
    plan.clothes.clear();
    const SynthBody bare = synthesize_body(plan);
    const double h = synth::proportions_of(plan.shape).head_scale, k = synth::proportions_of(plan.shape).scale;
    CHECK(costumed.mesh.vertices.col(2).maxCoeff() > bare.mesh.vertices.col(2).maxCoeff() + 0.08 * h);
    CHECK(costumed.mesh.vertices.col(1).maxCoeff() > bare.mesh.vertices.col(1).maxCoeff() + 0.4 * k);
    CHECK((costumed.truth.joints.front() - bare.truth.joints.front()).norm() < 1e-3); // both stand on a vertex
}

TEST_CASE("what a hand holds is part of one surface, and reaches far from the body") {
    for (const char* name : {"shepherd-a", "fencer-a", "woodman-a"}) {
        BodyPlan plan = coarse(planned("armed", name));
        const SynthBody armed = synthesize_body(plan);
        CHECK(is_closed(armed.mesh));
        CHECK(euler(armed.mesh) == 2);
        plan.clothes.clear();
        const SynthBody bare = synthesize_body(plan);
        double farthest = 0; // of what is held, from the body
        for (Eigen::Index v = 0; v < armed.mesh.vertices.rows(); v += 5)
            farthest = std::max(
                farthest, (bare.mesh.vertices.rowwise() - armed.mesh.vertices.row(v)).rowwise().norm().minCoeff());
        CHECK(farthest > 0.25 * synth::proportions_of(plan.shape).scale);
        CHECK((armed.truth.joints.front() - bare.truth.joints.front()).norm() < 0.05); // soles: boots have others
    }
}

TEST_CASE("an open mouth is a cavity of the same closed body, from the lips inwards") {
    BodyPlan plan = planned("mouths", "man-shouting");
    const SynthBody open = synthesize_body(plan);
    plan.shape.mouth = 0;
    const SynthBody closed = synthesize_body(plan);
    CHECK(is_closed(open.mesh));
    CHECK(euler(open.mesh) == 2);
    const double litres = 1000 * (core::enclosed_volume(closed.mesh) - core::enclosed_volume(open.mesh));
    CHECK(litres > 0.05);
    CHECK(litres < 0.3);
    const auto head = static_cast<std::size_t>(BodyJoint::head);
    CHECK((open.truth.joints[head] - closed.truth.joints[head]).norm() < 1e-3); // both stand on a vertex
}

TEST_CASE("curled bodies touch, or are as near as planned") {
    for (const BodyPlan& plan : body_set("curled", 1)) {
        INFO(plan.name);
        CHECK_NOTHROW(check_pose(plan.pose));
        const double gap = limb_clearance(plan.shape, plan.pose);
        if (plan.name.ends_with("-joined"))
            CHECK(gap < 0);
        else
            CHECK(gap == Approx(0.004).margin(0.015)); // a step of the joint is so far
    }
    const SynthBody hugging = synthesize_body(coarse(planned("curled", "hands-on-shoulders-joined")));
    CHECK(is_closed(hugging.mesh));
    CHECK(euler(hugging.mesh) <= -2); // a handle for each arm
}

TEST_CASE("every garment has a name, and others are refused") {
    CHECK(garment_names().size() == 22);
    CHECK(named_garment("long-hair") == Garment::long_hair);
    try {
        (void)named_garment("toga");
        FAIL("accepted");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
        CHECK(std::string(error.what()).find("skirt") != std::string::npos);
    }
}

TEST_CASE("objects are closed meshes of their kind") {
    const TriangleMesh<double> torus = synthesize_object("torus", 5000), chair = synthesize_object("chair", 5000);
    CHECK(is_closed(torus));
    CHECK(euler(torus) == 0);
    // 2 pi^2 R r^2, of the radii in the field
    CHECK(core::enclosed_volume(torus) == Approx(2 * 9.8696 * 0.5 * 0.18 * 0.18).epsilon(0.02));
    CHECK(is_closed(chair));
    CHECK(euler(chair) == 0); // the gap below the back rest
    const auto truth = nlohmann::json::parse(object_truth_to_json("not-a-body/chair.off"));
    CHECK(truth["not_a_body"] == true);
    CHECK(truth.count("joints") == 0);
    CHECK_THROWS_AS(synthesize_object("giraffe", 5000), Error);
    CHECK_THROWS_AS(synthesize_object("chair", 50), Error);
}

TEST_CASE("all objects are closed meshes", "[.slow]") {
    for (const std::string& name : object_names()) {
        INFO(name);
        CHECK(is_closed(synthesize_object(name, 8000)));
    }
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
