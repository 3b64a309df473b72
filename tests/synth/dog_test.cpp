// The generated dog, whose joints are known by construction: looked for as an animal, from the mesh to the skeleton.

#include <algorithm>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/extract.hpp>
#include <skelgen/synth/objects.hpp>

#include "catch.hpp"

using namespace skelgen;

namespace {

using Place = Vector3<double>;

/// It faces -y, up is z, its left +x; 1.2 m from nose to tail.
const TriangleMesh<double>& dog() {
    static const TriangleMesh<double> mesh = synth::synthesize_object("dog", 6000);
    return mesh;
}

/// Where its left legs' joints are, in its own axes.
const std::vector<std::pair<std::string, Place>> known_joints{{"fore_lower", {0.090, -0.20, 0.27}},
                                                              {"fore_foot", {0.090, -0.25, 0.03}},
                                                              {"hind_lower", {0.095, 0.20, 0.29}},
                                                              {"hind_ankle", {0.095, 0.32, 0.17}},
                                                              {"hind_foot", {0.095, 0.26, 0.03}}};

Extraction<double> found_in(const TriangleMesh<double>& mesh, bool or_quadruped = false) {
    ExtractOptions options;
    if (!or_quadruped) options.skeleton_template = builtin_template("quadruped");
    options.or_quadruped = or_quadruped;
    return extract_in(mesh, options);
}

void check_is_the_dog(const KinematicSkeleton<double>& skeleton, const Eigen::Isometry3d& moved) {
    CHECK(skeleton.template_name == "quadruped");
    for (const auto& [name, place] : known_joints)
        for (const std::string side : {"left_", "right_"}) {
            INFO(side + name);
            const int j = find_joint(skeleton, side + name);
            REQUIRE(j >= 0);
            const Place own(side == "left_" ? place.x() : -place.x(), place.y(), place.z());
            CHECK((moved.inverse() * skeleton.joints[static_cast<std::size_t>(j)].position - own).norm() < 0.06);
        }
    CHECK((moved.linear().transpose() * skeleton.frame.forward).dot(-Place::UnitY()) > 0.95);
    const auto tip = std::find_if(skeleton.end_points.begin(), skeleton.end_points.end(),
                                  [](const auto& end) { return end.first == "tail_tip"; });
    REQUIRE(tip != skeleton.end_points.end());
    CHECK((moved.inverse() * tip->second - Place(0, 0.59, 0.73)).norm() < 0.03);
    CHECK(skeleton.quality.sides_confidence > 0.5);
}

} // namespace

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

TEST_CASE("furniture is no animal, and the refusal says what was looked for") {
    const TriangleMesh<double> chair = synth::synthesize_object("chair", 6000);
    const auto what = [&](bool or_quadruped) -> std::string {
        try {
            static_cast<void>(found_in(chair, or_quadruped));
        } catch (const NoSkeleton& error) {
            return error.what();
        }
        return "found";
    };
    CHECK(what(false).rfind("no four-legged animal: ", 0) == 0);
    CHECK(what(true).rfind("neither a human body nor a four-legged animal: ", 0) == 0);
}
