#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/io/write_mesh.hpp>
#include <skelgen/synth/body.hpp>

#include "catch.hpp"
#include "synth/kinematics.hpp"

using namespace skelgen;
using namespace skelgen::synth;
using J = BodyJoint;
using Vec3 = Vector3<double>;

namespace {

struct Person {
    const char* name;
    BodyShape shape;
    BodyPose pose;
};

BodyShape shape(double age, double masculinity, double weight = 0) {
    BodyShape s;
    s.age = age, s.masculinity = masculinity, s.weight = weight;
    return s;
}

/// Every kind of body and most poses; the poses are spread as far as the body needs.
std::vector<Person> people() {
    std::vector<Person> list{{"man", shape(30, 1), named_pose("a")},
                             {"woman", shape(30, 0), named_pose("walk")},
                             {"child", shape(5, 0.5), named_pose("t")},
                             {"boy of ten", shape(10, 1), named_pose("run")},
                             {"heavy man", shape(40, 1, 125), named_pose("a")},
                             {"thin woman", shape(20, 0, 42), named_pose("one-leg-up")}};
    for (Person& person : list) person.pose = spread_limbs(person.shape, person.pose);
    return list;
}

std::vector<Person> twenty_people() {
    std::vector<Person> list = people();
    for (unsigned seed = 1; list.size() < 20; ++seed) {
        const BodyShape s = shape(5 + 4.0 * seed, (seed % 3) / 2.0);
        list.push_back({"random", s, random_free_pose(s, seed)});
    }
    return list;
}

/// How often every directed edge occurs.
std::map<std::pair<int, int>, int> directed_edges(const TriangleMesh<double>& mesh) {
    std::map<std::pair<int, int>, int> count;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) ++count[{mesh.faces(f, k), mesh.faces(f, (k + 1) % 3)}];
    return count;
}

Vec3 joint(const SynthBody& body, J j) { return body.truth.joints[static_cast<std::size_t>(j)]; }

/// Sections of the mesh by a plane: closed loops as lists of points, found by walking from face to face.
std::vector<std::vector<Vec3>> section(const TriangleMesh<double>& mesh, const Vec3& point, const Vec3& normal) {
    const Eigen::VectorXd height = (mesh.vertices.rowwise() - point.transpose()) * normal;
    std::map<std::pair<int, int>, std::vector<std::pair<int, int>>>
        next; // an edge that is cut -> the others of its faces
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        std::vector<std::pair<int, int>> cut;
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3);
            if ((height[a] < 0) != (height[b] < 0)) cut.push_back(std::minmax(a, b));
        }
        if (cut.size() == 2) next[cut[0]].push_back(cut[1]), next[cut[1]].push_back(cut[0]);
    }
    std::vector<std::vector<Vec3>> loops;
    while (!next.empty()) {
        std::vector<Vec3> loop;
        auto edge = next.begin()->first;
        for (auto found = next.find(edge); found != next.end(); found = next.find(edge)) {
            const auto [a, b] = edge;
            const double u = height[a] / (height[a] - height[b]);
            loop.push_back((1 - u) * mesh.vertices.row(a).transpose() + u * mesh.vertices.row(b).transpose());
            const std::vector<std::pair<int, int>> ways = found->second;
            next.erase(found);
            edge = next.count(ways[0]) > 0 ? ways[0] : ways.back();
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

/// Centroid of the area inside a loop in the plane with that normal, and the area.
std::pair<Vec3, double> centroid(const std::vector<Vec3>& loop, const Vec3& normal) {
    Vec3 weighted = Vec3::Zero();
    double area = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3 &a = loop[i] - loop[0], &b = loop[(i + 1) % loop.size()] - loop[0];
        const double twice = normal.dot(a.cross(b));
        area += twice / 2;
        weighted += twice / 2 * (a + b) / 3;
    }
    return {loop[0] + weighted / area, std::abs(area)};
}

/// Distance between a limb's axis at `fraction` of the bone and the centre of the section there.
double axis_offset(const SynthBody& body, J upper, J lower, double fraction) {
    const Vec3 a = joint(body, upper), b = joint(body, lower), on_axis = a + fraction * (b - a);
    const Vec3 normal = (b - a).normalized();
    double nearest = 1e9;
    for (const auto& loop : section(body.mesh, on_axis, normal))
        if (loop.size() > 2) nearest = std::min(nearest, (centroid(loop, normal).first - on_axis).norm());
    return nearest;
}

double height_of(const SynthBody& body) {
    return body.mesh.vertices.col(2).maxCoeff() - body.mesh.vertices.col(2).minCoeff();
}

void check_closed_body(int faces) {
    const SynthBody body = synthesize_body({}, named_pose("a"), faces);
    CHECK(std::abs(static_cast<double>(body.mesh.faces.rows()) - faces) <= 0.02 * faces);
    const auto edges = directed_edges(body.mesh);
    CHECK(std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
        return edge.second == 1 && edges.count({edge.first.second, edge.first.first}) == 1;
    }));
    CHECK(body.mesh.vertices.rows() - static_cast<Eigen::Index>(edges.size()) / 2 + body.mesh.faces.rows() == 2);
    CHECK(core::enclosed_volume(body.mesh) > 0.05);
    CHECK(body.mesh.vertices.col(2).minCoeff() == Approx(0).margin(1e-12));
}

