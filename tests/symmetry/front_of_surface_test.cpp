#include <cmath>
#include <cstddef>
#include <vector>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/symmetry/front_of_surface.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::symmetry;

namespace {

using Place = Vector3<double>;

/// A surface of small triangles of one size, each with its middle at a place.
Body<double> surface_of(const std::vector<Place>& places) {
    Body<double> body;
    const auto count = static_cast<Eigen::Index>(places.size());
    body.mesh.vertices.resize(3 * count, 3);
    body.mesh.faces.resize(count, 3);
    const double size = 1e-4;
    for (Eigen::Index f = 0; f < count; ++f)
        for (int k = 0; k < 3; ++k) {
            const double turn = 2 * 3.14159265358979 * k / 3;
            body.mesh.vertices.row(3 * f + k) =
                (places[static_cast<std::size_t>(f)] + size * Place(std::cos(turn), std::sin(turn), 0)).transpose();
            body.mesh.faces(f, k) = static_cast<int>(3 * f + k);
        }
    return body;
}

/// A body that faces z: its left is x, up is y.
refinement::RefinedJoints<double> joints_of_person() {
    const SkeletonTemplate& human = builtin_template("human21");
    refinement::RefinedJoints<double> out;
    out.positions.resize(static_cast<Eigen::Index>(human.joints.size()), 3);
    out.is_present.assign(human.joints.size(), true);
    for (int j = 0; j < static_cast<int>(human.joints.size()); ++j) {
        const double x = sign_of(human.joint(j).side);
        const auto place = [&]() -> Place {
            switch (human.joint(j).role) {
            case JointRole::knee:
                return {0.1 * x, 0.5, 0};
            case JointRole::ankle:
                return {0.1 * x, 0.1, 0};
            case JointRole::foot:
                return {0.1 * x, 0, 0.1};
            case JointRole::neck:
                return {0, 1.5, 0};
            case JointRole::head:
                return {0, 1.6, 0};
            default:
                return {0.1 * x, 1, 0};
            }
        };
        out.positions.row(j) = place().transpose();
    }
    return out;
}

/// On both legs: the surface of a shin about a place, and of a foot.
std::vector<Place> legs(double shin, const std::vector<double>& foot) {
    std::vector<Place> out;
    for (const double x : {-0.1, 0.1}) {
        for (const double off : {-0.03, 0.03}) out.emplace_back(x, 0.3, shin + off);
        for (const double z : foot) out.emplace_back(x, 0.05, z);
    }
    return out;
}

SurfaceFront<double> front_of(const std::vector<Place>& places) {
    return front_of_surface(surface_of(places), joints_of_person(), builtin_template("human21"));
}

} // namespace

TEST_CASE("soles lie before the shins by their middle over its spread") {
    const double of_one_foot = 0.075 / std::sqrt((0.05 * 0.05 + 0.1 * 0.1) / 2);
    CHECK((front_of(legs(0, {0.05, 0.1})).sole - Place(0, 0, 2 * of_one_foot)).norm() < 1e-4);
    CHECK((front_of(legs(0.02, {0.07, 0.12})).sole - Place(0, 0, 2 * of_one_foot)).norm() < 1e-4); // off the bone
    CHECK((front_of(legs(0, {-0.05, -0.1})).sole - Place(0, 0, -2 * of_one_foot)).norm() < 1e-4);
    CHECK(front_of(legs(0, {-0.05, 0.05})).sole.norm() < 1e-9);
    CHECK(front_of(legs(0, {})).sole.norm() == 0);
}

TEST_CASE("faces are where the head has more vertices than its surface says") {
    const Body<double> head = surface_of({{0, 1.62, -0.08}, {0, 1.62, 0.08}});
    const auto front_with = [&](const Body<double>& body, const Points<double>* vertices) {
        return front_of_surface(body, joints_of_person(), builtin_template("human21"), vertices).face;
    };
    CHECK(front_with(head, nullptr).norm() < 1e-9); // as many as the surface says
    Points<double> detailed(5, 3);
    detailed << 0, 1.62, 0.08, 0.01, 1.62, 0.08, -0.01, 1.62, 0.08, 0, 1.62, -0.08, 0, 0.2, -9; // the last: a foot's
    const Place expected(0, 0, 0.04 / core::bounding_diagonal(head.mesh.vertices));
    CHECK((front_with(head, &detailed) - expected).norm() < 1e-9);

    Body<double> elsewhere = head; // the same, given in other coordinates
    elsewhere.similarity.rotation = Eigen::AngleAxisd(0.7, Place(1, 2, 3).normalized()).toRotationMatrix();
    elsewhere.similarity.scale = 100;
    elsewhere.similarity.origin = {5, -3, 8};
    Points<double> given = detailed;
    for (Eigen::Index v = 0; v < given.rows(); ++v)
        given.row(v) = elsewhere.similarity.to_input(core::point(detailed, v)).transpose();
    CHECK((front_with(elsewhere, &given) - expected).norm() < 1e-9);
}

TEST_CASE("what is cut off shows no front") {
    std::vector<Place> all = legs(0, {0.05, 0.1});
    all.emplace_back(0, 1.62, 0.08);
    auto joints = joints_of_person();
    const SkeletonTemplate& human = builtin_template("human21");
    for (int j = 0; j < static_cast<int>(human.joints.size()); ++j) {
        const JointRole role = human.joint(j).role;
        if (role == JointRole::ankle || role == JointRole::head) joints.is_present[static_cast<std::size_t>(j)] = false;
    }
    const auto front = front_of_surface(surface_of(all), joints, human);
    CHECK(front.sole.norm() == 0);
    CHECK(front.face.norm() == 0);
}
