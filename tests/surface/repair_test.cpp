// What puts a mesh's connectivity right without moving a vertex: welding, sound faces, orientation, holes.

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/clean.hpp>
#include <skelgen/surface/impl/fill_holes.hpp>
#include <skelgen/surface/impl/orientation.hpp>
#include <skelgen/surface/impl/sound_faces.hpp>
#include <skelgen/surface/prepare.hpp>
#include <skelgen/surface/weld.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::surface;
using namespace skelgen::test;

namespace {

/// Every face with three vertices of its own.
Mesh as_soup(const Mesh& mesh) {
    Mesh soup;
    soup.vertices.resize(mesh.faces.size(), 3);
    soup.faces.resize(mesh.faces.rows(), 3);
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) {
        soup.vertices.row(i) = mesh.vertices.row(mesh.faces.data()[i]);
        soup.faces.data()[i] = static_cast<int>(i);
    }
    return soup;
}

/// With more faces on vertices that are there.
Mesh with_faces(Mesh mesh, const std::vector<std::array<int, 3>>& more) {
    const Eigen::Index m = mesh.faces.rows();
    mesh.faces.conservativeResize(m + static_cast<Eigen::Index>(more.size()), 3);
    for (std::size_t i = 0; i < more.size(); ++i)
        mesh.faces.row(m + static_cast<Eigen::Index>(i)) << more[i][0], more[i][1], more[i][2];
    return mesh;
}

Mesh with_vertex(Mesh mesh, const Vec3& vertex) {
    mesh.vertices.conservativeResize(mesh.vertices.rows() + 1, 3);
    mesh.vertices.row(mesh.vertices.rows() - 1) = vertex.transpose();
    return mesh;
}

/// Every third face turned round.
Mesh partly_turned(Mesh mesh) {
    for (Eigen::Index f = 0; f < mesh.faces.rows(); f += 3) std::swap(mesh.faces(f, 1), mesh.faces(f, 2));
    return mesh;
}

} // namespace

TEMPLATE_TEST_CASE("a soup is welded to the surface it was", "", float, double) {
    const Mesh exact = moved(cube(2), {random_rotation(3), 5, Vec3(100, 0, 3)}), soup = as_soup(exact);
    const TriangleMesh<TestType> mesh{soup.vertices.cast<TestType>(), soup.faces};
    const WeldedMesh<TestType> welded = weld(mesh, TestType(0));
    CHECK(welded.mesh.vertices.rows() == exact.vertices.rows());
    CHECK(welded.welded == soup.vertices.rows() - exact.vertices.rows());
    CHECK(is_closed(welded.mesh.faces));
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        REQUIRE(welded.mesh.vertices.row(welded.placed[static_cast<std::size_t>(v)]) == mesh.vertices.row(v));
}

TEST_CASE("a sound mesh is left as it is, to the last bit") {
    const Mesh mesh = shuffled(torus(1, 0.3), 4);
    const CleanMesh<double> whole = clean(mesh);
    CHECK(whole.mesh.vertices == mesh.vertices);
    CHECK(whole.mesh.faces == mesh.faces);
    CHECK(whole.placed.empty());
    CHECK(whole.notes.empty());
    CHECK(prepare(mesh).repairs.empty());
}

TEST_CASE("one closed piece that looks outwards is sound, anything else is not") {
    const Mesh ring = torus(1, 0.3);
    CHECK(is_sound(ring));
    CHECK(is_sound(shuffled(ring, 9)));
    Mesh pinched = sphere(1, 3);
    pinched.faces = (pinched.faces.array() == 3).select(0, pinched.faces);
    CHECK(is_sound(pinched));
    Mesh inside_out = ring;
    inside_out.faces.col(0).swap(inside_out.faces.col(1));
    CHECK_FALSE(is_sound(inside_out));
    CHECK_FALSE(is_sound(partly_turned(ring)));
    CHECK_FALSE(is_sound(without_faces(ring, 3, 1)));
    CHECK_FALSE(is_sound(side_by_side(ring, sphere(0.1, 2))));
    CHECK_FALSE(is_sound(as_soup(ring)));
    CHECK_FALSE(is_sound(with_faces(ring, {{0, 0, 1}})));
    CHECK_FALSE(is_sound(with_faces(ring, {{0, 1, 5}})));
}