/// Every joint is inside of the mesh, and every limb bone in the middle of its limb.
void check_joints(const Person& person) {
    struct Bone {
        J upper, lower;
        double from;
    };
    const std::vector<Bone> bones{{J::left_shoulder, J::left_elbow, 0.55},
                                  {J::left_elbow, J::left_wrist, 0.3},
                                  {J::left_hip, J::left_knee, 0.45},
                                  {J::left_knee, J::left_ankle, 0.3}};
    INFO(person.name << " of age " << person.shape.age);
    const SynthBody body = synthesize_body(person.shape, person.pose, 10000); // fine enough to be exact to 1 mm
    for (int j = 0; j < body_joint_count; ++j) {
        INFO(joint_name(static_cast<J>(j)));
        CHECK(core::winding_number<double>(body.mesh, joint(body, static_cast<J>(j))) == Approx(1).margin(1e-6));
    }
    const double tolerance = 0.003 * complete_shape(person.shape).height / 1.75;
    for (const Bone& bone : bones)
        for (const bool right : {false, true})
            for (const double fraction : {bone.from, 0.6, 0.75}) {
                const J upper = right ? mirrored_joint(bone.upper) : bone.upper;
                const J lower = right ? mirrored_joint(bone.lower) : bone.lower;
                INFO(joint_name(upper) << " at " << fraction);
                CHECK(axis_offset(body, upper, lower, fraction) < tolerance);
            }
}

void check_usage_error(const std::string& part, const std::function<void()>& call) {
    try {
        call();
        FAIL("no error for " << part);
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
        CHECK(std::string(error.what()).find(part) != std::string::npos);
    }
}

} // namespace

TEST_CASE("a synthetic body is watertight, manifold and without handles, with the faces asked for") {
    check_closed_body(5000);
    check_closed_body(64000); // beyond what is refined: subdivided
}

TEST_CASE("bodies of all sizes are watertight", "[.slow]") {
    for (const int faces : {13776, 24998, 250000}) check_closed_body(faces);
}

TEST_CASE("joints lie inside the mesh and limb axes run through the centres of the sections") {
    const std::vector<Person> all = people();
    for (const std::size_t i : {1, 4}) check_joints(all[i]); // a woman walking, a heavy man
}

TEST_CASE("joints lie inside the mesh and limb axes in the middle for twenty people", "[.slow]") {
    for (const Person& person : twenty_people()) check_joints(person);
}

TEST_CASE("bones have the same lengths in every pose") {
    const synth::Proportions proportions = synth::proportions_of({});
    const synth::PosedSkeleton rest = synth::pose_skeleton(proportions, named_pose("t"));
    const synth::PosedSkeleton moved = synth::pose_skeleton(proportions, named_pose("run"));
    for (int j = 1; j < body_joint_count; ++j) {
        const auto child = static_cast<J>(j);
        const double before = (rest.position(child) - rest.position(joint_parent(child))).norm();
        CHECK((moved.position(child) - moved.position(joint_parent(child))).norm() == Approx(before).epsilon(1e-12));
    }
}

TEST_CASE("the same arguments give the same bytes") {
    const auto bytes = [] {
        const SynthBody body = synthesize_body({}, random_free_pose({}, 7), 5000);
        return io::format_mesh(body.mesh, io::MeshFormat::off) + truth_to_json(body.truth, "body.off");
    };
    const bool same = bytes() == bytes(); // not in the CHECK: it would print the files
    CHECK(same);
}

