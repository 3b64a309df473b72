#include <skelgen/applications/measurement.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/io/truth_json.hpp>

#include "applications/sample_body.hpp"
#include "catch.hpp"
#include "mesh_changes.hpp"

using namespace skelgen;
using namespace skelgen::applications;
using namespace skelgen::test;

namespace {

Measurements measured(const TriangleMesh<double>& mesh) {
    const Extraction<double> found = extract(mesh);
    const KinematicSkeleton<double>& skeleton = found.skeleton;
    return measure(found.body, skeleton, segment(found.body, skeleton));
}

double length_of(const Measurements& measures, const std::string& name) {
    for (const auto& [found, value] : measures.lengths)
        if (found == name) return value;
    FAIL("no length " << name);
    return 0;
}

double girth_of(const Measurements& measures, const std::string& name) {
    for (const auto& [found, value] : measures.girths)
        if (found == name && value) return *value;
    FAIL("no girth " << name);
    return 0;
}

} // namespace

TEMPLATE_TEST_CASE("measurement: a tape around a circle, and over the hollow of an L", "[applications]", float,
                   double) {
    using Scalar = TestType;
    const Vector3<Scalar> normal = Vector3<Scalar>(1, 2, 2) / 3;
    const Vector3<Scalar> u = normal.unitOrthogonal(), v = normal.cross(u);
    std::vector<Vector3<Scalar>> circle;
    constexpr int corners = 64;
    for (int i = 0; i < corners; ++i) {
        const Scalar angle = 2 * std::numbers::pi_v<Scalar> * Scalar(i) / corners;
        circle.push_back(Scalar(3) * (std::cos(angle) * u + std::sin(angle) * v) + normal);
    }
    const double chord = 2 * 3 * std::sin(std::numbers::pi / corners);
    CHECK(tape_length(circle, normal) == Approx(corners * chord).epsilon(1e-5));

    const std::vector<Vector3<Scalar>> angle{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    CHECK(tape_length<Scalar>(angle, Vector3<Scalar>::UnitZ()) == Approx(2 + 1 + std::sqrt(2.0) + 1 + 2).epsilon(1e-6));
    CHECK(tape_length<Scalar>({{1, 1, 1}}, Vector3<Scalar>::UnitZ()) == 0);
    CHECK(tape_length<Scalar>({}, Vector3<Scalar>::UnitZ()) == 0);
    CHECK(tape_length<Scalar>({{0, 0, 0}, {1, 0, 0}}, Vector3<Scalar>::UnitZ()) == Approx(2)); // there and back
}

TEST_CASE("measurement: a walking man by what is known of him", "[applications]") {
    const TriangleMesh<double> mesh = sample_mesh();
    const Measurements measures = measured(mesh);
    // The generator's average man of 30 years is 1.757 m tall.
    CHECK(measures.height == Approx(1.757).epsilon(0.02));
    CHECK(measures.volume == Approx(core::enclosed_volume(mesh)).epsilon(1e-9));
    CHECK(measures.area == Approx(core::surface_area(mesh)).epsilon(1e-9));

    const io::GroundTruth truth = io::read_ground_truth(SKELGEN_DATA "/sample/body.json");
    const auto true_length = [&](const std::string& a, const std::string& b) {
        const auto at = [&](const std::string& name) {
            for (const auto& [joint, place] : truth.joints)
                if (joint == name) return place;
            FAIL("no joint " << name);
            return Vector3<double>(0, 0, 0);
        };
        return (at(a) - at(b)).norm();
    };
    CHECK(length_of(measures, "left_thigh") == Approx(true_length("left_hip", "left_knee")).epsilon(0.06));
    CHECK(length_of(measures, "right_calf") == Approx(true_length("right_knee", "right_ankle")).epsilon(0.06));
    CHECK(length_of(measures, "left_upper_arm") == Approx(true_length("left_shoulder", "left_elbow")).epsilon(0.1));

    for (const std::string name : {"chest", "waist", "hip", "head", "neck"}) CHECK(girth_of(measures, name) > 0.25);
    CHECK(girth_of(measures, "chest") > girth_of(measures, "waist"));
    for (const std::string name : {"upper_arm", "forearm", "wrist", "thigh", "mid_thigh", "calf", "ankle"}) {
        INFO(name);
        CHECK(girth_of(measures, "left_" + name) == Approx(girth_of(measures, "right_" + name)).epsilon(0.05));
    }
    CHECK(girth_of(measures, "left_wrist") < girth_of(measures, "left_forearm"));
    CHECK(girth_of(measures, "left_ankle") < girth_of(measures, "left_calf"));
    CHECK(girth_of(measures, "left_calf") < girth_of(measures, "left_mid_thigh"));
}

TEST_CASE("measurement: in the input's unit, however the body is turned", "[applications]") {
    const TriangleMesh<double> mesh = sample_mesh();
    const Measurements metres = measured(mesh);
    const auto turn = random_rotation(7);
    const Measurements millimetres = measured(moved(mesh, {turn, 1000, Vector3<double>(1, 2, 3)}));
    CHECK(millimetres.height == Approx(1e3 * metres.height).epsilon(1e-6));
    CHECK(millimetres.arm_span == Approx(1e3 * metres.arm_span).epsilon(1e-6));
    CHECK(millimetres.area == Approx(1e6 * metres.area).epsilon(1e-6));
    CHECK(millimetres.volume == Approx(1e9 * metres.volume).epsilon(1e-6));
    for (std::size_t i = 0; i < metres.girths.size(); ++i) {
        INFO(metres.girths[i].first);
        REQUIRE(millimetres.girths[i].second.has_value() == metres.girths[i].second.has_value());
        REQUIRE(metres.girth_planes[i].has_value() == metres.girths[i].second.has_value());
        if (!metres.girths[i].second) continue;
        CHECK(*millimetres.girths[i].second == Approx(1e3 * *metres.girths[i].second).epsilon(1e-3));
        const auto& plane = metres.girth_planes[i].value();
        const auto& there = millimetres.girth_planes[i].value();
        CHECK(plane.normal.norm() == Approx(1));
        CHECK((there.normal - turn * plane.normal).norm() < 1e-3);
        CHECK((there.place - (1000 * (turn * plane.place) + Vector3<double>(1, 2, 3))).norm() < 20); // of sections
    }
}

TEST_CASE("measurement: a girth is the tape around the section by its plane", "[applications]") {
    const auto& [mesh, found, skeleton, body] = sample_body();
    const Measurements measures = measure(body, skeleton, segment(body, skeleton));
    REQUIRE(measures.girth_planes.size() == measures.girths.size());
    int looked_at = 0;
    for (std::size_t i = 0; i < measures.girths.size(); ++i) {
        const auto& [name, girth] = measures.girths[i];
        if (!girth || (!name.ends_with("mid_thigh") && !name.ends_with("calf") && name != "head")) continue;
        INFO(name);
        const GirthPlane& plane = measures.girth_planes[i].value();
        // Where the mesh's edges cross the plane, no farther from the place than the girth's own radius would reach.
        std::vector<Vector3<double>> crossings;
        for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
            for (int k = 0; k < 3; ++k) {
                const Vector3<double> a = core::point(mesh.vertices, mesh.faces(f, k)),
                                      b = core::point(mesh.vertices, mesh.faces(f, (k + 1) % 3));
                const double above = plane.normal.dot(a - plane.place), below = plane.normal.dot(b - plane.place);
                if ((above < 0) == (below < 0)) continue;
                const Vector3<double> crossing = a + above / (above - below) * (b - a);
                if ((crossing - plane.place).norm() < *girth / 4) crossings.push_back(crossing);
            }
        CHECK(tape_length(crossings, plane.normal) == Approx(*girth).epsilon(0.03));
        ++looked_at;
    }
    CHECK(looked_at == 5); // the head, and two of each leg, far from the other one
}

TEST_CASE("measurement: parts must be the body's own, of its bones", "[applications]") {
    const Extraction<double> found = extract(sample_mesh());
    const KinematicSkeleton<double>& skeleton = found.skeleton;
    CHECK_THROWS_AS(measure(found.body, skeleton, segment(found.body, skeleton, PartSet::body)), Error);
    CHECK_THROWS_AS(measure(found.body, skeleton, Segmentation()), Error);
}