TEST_CASE("vertices up to the tolerance apart become one, others do not") {
    Mesh soup = as_soup(cube(1));
    for (Eigen::Index v = 0; v < soup.vertices.rows(); ++v)
        soup.vertices(v, v % 3) += 1e-7 * static_cast<double>(v % 5);
    CHECK(weld(soup, 1e-6).mesh.vertices.rows() == cube(1).vertices.rows());
    CHECK(weld(soup, 1e-9).mesh.vertices.rows() > 2 * cube(1).vertices.rows());
}

TEST_CASE("what is welded is what comparing every vertex with every other one says") {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> place(0, 1);
    const double tolerance = 0.05;
    Mesh soup;
    soup.vertices.resize(300, 3);
    soup.faces.resize(100, 3);
    for (Eigen::Index i = 0; i < 300; ++i) {
        soup.vertices.row(i) << place(random), place(random), place(random);
        soup.faces(i / 3, i % 3) = static_cast<int>(i);
    }
    DisjointSets groups(300);
    for (std::size_t a = 0; a < 300; ++a)
        for (std::size_t b = a + 1; b < 300; ++b)
            if ((point(soup.vertices, static_cast<Eigen::Index>(a)) -
                 point(soup.vertices, static_cast<Eigen::Index>(b)))
                    .norm() <= tolerance)
                groups.unite(a, b);
    for (const double far : {0.0, 1e6}) { // also where rounding takes much of what the places differ by
        Mesh moved_soup = soup;
        moved_soup.vertices.array() += far;
        const WeldedMesh<double> welded = weld(moved_soup, tolerance);
        CHECK(welded.welded > 10);
        CHECK(static_cast<std::size_t>(welded.mesh.vertices.rows()) == groups.count());
        for (std::size_t v = 0; v < 300; ++v) REQUIRE(welded.placed[v] == welded.placed[groups.find(v)]);
    }
    CHECK_THROWS_AS(weld(soup, tolerance, std::vector<bool>(299)), Error);
}

TEST_CASE("a large flat sheet is welded in no time, whatever axis it is square to") {
    constexpr int n = 500;
    for (const int axis : {0, 1, 2}) {
        Mesh sheet;
        sheet.vertices.setZero(n * n, 3);
        sheet.faces.resize((n - 1) * (n - 1), 3);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const int v = i * n + j;
                sheet.vertices(v, (axis + 1) % 3) = i;
                sheet.vertices(v, (axis + 2) % 3) = j;
                if (i + 1 < n && j + 1 < n) sheet.faces.row(i * (n - 1) + j) << v, v + 1, v + n;
            }
        CHECK(weld(sheet, 1e-6 * n).welded == 0); // compared by pairs, it would be minutes
    }
}

TEST_CASE("closed pieces are welded where all become one surface, and left apart where a seam would tear them") {
    const Mesh low = cylinder(0.3, 2);
    const auto mirrored_above = [&](double below) { // its lowest ring but for that of the lid is widened
        Mesh upper = low;
        for (Eigen::Index v = 0; v < upper.vertices.rows(); ++v) {
            if (upper.vertices(v, 2) > 2 - 1e-9 && below > 0) upper.vertices.row(v).head(2) *= 1.5;
            upper.vertices(v, 2) = 4 - below - upper.vertices(v, 2);
        }
        upper.faces.col(0).swap(upper.faces.col(1));
        return upper;
    };
    SECTION("one set upon the other: the wall between them goes") {
        const CleanMesh<double> whole = clean(side_by_side(low, mirrored_above(0)));
        CHECK(is_sound(whole.mesh));
        CHECK(enclosed_volume(whole.mesh) == Approx(2 * enclosed_volume(low)).epsilon(1e-12));
    }
    SECTION("one ends around the other, and has a ring of vertices where that has its last") {
        const Mesh both = side_by_side(low, mirrored_above(2.0 / 40));
        REQUIRE(weld(both, 1e-9).welded == 32);
        const CleanMesh<double> apart = clean(both);
        CHECK(apart.mesh.vertices == both.vertices);
        CHECK(apart.mesh.faces == both.faces);
        CHECK(apart.notes.empty());
    }
    SECTION("a piece that is there twice is one") {
        const Mesh ball = moved(sphere(0.1, 2), {Eigen::Matrix3d::Identity(), 1, Vec3(0.6, 0, 1)});
        const Mesh twice = side_by_side(side_by_side(low, low), ball);
        const CleanMesh<double> once = clean(twice);
        CHECK(once.mesh.faces.rows() == low.faces.rows() + ball.faces.rows());
        const std::vector<bool> closed = in_closed_pieces(twice, weld(twice, 0.0).placed);
        CHECK(std::count(closed.begin(), closed.end(), true) == ball.vertices.rows());
    }
    SECTION("a soup of triangles with both their sides has no closed piece") {
        Mesh soup = as_soup(low);
        const Eigen::Index m = soup.faces.rows();
        soup.faces.conservativeResize(2 * m, 3);
        for (Eigen::Index f = 0; f < m; ++f)
            soup.faces.row(m + f) << soup.faces(f, 0), soup.faces(f, 2), soup.faces(f, 1);
        const std::vector<bool> closed = in_closed_pieces(soup, weld(soup, 0.0).placed);
        CHECK(std::count(closed.begin(), closed.end(), true) == 0);
    }
}

