// Generated animals, whose joints are known by construction; a dog of them is looked for from the mesh to the skeleton.

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/synth/objects.hpp>
#include <skelgen/synth/quadrupeds.hpp>

#include "catch.hpp"
#include "synth/surface_mesher.hpp"

using namespace skelgen;
using namespace skelgen::synth;

namespace {

using Place = Vector3<double>;

/// The first of the animals is a standing dog.
const QuadrupedPlan& plan() {
    static const QuadrupedPlan dog = quadruped_plans(1, 1).front();
    return dog;
}

const TriangleMesh<double>& dog() {
    static const TriangleMesh<double> mesh = synthesize_quadruped(plan(), 6000);
    return mesh;
}

Place place_of(const std::vector<std::pair<std::string, Place>>& places, const std::string& name) {
    const auto found = std::find_if(places.begin(), places.end(), [&](const auto& each) { return each.first == name; });
    if (found == places.end()) throw std::runtime_error("no " + name);
    return found->second;
}

double extent_of(const TriangleMesh<double>& mesh) {
    return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).maxCoeff();
}

Extraction<double> found_in(const TriangleMesh<double>& mesh, bool or_quadruped = false) {
    ExtractOptions options;
    if (!or_quadruped) options.skeleton_template = builtin_template("quadruped");
    options.or_quadruped = or_quadruped;
    return extract_in(mesh, options);
}

void check_is_the_dog(const KinematicSkeleton<double>& skeleton, const Eigen::Isometry3d& moved) {
    CHECK(skeleton.template_name == "quadruped");
    const double extent = extent_of(dog());
    for (const std::string name : {"fore_lower", "fore_foot", "hind_lower", "hind_ankle", "hind_foot"})
        for (const std::string side : {"left_", "right_"}) {
            INFO(side + name);
            const int j = find_joint(skeleton, side + name);
            REQUIRE(j >= 0);
            const Place found = moved.inverse() * skeleton.joints[static_cast<std::size_t>(j)].position;
            CHECK((found - place_of(plan().joints, side + name)).norm() < 0.06 * extent);
        }
    CHECK((moved.linear().transpose() * skeleton.frame.forward).dot(-Place::UnitY()) > 0.95);
    const auto tip = std::find_if(skeleton.end_points.begin(), skeleton.end_points.end(),
                                  [](const auto& end) { return end.first == "tail_tip"; });
    REQUIRE(tip != skeleton.end_points.end());
    CHECK((moved.inverse() * tip->second - place_of(plan().end_points, "tail_tip")).norm() < 0.03 * extent);
    CHECK(skeleton.quality.sides_confidence > 0.5);
}

} // namespace

TEST_CASE("animals have distinct names, all poses, tails of all lengths or none, and are the same for the same seed") {
    const auto plans = quadruped_plans(1), again = quadruped_plans(1), other = quadruped_plans(2);
    REQUIRE(plans.size() == 40);
    std::set<std::string> names;
    std::size_t without_tail = 0, horned = 0;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        names.insert(plans[i].body.name);
        const Place head = place_of(plans[i].joints, "head");
        CHECK(head == place_of(again[i].joints, "head"));
        CHECK((head - place_of(other[i].joints, "head")).norm() > 1e-3);
        const std::size_t tail = plans[i].end_points.size() == 6 ? 4 : 0;
        CHECK(plans[i].joints.size() == 29 + tail);
        without_tail += tail == 0 ? 1 : 0;
        horned += plans[i].body.ends > 8 ? 1 : 0; // feet, head, tail or rump, ears
    }
    CHECK(names.size() == 40);
    CHECK(without_tail > 0);
    CHECK(without_tail < 15);
    CHECK(horned > 5);
    CHECK(quadruped_plans(1, 2)[1].body.strokes.front().line == plans[1].body.strokes.front().line);
}