TEST_CASE("the mirrored pose has the mirrored joints") {
    const synth::Proportions proportions = synth::proportions_of({});
    const synth::PosedSkeleton body = synth::pose_skeleton(proportions, named_pose("walk"));
    const synth::PosedSkeleton mirror = synth::pose_skeleton(proportions, mirrored(named_pose("walk")));
    for (int j = 0; j < body_joint_count; ++j) {
        const Vec3 there = body.position(static_cast<J>(j));
        CHECK((Vec3(-there.x(), there.y(), there.z()) - mirror.position(mirrored_joint(static_cast<J>(j)))).norm() <
              1e-12);
    }
}

TEST_CASE("a standing body has the height asked for and its left on +x, its toes and nose on -y") {
    constexpr double height = 1.1;
    BodyShape tall;
    tall.height = height;
    const SynthBody body = synthesize_body(tall, named_pose("arms-down"), 5000);
    CHECK(height_of(body) == Approx(height).epsilon(0.01));
    CHECK(joint(body, J::left_hand).x() > 0.1 * height);
    CHECK(joint(body, J::left_foot).y() < joint(body, J::left_ankle).y() - 0.05 * height);
    CHECK(body.mesh.vertices.col(1).minCoeff() < joint(body, J::head).y() - 0.05 * height);
    CHECK(body.truth.geodesic_diameter > 1.05 * height);
    CHECK(body.truth.geodesic_diameter < 1.6 * height);
}

TEST_CASE("weight makes a body larger, and mass near the weight asked for") {
    double before = 0;
    for (const double weight : {50.0, 125.0}) {
        const BodyShape s = shape(35, 1, weight);
        const SynthBody body = synthesize_body(s, spread_limbs(s, named_pose("a")), 5000);
        const double volume = core::enclosed_volume(body.mesh);
        CHECK(volume > before);
        CHECK(1000 * volume == Approx(weight).epsilon(0.2)); // a litre weighs about a kilogram
        before = volume;
    }
}

TEST_CASE("end points are vertices at the ends of the body") {
    const SynthBody body = synthesize_body({}, named_pose("a"), 5000);
    REQUIRE(body.truth.end_points.size() == 5);
    std::map<std::string, Vec3> at(body.truth.end_points.begin(), body.truth.end_points.end());
    CHECK(at["head_top"].z() == Approx(height_of(body)).margin(0.005));
    CHECK(at["left_fingertip"].x() == Approx(body.mesh.vertices.col(0).maxCoeff()).margin(0.02));
    CHECK(at["right_fingertip"].x() == Approx(body.mesh.vertices.col(0).minCoeff()).margin(0.02));
    CHECK(at["left_toe"].y() < joint(body, J::left_foot).y());
    CHECK(at["right_toe"].z() < 0.04);
}

TEST_CASE("parameters out of range are refused with the range") {
    const auto make = [](const auto& change) {
        BodyShape s;
        change(s);
        check_shape(s);
    };
    check_usage_error("5 to 90", [&] { make([](BodyShape& s) { s.age = -3; }); });
    check_usage_error("0.8 to 2.3", [&] { make([](BodyShape& s) { s.height = 17; }); });
    check_usage_error("0 to 1", [&] { make([](BodyShape& s) { s.muscle = 2; }); });
    check_usage_error("closed to open", [&] { make([](BodyShape& s) { s.mouth = 1.5; }); });
    check_usage_error("kg at this height", [&] { make([](BodyShape& s) { s.weight = 5; }); });
    check_usage_error("0.3 to 1.5", [&] { make([](BodyShape& s) { s.leg_length = std::nan(""); }); });
    check_usage_error("5000 to 3000000", [] { (void)synthesize_body({}, {}, 10); });
    check_usage_error("arms-crossed", [] { (void)named_pose("yoga"); });
    check_usage_error("0 to 150 degrees", [] { (void)parse_pose(R"({"left_elbow": [-40, 0, 0]})"); });
    BodyPose fused;
    fused.at(J::left_shoulder).side = -20;
    check_usage_error("spread the limbs", [&] { (void)synthesize_body({}, fused, 5000); });
}