TEST_CASE("vertices that no face uses are left out and do not count for the size") {
    const Mesh ball = sphere(1, 3), mesh = with_vertex(ball, Vec3(1e6, 0, 0));
    const WeldedMesh<double> welded = weld(mesh, 0.0);
    CHECK(welded.unused == 1);
    CHECK(welded.placed.back() == -1);
    CHECK(welded.mesh.vertices == ball.vertices);
    const Body<double> body = prepare(mesh), expected = prepare(ball);
    CHECK(body.mesh.vertices == expected.mesh.vertices);
    CHECK(body.nearest.back() == -1);
    REQUIRE(body.repairs.size() == 1);
    CHECK(body.repairs[0] == "vertices without a face ignored: 1 vertex");
}

TEST_CASE("the size is that of most of the surface, and faces that reach far beyond go") {
    const auto size = [](const Mesh& mesh) { return robust_box(mesh).diagonal().norm(); };
    CHECK(size(cube(4)) == Approx(std::sqrt(3)).epsilon(0.02));
    CHECK(!faces_within_reach(cube(4), robust_box(cube(4))));
    Mesh far = with_vertex(cube(4), Vec3(1e5, 0, 0));
    CHECK(!faces_within_reach(far, robust_box(far)));
    far = with_faces(far, {{0, 1, static_cast<int>(far.vertices.rows()) - 1}});
    CHECK(size(far) == Approx(size(cube(4))).epsilon(0.02));
    CHECK(faces_within_reach(far, robust_box(far)) == cube(4).faces);
    CHECK(clean(far).mesh.faces == cube(4).faces);
    CHECK(clean(far).notes.front() == "faces that reach far away left out: 1 face");
}

TEST_CASE("faces that bound nothing go") {
    const Mesh ball = sphere(1, 3);
    const auto face = [&](Eigen::Index f) {
        return std::array<int, 3>{ball.faces(f, 0), ball.faces(f, 1), ball.faces(f, 2)};
    };
    SECTION("degenerate and duplicate ones") {
        const auto again = face(5);
        const Mesh mesh = with_faces(ball, {{3, 3, 7}, {1, 1, 1}, again, {again[1], again[0], again[2]}});
        const SoundFaces sound = sound_faces(mesh);
        CHECK(sound.degenerate == 2);
        CHECK(sound.duplicate == 2);
        CHECK(sound.faces == ball.faces);
    }
    SECTION("fins") {
        const auto at = face(10);
        const Mesh mesh = with_faces(with_vertex(ball, 1.1 * ball.vertices.row(at[0]).transpose()),
                                     {{at[0], at[1], static_cast<int>(ball.vertices.rows())}});
        const SoundFaces sound = sound_faces(mesh);
        CHECK(sound.fins == 1);
        CHECK(sound.faces == ball.faces);
    }
}

