#include <string>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/manifold_parts.hpp>
#include <skelgen/surface/pieces.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::surface;
using namespace skelgen::test;

TEST_CASE("one piece without flat sides keeps all its faces") {
    const Mesh tube = capsule(0.3, 4);
    const BodyFaces body = faces_of_body(tube);
    CHECK(body.faces == tube.faces);
    CHECK(body.bodies == 1);
    CHECK(body.dropped_pieces == 0);
    CHECK(body.notes.empty());
}

TEST_CASE("a plate beside a body is left out, and so is what floats far away") {
    const Mesh tube = capsule(0.3, 4);
    const Mesh plate = moved_by(box(Vec3(2, 2, 0.05)), Vec3(-1, -1, -0.5)),
               speck = moved_by(sphere(0.05, 2), Vec3(3, 0, 2));
    const BodyFaces body = faces_of_body(side_by_side(side_by_side(tube, plate), speck));
    CHECK(body.faces == tube.faces);
    CHECK(body.dropped_pieces == 1);
    REQUIRE(body.notes.size() == 1);
    CHECK(body.notes[0] == "a plate left out");
}

TEST_CASE("a plate grown to a body is left out where the body has sunk through it, but not far") {
    const Mesh tube = capsule(0.3, 4);
    const double foot = tube.vertices.col(2).minCoeff();
    const auto kept = [&](double sunk) {
        const Mesh plate = box(Vec3(2, 2, 0.05));
        const double below = plate.vertices.col(2).minCoeff();
        const Vec3 way(-1, -1, foot + sunk - below);
        Mesh both = side_by_side(tube, moved_by(plate, way));
        const auto corner = static_cast<int>(tube.vertices.rows()); // a face from one to the other makes them one piece
        both.faces.conservativeResize(both.faces.rows() + 1, 3);
        both.faces.row(both.faces.rows() - 1) << corner, corner + 1, 0;
        return faces_of_body(both);
    };
    const BodyFaces body = kept(0.1);
    CHECK(body.notes == std::vector<std::string>{"a plate left out"});
    CHECK(body.stood_on_plate);
    CHECK(body.faces.maxCoeff() < tube.vertices.rows());
    CHECK(10 * body.faces.rows() > 9 * tube.faces.rows());
    CHECK(kept(0.5).notes.empty()); // a table's top, say
    CHECK_FALSE(kept(0.5).stood_on_plate);
}

TEST_CASE("a plate that toes reach past beside it is no floor") {
    const Mesh tube = capsule(0.3, 4);
    const Mesh toes = moved_by(sphere(0.2, 3), Vec3(0, -0.28, tube.vertices.col(2).minCoeff() + 0.2));
    const Mesh shield = moved_by(box(Vec3(1, 0.05, 1)), Vec3(-0.5, -0.36, 2));
    Mesh all = side_by_side(side_by_side(tube, toes), shield);
    const auto corner = static_cast<int>(all.vertices.rows() - shield.vertices.rows());
    all.faces.conservativeResize(all.faces.rows() + 1, 3);
    all.faces.row(all.faces.rows() - 1) << corner, corner + 1, 0; // makes the shield no piece of its own
    const BodyFaces body = faces_of_body(all);
    CHECK(body.notes.empty());
    CHECK(body.faces.rows() == all.faces.rows());
}

TEST_CASE("bodies apart are counted, and each can be had", "[slow]") {
    const Mesh tube = capsule(0.3, 4), other = moved_by(capsule(0.28, 4), Vec3(1, 0, 0));
    const Mesh both = side_by_side(tube, other);
    CHECK(faces_of_body(both).bodies == 2);
    CHECK(faces_of_body(both).all_things == both.faces);
    CHECK(faces_of_body(tube).all_things.rows() == 0); // nothing stands apart from it
    CHECK(faces_of_body(both, 1).faces == tube.faces);
    CHECK(faces_of_body(both, 2).faces == both.faces.bottomRows(other.faces.rows()));
    PrepareOptions options;
    options.component = 2;
    CHECK(gather(both).apart.has_value());
    CHECK_FALSE(gather(both, options).apart.has_value()); // who has chosen one wants it alone
    const CleanMesh<double> second = gather(both, options).clean;
    REQUIRE(second.mesh.vertices.rows() == other.vertices.rows());
    for (Eigen::Index v = 0; v < other.vertices.rows(); ++v)
        CHECK((second.similarity.to_input(point(second.mesh.vertices, v)) - point(other.vertices, v)).norm() < 1e-6);
    options.component = 3;
    REQUIRE_THROWS_WITH(gather(both, options), "there is no body number 3, only 2");
}

TEST_CASE("pieces that overlap or lie in each other are one body") {
    const Mesh tube = capsule(0.3, 4);
    CHECK(faces_of_body(side_by_side(tube, moved_by(tube, Vec3(0.3, 0, 0)))).bodies == 1);
    CHECK(faces_of_body(side_by_side(tube, capsule(0.25, 4))).bodies == 1);
}