TEST_CASE("animals have the template's joints, the left ones on their own left, and stand on the ground") {
    std::set<std::string> known;
    for (const TemplateJoint& joint : builtin_template("quadruped").joints) known.insert(joint.name);
    for (const QuadrupedPlan& each : quadruped_plans(1)) {
        INFO(each.body.name);
        for (const auto& [name, place] : each.joints) CHECK(known.count(name) == 1);
        const auto at = [&](const std::string& name) { return place_of(each.joints, name); };
        const Place forward = at("chest") - at("hips");
        const Place up =
            (at("left_fore_upper") + at("right_fore_upper") - at("left_fore_foot") - at("right_fore_foot") +
             at("left_hind_upper") + at("right_hind_upper") - at("left_hind_foot") - at("right_hind_foot"));
        for (const std::string joint : {"_fore_upper", "_fore_lower", "_hind_upper", "_hind_lower"})
            CHECK((at("left" + joint) - at("right" + joint)).dot(up.cross(forward)) > 0);
        CHECK(((at("left_hind_upper") + at("right_hind_upper")) / 2 - at("hips")).norm() < 1e-9);
        CHECK(forward.dot(at("head") - at("hips")) > 0);
        double lowest = 1;
        for (const TubeStroke& stroke : each.body.strokes)
            for (std::size_t i = 0; i < stroke.line.size(); ++i)
                lowest = std::min(lowest, stroke.line[i].z() - stroke.radii[i]);
        CHECK(lowest == Approx(0).margin(1e-9));
    }
}

TEST_CASE("a generated animal is a closed surface around its joints, its ends on it, and its truth says where") {
    for (const std::size_t i : {0, 9}) { // a dog; a bear that walks
        const QuadrupedPlan each = quadruped_plans(1, i + 1).back();
        INFO(each.body.name);
        const TriangleMesh<double> mesh = synthesize_quadruped(each, 6000);
        const Topology topology = topology_of(mesh);
        CHECK(topology.closed_manifold);
        CHECK(topology.components == 1);
        CHECK(topology.euler == 2);
        for (const auto& [name, place] : each.joints) {
            INFO(name);
            CHECK(std::abs(core::winding_number(mesh, place)) > 0.5);
        }
        for (const auto& [name, place] : each.end_points) {
            INFO(name);
            CHECK((mesh.vertices.rowwise() - place.transpose()).rowwise().norm().minCoeff() < 0.02 * extent_of(mesh));
        }
        const auto truth = nlohmann::json::parse(quadruped_truth_to_json(each, mesh, "x.off"));
        CHECK(truth["expect"] == "quadruped");
        CHECK(truth["scale"].get<double>() == extent_of(mesh));
        CHECK(truth["joints"].size() == each.joints.size());
        CHECK(truth["markers"].size() == 10 + (each.end_points.size() == 6 ? 1 : 0));
        CHECK(truth["markers"]["left_hind_knee"] == truth["joints"]["left_hind_lower"]);
    }
    CHECK_THROWS_AS(synthesize_quadruped(plan(), 50), Error);
}

TEST_CASE("the dog's legs, tail and sides are where they were made") {
    const bool or_quadruped = GENERATE(false, true); // named, or as one of two
    check_is_the_dog(found_in(dog(), or_quadruped).skeleton, Eigen::Isometry3d::Identity());
}

TEST_CASE("a dog that was turned and moved has its joints turned and moved") {
    Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
    moved.translate(Place(3, -8, 2)).rotate(Eigen::AngleAxisd(2.3, Place(0.3, -1, 0.6).normalized()));
    TriangleMesh<double> mesh = dog();
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        mesh.vertices.row(v) = (moved * Place(mesh.vertices.row(v).transpose())).transpose();
    check_is_the_dog(found_in(mesh).skeleton, moved);
}

TEST_CASE("a ring is no animal, and the refusal says what was looked for") {
    const TriangleMesh<double> ring = synthesize_object("torus", 5000);
    const auto what = [&](bool or_quadruped) -> std::string {
        try {
            static_cast<void>(found_in(ring, or_quadruped));
        } catch (const NoSkeleton& error) {
            return error.what();
        }
        return "found";
    };
    CHECK(what(false).rfind("no four-legged animal: ", 0) == 0);
    CHECK(what(true).rfind("neither a human body nor a four-legged animal: ", 0) == 0);
}