TEST_CASE("a face with a corner torn far away goes, one that is as long as others stays") {
    const Mesh ball = sphere(1, 3);
    const int tip = static_cast<int>(ball.vertices.rows());
    const auto torn = [&](double reach) { // of a face whose own corner the others keep
        const Vec3 place = reach * ball.vertices.row(ball.faces(10, 2)).transpose();
        Mesh mesh = with_vertex(ball, place);
        mesh.faces(10, 2) = tip;
        return mesh;
    };
    const SoundFaces far = sound_faces(torn(3));
    CHECK(far.spikes == 1);
    REQUIRE(far.faces.rows() == ball.faces.rows() - 1);
    CHECK((far.faces.array() < tip).all());
    CHECK(sound_faces(torn(1.05)).spikes == 0);
    CHECK(clean(torn(3)).notes.front() == "spikes left out: 1 face");
    CHECK(sound_faces(ball).faces == ball.faces);
}

TEST_CASE("a wall across a tube goes, and the tube stays whole") {
    const int around = 32, along = 40;
    const double bulge = GENERATE(0.0, 0.33); // of the wall's middle: across the axis, through the skin
    const Mesh tube = capsule(0.3, 4, around, along);
    // A fan in the ring half way up: its vertices are those with the middle height.
    std::vector<int> ring;
    for (int v = 0; v < tube.vertices.rows(); ++v)
        if (std::abs(tube.vertices(v, 2) - 2) < 1e-9) ring.push_back(v);
    REQUIRE(ring.size() == around);
    const int middle = static_cast<int>(tube.vertices.rows());
    std::vector<std::array<int, 3>> wall;
    for (int k = 0; k < around; ++k)
        wall.push_back({ring[static_cast<std::size_t>(k)], ring[static_cast<std::size_t>((k + 1) % around)], middle});
    const Mesh mesh = with_faces(with_vertex(tube, Vec3(bulge, 0, 2)), wall);
    const SoundFaces sound = sound_faces(mesh);
    CHECK(sound.walls == around);
    CHECK(sound.faces == tube.faces);
    CHECK(prepare(mesh).dropped_pieces == 0);
}

TEMPLATE_TEST_CASE("faces come to look outwards", "", float, double) {
    const Mesh tube = torus(1, 0.3);
    const auto volume_after = [](const Mesh& mesh) {
        const TriangleMesh<TestType> in{mesh.vertices.cast<TestType>(), mesh.faces};
        const OrientedMesh<TestType> out = orient(in);
        CHECK(is_closed(out.mesh.faces));
        return enclosed_volume(out.mesh);
    };
    const auto volume = static_cast<TestType>(enclosed_volume(tube));
    Mesh inside_out = tube;
    inside_out.faces.col(0).swap(inside_out.faces.col(1));
    CHECK(volume_after(inside_out) == Approx(volume));
    CHECK(volume_after(partly_turned(tube)) == Approx(volume));
    CHECK(orient(tube).turned == 0);
    CHECK(orient(inside_out).turned == tube.faces.rows());
}

TEST_CASE("an open piece is turned to the side that sees more") {
    // The lower two thirds of a ball, inside out: from within, most rays meet the other side.
    Mesh bowl = sphere(1, 4);
    std::vector<bool> kept(static_cast<std::size_t>(bowl.faces.rows()));
    Mesh open{bowl.vertices, {}};
    open.faces.resize(bowl.faces.rows(), 3);
    Eigen::Index m = 0;
    for (Eigen::Index f = 0; f < bowl.faces.rows(); ++f)
        if (bowl.vertices(bowl.faces(f, 0), 2) < 0.4)
            open.faces.row(m++) << bowl.faces(f, 1), bowl.faces(f, 0), bowl.faces(f, 2);
    open.faces.conservativeResize(m, 3);
    CHECK(orient(open).turned == m);
}