TEST_CASE("what stands apart is bridged where the gap is narrower than it is thick, and else is not one body") {
    const auto bodies_across = [](double gap) {
        const Mesh tube = capsule(0.3, 4);
        const double height = tube.vertices.col(2).maxCoeff() - tube.vertices.col(2).minCoeff();
        const BodyMaterial<double> material = gather(side_by_side(tube, moved_by(tube, Vec3(0, 0, height + gap))));
        CHECK(material.bodies == 2);
        REQUIRE(material.remedies.back() == Remedy::bridged);
        return make_body_by(Remedy::bridged, material);
    };
    const Outcome<Body<double>> joined = bodies_across(0.2);
    REQUIRE(joined);
    CHECK(is_closed(joined->mesh.faces));
    CHECK(manifold_parts(joined->mesh).size() == 1);
    CHECK(joined->dropped_pieces == 0);
    CHECK(joined->repairs.back() == "gaps bridged between its parts: 1");
    const Outcome<Body<double>> apart = bodies_across(1.5);
    REQUIRE_FALSE(apart);
    CHECK(apart.failure().reason == Refusal::several_bodies);
}

TEST_CASE("a sound body has one remedy, pieces have an envelope first", "[slow]") {
    const Mesh tube = capsule(0.3, 4);
    CHECK(gather(tube).remedies == std::vector<Remedy>{Remedy::largest_piece, Remedy::rounded});
    CHECK(gather(subdivided(tube, 1)).remedies == std::vector<Remedy>{Remedy::largest_piece}); // fine enough
    const Mesh halves = side_by_side(tube, moved_by(tube, Vec3(0.02, 0.03, 3.01)));
    const BodyMaterial<double> material = gather(halves);
    REQUIRE(material.remedies.front() == Remedy::envelope);
    const Outcome<Body<double>> body = make_body_by(Remedy::envelope, material);
    REQUIRE(body);
    CHECK(is_closed(body->mesh.faces));
    CHECK(body->repairs.back() == "2 pieces joined into one surface");
    const double volume = pi * 0.3 * 0.3 * 7.01 + 4 * pi / 3 * 0.3 * 0.3 * 0.3;
    CHECK(std::pow(body->similarity.scale, 3) * enclosed_volume(body->mesh) == Approx(volume).epsilon(0.03));
    REQUIRE(body->nearest.size() == static_cast<std::size_t>(halves.vertices.rows()));
    // Only those inside the other half are far from the envelope, and by no more than the radius.
    for (Eigen::Index v = 0; v < halves.vertices.rows(); ++v) {
        const int place = body->nearest[static_cast<std::size_t>(v)];
        REQUIRE(place >= 0);
        const Vec3 there = body->similarity.to_input(point(body->mesh.vertices, place));
        REQUIRE((there - point(halves.vertices, v)).norm() < 0.35);
    }
}

TEST_CASE("an envelope is clustered to some twelve thousand faces, unless none are to be", "[slow]") {
    const BodyMaterial<double> material = gather(side_by_side(sphere(1, 3), moved_by(sphere(1, 3), Vec3(1, 0.1, 0))));
    REQUIRE(material.remedies.front() == Remedy::envelope);
    PrepareOptions as_found, few;
    as_found.most_faces = 0;
    few.most_faces = 4000;
    const auto made = [&](const PrepareOptions& options) { return *make_body_by(Remedy::envelope, material, options); };
    const Body<double> coarse = made({}), fine = made(as_found);
    CHECK(fine.mesh.faces.rows() > 24'000);
    CHECK(coarse.mesh.faces.rows() > 8'000);
    CHECK(coarse.mesh.faces.rows() < 16'000);
    CHECK(made(few).mesh.faces.rows() < 3'000);
    const auto volume = [](const Body<double>& body) {
        return std::pow(body.similarity.scale, 3) * enclosed_volume(body.mesh);
    };
    CHECK(volume(coarse) == Approx(volume(fine)).epsilon(0.005));
}

TEST_CASE("what is made of pieces does not depend on how they were turned", "[slow]") {
    const Mesh tube = capsule(0.3, 4), open = without_faces(moved_by(tube, Vec3(0.02, 0.03, 3.01)), 30, 40);
    const Mesh given = side_by_side(side_by_side(tube, open), moved_by(sphere(0.2, 2), Vec3(0.4, 0.1, 2)));
    const Mesh turned = moved(given, {random_rotation(4), 1, Vec3(3, -2, 1)});
    const BodyMaterial<double> one = gather(given), other = gather(turned);
    CHECK(one.remedies == other.remedies);
    REQUIRE(one.clean.mesh.faces == other.clean.mesh.faces);
    CHECK(one.clean.mesh.vertices == other.clean.mesh.vertices); // to the last bit: all places are rounded
    for (const Remedy remedy : one.remedies) {
        const Outcome<Body<double>> body = make_body_by(remedy, one), again = make_body_by(remedy, other);
        REQUIRE(body);
        REQUIRE(again);
        CHECK(body->mesh.vertices == again->mesh.vertices);
        CHECK(body->nearest == again->nearest);
        const Vec3 place = point(body->mesh.vertices, 7);
        const Vec3 there = random_rotation(4) * body->similarity.to_input(place) + Vec3(3, -2, 1);
        CHECK((again->similarity.to_input(place) - there).norm() < 1e-9);
    }
}

TEST_CASE("material that encloses nothing makes no body", "[slow]") {
    const Mesh sheet = make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}},
                                 {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    const Outcome<Body<double>> body = make_body_by(Remedy::envelope, gather(sheet));
    REQUIRE_FALSE(body);
    CHECK(body.failure().what == "no body: its 1 pieces enclose nothing; close its surface");
}
