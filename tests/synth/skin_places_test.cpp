#include <skelgen/synth/skin_places.hpp>

#include <cmath>
#include <optional>

#include <skelgen/core/geometry.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::synth;
using J = BodyJoint;
using Vec3 = Vector3<double>;

namespace {

struct PlacedPerson {
    BodyPlan plan;
    SynthBody body;
    SkinPlaces places;

    explicit PlacedPerson(BodyPlan given) : plan(std::move(given)), body(synthesize_body(plan)), places(plan, body) {}
    [[nodiscard]] Vec3 joint(J which) const { return body.truth.joints[static_cast<std::size_t>(which)]; }
    [[nodiscard]] Vec3 vertex(Eigen::Index v) const { return core::point(body.mesh.vertices, v); }
};

BodyPlan placed_plan(const BodyShape& shape, const char* pose) {
    BodyPlan plan;
    plan.shape = shape, plan.pose = spread_limbs(shape, named_pose(pose)), plan.faces = 6000;
    return plan;
}

BodyShape shape_of_age(double age, double weight) {
    BodyShape shape;
    shape.age = age, shape.weight = weight;
    return shape;
}

} // namespace

TEST_CASE("skin places: a body's own places lead back to where they are") {
    const PlacedPerson man(placed_plan(BodyShape{}, "walk"));
    Eigen::Index known = 0;
    for (Eigen::Index v = 0; v < man.body.mesh.vertices.rows(); v += 3) {
        const std::optional<SkinPlace> place = man.places.place_of(man.vertex(v));
        if (!place) continue;
        const std::optional<Vec3> back = man.places.point_at(*place);
        if (!back) continue;
        ++known;
        CHECK((*back - man.vertex(v)).norm() < 0.02);
    }
    CHECK(static_cast<double>(3 * known) >
          0.7 * static_cast<double>(man.body.mesh.vertices.rows())); // but for fingers and seams
}

TEST_CASE("skin places: what is rigid keeps its distances to its joints in another pose") {
    const PlacedPerson walking(placed_plan(BodyShape{}, "walk")), standing(placed_plan(BodyShape{}, "a"));
    int compared = 0;
    for (Eigen::Index v = 0; v < walking.body.mesh.vertices.rows(); v += 2) {
        const std::optional<SkinPlace> place = walking.places.place_of(walking.vertex(v));
        if (!place || place->side != 1 || place->along < 0.2 || place->along > 0.8) continue;
        const double to_knee = (walking.vertex(v) - walking.joint(J::left_knee)).norm();
        if (to_knee > 0.3 || walking.vertex(v).z() > walking.joint(J::left_knee).z()) continue; // a calf's
        const std::optional<Vec3> there = standing.places.point_at(*place);
        REQUIRE(there);
        ++compared;
        CHECK((*there - standing.joint(J::left_knee)).norm() == Approx(to_knee).margin(0.004));
    }
    CHECK(compared > 20);
}

TEST_CASE("skin places: a mirrored body has the same places on the other side") {
    BodyPlan plan = placed_plan(BodyShape{}, "walk"), mirror = plan;
    mirror.pose = mirrored(plan.pose);
    const PlacedPerson person(plan), image(mirror);
    int sided = 0;
    for (Eigen::Index v = 0; v < person.body.mesh.vertices.rows(); v += 7) {
        Vec3 p = person.vertex(v);
        const std::optional<SkinPlace> place = person.places.place_of(p);
        p.x() = -p.x();
        p.z() += image.joint(J::crotch).z() - person.joint(J::crotch).z(); // they stand on vertices of their own
        const std::optional<SkinPlace> other = image.places.place_of(p);
        if (!place || !other || place->side == 0) continue;
        ++sided;
        CHECK(other->side == -place->side);
        CHECK(other->along == Approx(place->along).margin(1e-6));
        CHECK((other->from_bone - place->from_bone).norm() < 1e-6);
    }
    CHECK(sided > 100);
}

TEST_CASE("skin places: a child's wrist is a heavy man's wrist") {
    const PlacedPerson child(placed_plan(shape_of_age(6, 0), "t")), man(placed_plan(shape_of_age(45, 130), "a"));
    int compared = 0;
    for (Eigen::Index v = 0; v < child.body.mesh.vertices.rows(); ++v) {
        if ((child.vertex(v) - child.joint(J::left_wrist)).norm() > 0.04) continue;
        const std::optional<SkinPlace> place = child.places.place_of(child.vertex(v));
        if (!place) continue;
        CHECK(place->side == 1);
        const std::optional<Vec3> there = man.places.point_at(*place);
        if (!there) continue;
        ++compared;
        CHECK((*there - man.joint(J::left_wrist)).norm() < 0.08);
    }
    CHECK(compared > 5);
}

TEST_CASE("skin places: nothing is known of the air, of fingers and of limbs that are missing") {
    BodyPlan cut = placed_plan(BodyShape{}, "a");
    cut.missing = {J::left_wrist};
    const PlacedPerson person(placed_plan(BodyShape{}, "a")), stump(cut);
    CHECK_FALSE(person.places.place_of({0, 0, 3}));
    for (const auto& [name, tip] : person.body.truth.end_points)
        if (name.ends_with("fingertip")) CHECK_FALSE(person.places.place_of(tip));
    for (Eigen::Index v = 0; v < person.body.mesh.vertices.rows(); ++v) {
        const std::optional<SkinPlace> place = person.places.place_of(person.vertex(v));
        if (!place || (person.vertex(v) - person.joint(J::left_hand)).norm() > 0.02) continue;
        CHECK_FALSE(stump.places.point_at(*place));
    }
}