TEST_CASE("small holes are closed, large ones stay") {
    const Mesh ball = sphere(1, 4);
    const Mesh pricked = without_faces(ball, 7, 1);
    const FilledSurface<double> whole = fill_holes(pricked, 0.01);
    CHECK(whole.filled == 1);
    CHECK(whole.open == 0);
    CHECK(is_closed(whole.mesh.faces));
    CHECK(enclosed_volume(whole.mesh) == Approx(enclosed_volume(ball)).epsilon(1e-12));
    REQUIRE(whole.rims.size() == 1);
    CHECK(std::set<int>(whole.rims[0].begin(), whole.rims[0].end()) ==
          std::set<int>{ball.faces(7, 0), ball.faces(7, 1), ball.faces(7, 2)});

    const Mesh tube = cylinder(0.3, 3);
    std::vector<bool> lid(static_cast<std::size_t>(tube.faces.rows()), false);
    Mesh open = tube;
    Eigen::Index m = 0;
    for (Eigen::Index f = 0; f < tube.faces.rows(); ++f)
        if (!(tube.vertices(tube.faces(f, 0), 2) > 2.999 && tube.vertices(tube.faces(f, 1), 2) > 2.999 &&
              tube.vertices(tube.faces(f, 2), 2) > 2.999))
            open.faces.row(m++) = tube.faces.row(f);
    open.faces.conservativeResize(m, 3);
    open = prepare(open).mesh; // without the vertices that only the lid had
    const double lid_share = pi * 0.3 * 0.3 / (2 * pi * 0.3 * 3 + pi * 0.3 * 0.3);
    CHECK(is_closed(fill_holes(open, 1.1 * lid_share).mesh.faces));
    const FilledSurface<double> left = fill_holes(open, 0.9 * lid_share);
    CHECK(left.filled == 0);
    CHECK(left.rims.empty());
    CHECK(left.open == 1);
    CHECK(left.open_area == Approx(lid_share).epsilon(0.02));
}

TEST_CASE("a body knows where holes were, whatever becomes of its vertices") {
    const Mesh ball = sphere(1, 4);
    const Body<double> body = prepare(without_faces(ball, 7, 1));
    REQUIRE(body.rims.size() == 1);
    REQUIRE(body.rims[0].size() == 3);
    std::set<int> around;
    for (const int v : body.rims[0]) around.insert(body.source[static_cast<std::size_t>(v)]);
    CHECK(around == std::set<int>{ball.faces(7, 0), ball.faces(7, 1), ball.faces(7, 2)});

    CHECK(carried_rims({{0, 1, 2}, {2, 3, 4}}, {5, -1, 2, 1, 0, 0}) == std::vector<std::vector<int>>{{4, 3, 2}});
    CHECK(carried_rims({}, {0, 1}).empty());
}

TEST_CASE("what is done to a mesh is said, and its vertices keep their places") {
    const Mesh tube = capsule(0.3, 4), soup = as_soup(partly_turned(tube));
    const Body<double> body = prepare(soup);
    REQUIRE(body.repairs.size() == 2);
    CHECK(body.repairs[0] ==
          "seams welded: " + std::to_string(soup.vertices.rows() - tube.vertices.rows()) + " vertices");
    CHECK(body.repairs[1].rfind("faces turned outwards: ", 0) == 0);
    REQUIRE(body.nearest.size() == static_cast<std::size_t>(soup.vertices.rows()));
    for (Eigen::Index v = 0; v < soup.vertices.rows(); ++v) {
        const Vec3 place = body.mesh.vertices.row(body.nearest[static_cast<std::size_t>(v)]).transpose();
        REQUIRE((body.similarity.to_input(place) - Vec3(soup.vertices.row(v).transpose())).norm() < 1e-12);
    }
    CurveSkeleton<double> curve;
    curve.nodes = Points<double>::Zero(2, 3);
    curve.regions.resize(2);
    for (int v = 0; v < body.mesh.vertices.rows(); ++v) curve.regions[static_cast<std::size_t>(v % 2)].push_back(v);
    const CurveSkeleton<double> back = to_input(body, curve);
    CHECK(back.regions[0].size() + back.regions[1].size() == static_cast<std::size_t>(soup.vertices.rows()));
}

TEST_CASE("a mesh of degenerate and doubled faces alone is bad input") {
    Mesh flat = sphere(1, 1);
    for (Eigen::Index f = 2; f < flat.faces.rows(); ++f) flat.faces.row(f) = flat.faces.row(0);
    REQUIRE_THROWS_AS(clean(flat), Error);
    REQUIRE_THROWS_WITH(clean(flat),
                        "only 2 of 32 faces are neither degenerate nor doubled; a body needs a closed surface");
}
