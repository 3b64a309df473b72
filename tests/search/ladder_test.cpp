// The loop that tries what may be true of a mesh: its order, its budget, its trail.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/search/impl/agreement.hpp>
#include <skelgen/search/trust.hpp>

#include "catch.hpp"
#include "fixture_bodies.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::search;
using namespace skelgen::test;

namespace {

const Mesh& standing_man() {
    static const Mesh mesh = load_fixture_body("standing-man").mesh;
    return mesh;
}

Climb<double> climbed(const Mesh& mesh, int budget, Thoroughness thoroughness = Thoroughness::until_sure) {
    ExtractOptions options;
    options.budget = budget;
    return climb(mesh, builtin_template("human21"), options, thoroughness);
}

/// The standing man with everything tried.
const Climb<double>& thorough() {
    static const Climb<double> made = climbed(standing_man(), 24, Thoroughness::exhaustive);
    return made;
}

/// What a trail cost, in drafts.
int spent_on(const Trail& trail) {
    int spent = 0;
    for (const Tried& each : trail) spent += cost_of(each.hypothesis.effort);
    return spent;
}

Mesh two_balls() {
    return side_by_side(sphere(1, 3), moved(sphere(0.8, 3), {Eigen::Matrix3d::Identity(), 1, {5, 0, 0}}));
}

bool is_same(const Tried& a, const Tried& b) {
    return a.hypothesis.surface == b.hypothesis.surface && a.hypothesis.effort == b.hypothesis.effort &&
           a.refusal == b.refusal && a.candidates == b.candidates && a.probability == b.probability &&
           a.lacks_limb == b.lacks_limb;
}

} // namespace

TEST_CASE("a body that stands free is sure by its draft, or when other ways to find it agree", "[search]") {
    const Climb<double> climb = climbed(standing_man(), 24);
    REQUIRE(!climb.trail.empty());
    REQUIRE(climb.trail.size() <= 4);
    CHECK(climb.trail.front().hypothesis.effort == Effort::draft);
    CHECK(climb.trail.front().refusal == Refusal::none);
    CHECK(climb.trail.front().candidates == 1);
    REQUIRE(climb.found.size() == 1);
    const Evidence& evidence = climb.found.front().candidate.evidence;
    CHECK((climb.trail.size() == 1) == (evidence[Witness::heard] == 0));
    CHECK((climb.trail.size() == 1 || evidence[Witness::agreed] > 0.1));
    CHECK(climb.found.front().candidate.probability >= sure_enough);
    CHECK(climb.failure.reason == Refusal::none);
}

TEST_CASE("a thorough climb goes on from a draft to a body at rest and to bodies in any pose") {
    const Trail& trail = thorough().trail;
    REQUIRE(trail.size() == 3);
    constexpr std::array efforts{Effort::draft, Effort::rest_fit, Effort::posed_fit};
    for (std::size_t i = 0; i < trail.size(); ++i) {
        CHECK(trail[i].hypothesis.effort == efforts[i]);
        CHECK(trail[i].hypothesis.surface == surface::Remedy::largest_piece);
    }
}

TEST_CASE("no hypothesis is tried twice") {
    const Trail& trail = thorough().trail;
    for (std::size_t i = 0; i < trail.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const Hypothesis &a = trail[i].hypothesis, &b = trail[k].hypothesis;
            CHECK((a.surface != b.surface || a.effort != b.effort));
        }
}

TEST_CASE("the budget is kept, and used where there is something to try") {
    for (const int budget : {1, 2}) {
        INFO(budget);
        const Trail trail = climbed(standing_man(), budget, Thoroughness::exhaustive).trail;
        CHECK(spent_on(trail) == budget);
        // a draft, one at rest; and whatever the budget bodies in any pose
        CHECK(trail.size() == static_cast<std::size_t>(budget) + 1);
    }
    CHECK(spent_on(thorough().trail) == 2);
}

TEST_CASE("a thorough climb keeps all candidates, in the order of the trail") {
    const Climb<double>& climb = thorough();
    std::size_t first = 0;
    for (const Tried& each : climb.trail) {
        const auto count = static_cast<std::size_t>(each.candidates);
        REQUIRE(climb.found.size() >= first + count);
        for (std::size_t i = first; i < first + count; ++i)
            CHECK(climb.found[i].hypothesis.effort == each.hypothesis.effort);
        CHECK((each.probability > 0) == (count > 0));
        first += count;
    }
    CHECK(climb.found.size() == first);
}

TEST_CASE("every candidate of a climb is likely as its evidence says, and comes with what it was found in") {
    for (const Found<double>& each : thorough().found) {
        CHECK(each.candidate.probability == probability_right(each.candidate.evidence));
        CHECK(each.candidate.evidence[Witness::envelope] == 0);
        CHECK(each.candidate.evidence[Witness::agreed] >= 0);
        CHECK(each.candidate.evidence[Witness::agreed] < 1);
        REQUIRE(each.body);
        REQUIRE(each.whole);
        REQUIRE(each.curve);
        CHECK(each.curve->is_draft);
        CHECK(each.candidate.skeleton.joints.size() == 21);
        CHECK(each.candidate.doubt.size() == 21);
    }
}

TEST_CASE("a try that has led to a skeleton has no refusal, one that has not says why") {
    const auto check = [](const Trail& trail) {
        REQUIRE_FALSE(trail.empty());
        for (const Tried& each : trail) {
            CHECK((each.refusal == Refusal::none) == (each.candidates > 0));
            CHECK(each.seconds >= 0);
            if (each.candidates == 0) CHECK(each.probability == 0);
        }
    };
    check(thorough().trail);
    check(climbed(three_tubes(), 1).trail);
    check(climbed(sphere(1, 3), 1).trail);
}

TEST_CASE("a climb that is to end where it is sure keeps the likeliest candidate of all that it tried") {
    for (const char* name : {"figure", "kneeling-boy"}) {
        INFO(name);
        const Climb<double> climb = climbed(load_fixture_body(name).mesh, 4);
        REQUIRE(climb.found.size() == 1);
        for (std::size_t i = 0; i + 1 < climb.trail.size(); ++i) CHECK(climb.trail[i].probability < sure_enough);
        const Candidate<double>& kept = climb.found.front().candidate;
        CHECK(kept.probability >= probability_right(kept.evidence)); // the likeliest one's that agrees with it
    }
}

TEST_CASE("the joints of what is kept are where all candidates together expect them") {
    const Mesh mesh = load_fixture_body("figure").mesh;
    const Climb<double> kept = climbed(mesh, 4), all = climbed(mesh, 4, Thoroughness::exhaustive);
    REQUIRE(kept.found.size() == 1);
    REQUIRE(kept.found.front().candidate.probability < sure_enough); // so that both have tried the same
    const auto likeliest = std::max_element(all.found.begin(), all.found.end(), [](const auto& a, const auto& b) {
        return a.candidate.probability < b.candidate.probability;
    });
    // Odds of a candidate times its distance, summed over all; curves are more exact than fits.
    const auto expected_distance = [&](const Found<double>& of) {
        double sum = 0;
        for (const Found<double>& each : all.found) {
            const double probability = each.candidate.probability;
            const double weight =
                probability / (1 - probability) * (each.candidate.evidence[Witness::fitted] > 0 ? 1 : 3.3);
            for (std::size_t j = 0; j < 21; ++j)
                sum += weight * (of.body->similarity.to_input(of.candidate.skeleton.joints[j].position) -
                                 each.body->similarity.to_input(each.candidate.skeleton.joints[j].position))
                                    .norm();
        }
        return sum;
    };
    CHECK(expected_distance(kept.found.front()) < expected_distance(*likeliest));
}

TEST_CASE("of each candidate it is known how many of the others agree with it, and how many were heard") {
    const std::vector<Found<double>>& found = thorough().found;
    const double extent = extent_of(*found.front().whole);
    CHECK(extent == Approx(core::bounding_diagonal(standing_man().vertices)).epsilon(0.5)); // in the input's unit
    std::vector<Points<double>> places;
    for (const Found<double>& each : found) {
        Points<double>& joints = places.emplace_back(21, 3);
        joints.setConstant(std::numeric_limits<double>::quiet_NaN());
        for (std::size_t j = 0; j < 21; ++j)
            if (each.candidate.skeleton.joints[j].is_present)
                joints.row(static_cast<Eigen::Index>(j)) =
                    each.body->similarity.to_input(each.candidate.skeleton.joints[j].position).transpose();
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
        double sum = 0;
        for (std::size_t k = 0; k < found.size(); ++k)
            if (k != i) sum += agreement(places[i], places[k], extent);
        const double others = static_cast<double>(found.size() - 1);
        CHECK(found[i].candidate.evidence[Witness::agreed] == Approx(sum / (others + dissenters)));
        CHECK(found[i].candidate.evidence[Witness::heard] == Approx(others / (others + dissenters)));
    }
}

TEST_CASE("a far vertex that no face uses does not make candidates agree") {
    Mesh mesh = standing_man();
    mesh.vertices.conservativeResize(mesh.vertices.rows() + 1, 3);
    mesh.vertices.row(mesh.vertices.rows() - 1) = Eigen::RowVector3d(0, 0, 1e4);
    const auto least_agreed = [](const std::vector<Found<double>>& found) {
        double least = 1;
        for (const Found<double>& each : found) least = std::min(least, each.candidate.evidence[Witness::agreed]);
        return least;
    };
    const double least = least_agreed(thorough().found);
    REQUIRE(least < 0.2); // one of them lies elsewhere
    CHECK(least_agreed(climbed(mesh, 24, Thoroughness::exhaustive).found) < least + 0.05);
}

TEST_CASE("skeletons agree that lie on each other, little where joints are far off, nothing where most are lacking") {
    Points<double> one = Points<double>::Random(21, 3), other = one;
    CHECK(agreement(one, one, 2) == 1);
    for (Eigen::Index j = 0; j < 21; ++j) other.row(j) += Eigen::RowVector3d(0, 0.1, 0);
    CHECK(agreement(one, other, 2) == Approx(std::exp(-1.0))); // a twentieth of the extent
    CHECK(agreement(one, other, 2) == agreement(other, one, 2));
    Points<double> far = one;
    far.array() += 100;
    CHECK(agreement(one, far, 2) == Approx(std::exp(-36.0))); // as if all were 0.3 away
    Points<double> lacking = one;
    lacking.row(20).setConstant(std::numeric_limits<double>::quiet_NaN());
    CHECK(agreement(one, lacking, 2) == 1);
    lacking.topRows(11).setConstant(std::numeric_limits<double>::quiet_NaN());
    CHECK(agreement(one, lacking, 2) == 0);
}

TEST_CASE("a face is seen by the input's vertices, where an envelope stands for the surface, too") {
    // Of one surface, cut through at the waist: the vertices of the face are denser, or those of the head's back.
    const Mesh& man = standing_man();
    const double top = man.vertices.col(2).maxCoeff(), height = top - man.vertices.col(2).minCoeff();
    const auto middle = [&](Eigen::Index f) {
        return Vector3<double>((core::point(man.vertices, man.faces(f, 0)) +
                                core::point(man.vertices, man.faces(f, 1)) +
                                core::point(man.vertices, man.faces(f, 2))) /
                               3);
    };
    double head_y = 0, head_faces = 0;
    for (Eigen::Index f = 0; f < man.faces.rows(); ++f)
        if (middle(f).z() > top - 0.1 * height) {
            head_y += middle(f).y();
            head_faces += 1;
        }
    head_y /= head_faces;
    std::vector<double> seen;
    for (const double denser : {-1.0, 1.0}) { // towards y
        std::vector<Vector3<double>> places;
        std::vector<Eigen::Vector3i> faces;
        for (Eigen::Index v = 0; v < man.vertices.rows(); ++v) places.push_back(core::point(man.vertices, v));
        for (Eigen::Index f = 0; f < man.faces.rows(); ++f) {
            const Eigen::Vector3i face = man.faces.row(f).transpose();
            const Vector3<double> at = middle(f);
            if (at.z() > top - 0.425 * height && at.z() < top - 0.415 * height) continue;
            if (at.z() > top - 0.1 * height && denser * (at.y() - head_y) > 0) {
                const int added = static_cast<int>(places.size());
                places.push_back(at);
                for (int k = 0; k < 3; ++k) faces.emplace_back(face[k], face[(k + 1) % 3], added);
            } else {
                faces.push_back(face);
            }
        }
        Mesh mesh{Points<double>(static_cast<Eigen::Index>(places.size()), 3),
                  Triangles(static_cast<Eigen::Index>(faces.size()), 3)};
        for (std::size_t v = 0; v < places.size(); ++v)
            mesh.vertices.row(static_cast<Eigen::Index>(v)) = places[v].transpose();
        for (std::size_t f = 0; f < faces.size(); ++f)
            mesh.faces.row(static_cast<Eigen::Index>(f)) = faces[f].transpose();
        const Climb<double> climb = climbed(mesh, 3, Thoroughness::exhaustive);
        REQUIRE(!climb.found.empty());
        const Found<double>& found = climb.found.front();
        CHECK(found.hypothesis.surface == surface::Remedy::envelope);
        const Vector3<double> ahead = skeleton_in_input(found).frame.forward;
        seen.push_back(found.candidate.sides[symmetry::SideWitness::face] * (ahead.y() > 0 ? 1 : -1));
    }
    CHECK(seen[0] < -0.002); // of the diagonal, towards y
    CHECK(seen[1] > 0.002);
}

TEST_CASE("parts that do not touch, as a robot's, are one body where a skeleton in all of them is likely") {
    const FixtureBody robot = load_fixture_body("robot");
    const Climb<double> climb = climbed(robot.mesh, 8);
    REQUIRE(climb.found.size() == 1);
    CHECK(climb.found.front().hypothesis.surface == surface::Remedy::bridged);
    CHECK(climb.found.front().candidate.probability > 0.5);
    ExtractOptions options;
    options.budget = 8;
    const KinematicSkeleton<double> skeleton = extract(robot.mesh, options).skeleton;
    REQUIRE(robot.truth.joints.size() == skeleton.joints.size());
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const auto& [name, place] = robot.truth.joints[j];
        INFO(name);
        REQUIRE(skeleton.joints[j].is_present);
        CHECK((skeleton.joints[j].position - place).norm() < 0.08 * robot.truth.scale);
    }
}

TEST_CASE("several bodies that are too far apart to be one are refused, and one of them can be chosen") {
    const Climb<double> both = climbed(two_balls(), 1);
    CHECK(both.found.empty());
    REQUIRE(both.trail.size() == 1);
    CHECK(both.trail[0].hypothesis.surface == surface::Remedy::bridged);
    CHECK(both.trail[0].refusal == Refusal::several_bodies);
    CHECK(both.failure.reason == Refusal::several_bodies);
    CHECK_THAT(both.failure.what, Catch::Matchers::StartsWith("2 bodies apart"));

    ExtractOptions second;
    second.budget = 1;
    second.prepare.component = 2;
    const Climb<double> one = climb(two_balls(), builtin_template("human21"), second);
    CHECK(one.failure.reason == Refusal::too_compact);
    CHECK(one.trail.size() == 1);
    second.prepare.component = 3;
    try {
        static_cast<void>(climb(two_balls(), builtin_template("human21"), second));
        FAIL("there is no third body");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
    }
}

TEST_CASE("a surface that encloses nothing is a try that has failed") {
    const Mesh sheet = make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}},
                                 {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    const Climb<double> climb = climbed(sheet, 24);
    CHECK(climb.found.empty());
    REQUIRE_FALSE(climb.trail.empty());
    CHECK(climb.failure.reason == climb.trail.front().refusal);
    const auto nothing = std::find_if(climb.trail.begin(), climb.trail.end(),
                                      [](const Tried& each) { return each.refusal == Refusal::nothing_enclosed; });
    REQUIRE(nothing != climb.trail.end());
    CHECK(nothing->candidates == 0);
}

TEST_CASE("bodies in any pose are laid into the first surface, once, whatever the budget") {
    const Climb<double> climb = climbed(standing_man(), 1, Thoroughness::exhaustive);
    REQUIRE(climb.trail.size() == 2);
    CHECK(spent_on(climb.trail) == 1);
    CHECK(climb.trail[0].hypothesis.effort == Effort::draft);
    CHECK(climb.trail[1].hypothesis.effort == Effort::posed_fit);
    CHECK(climb.trail[1].candidates > 1);
    CHECK(climb.found.front().candidate.evidence[Witness::posed] == 0);
    CHECK(climb.found.back().candidate.evidence[Witness::posed] == 1);
    CHECK(climb.found.back().candidate.evidence[Witness::fitted] == 1);
}

TEST_CASE("bodies in any pose are laid into each surface that pieces make together, too") {
    const FixtureBody man = load_fixture_body("standing-man");
    const auto hand = std::find_if(man.truth.joints.begin(), man.truth.joints.end(),
                                   [](const auto& joint) { return joint.first == "left_hand"; });
    REQUIRE(hand != man.truth.joints.end());
    const Mesh ball = moved_by(sphere(0.12, 2), hand->second); // overlaps the hand, and is joined to nothing
    const Climb<double> climb = climbed(side_by_side(man.mesh, ball), 24, Thoroughness::exhaustive);
    std::vector<surface::Remedy> laid_into;
    for (const Tried& each : climb.trail)
        if (each.hypothesis.effort == Effort::posed_fit) laid_into.push_back(each.hypothesis.surface);
    CHECK(laid_into.size() >= 2);
    CHECK(std::count(laid_into.begin(), laid_into.end(), surface::Remedy::envelope) == 1);
}

TEST_CASE("a curve with too few ends is no body's: the failure says so, and so does the trail") {
    const Climb<double> climb = climbed(three_tubes(), 1);
    for (const Found<double>& each : climb.found) CHECK(each.candidate.probability < least_probability);
    CHECK(climb.failure.reason == Refusal::too_few_ends);
    REQUIRE_FALSE(climb.trail.empty());
    CHECK(climb.trail.front().refusal == Refusal::too_few_ends);
    CHECK(climb.trail.front().candidates == 0);
}

TEST_CASE("what no skeleton is found in carries its trail, its code and its reason") {
    ExtractOptions options;
    options.budget = 1;
    const auto refusal_of_mesh = [&](const Mesh& mesh, std::size_t least_tries) {
        try {
            static_cast<void>(extract(mesh, options));
        } catch (const NoSkeleton& none) {
            CHECK(none.code() == ErrorCode::no_skeleton);
            CHECK(none.trail().size() >= least_tries);
            CHECK(std::string(none.what()).size() > 10);
            return none.refusal();
        }
        return Refusal::none;
    };
    CHECK(refusal_of_mesh(sphere(1, 3), 1) == Refusal::too_compact);
    CHECK(refusal_of_mesh(two_balls(), 0) == Refusal::several_bodies);
    CHECK(refusal_of_mesh(three_tubes(), 1) == Refusal::too_few_ends);
    // Other errors have none.
    try {
        static_cast<void>(extract(Mesh{Points<double>(0, 3), Triangles(0, 3)}, options));
        FAIL("a skeleton of nothing");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        CHECK(error.refusal() == Refusal::none);
    }
}

TEST_CASE("every refusal has a name of its own, as files spell it") {
    std::vector<std::string_view> names;
    for (int r = static_cast<int>(Refusal::none); r <= static_cast<int>(Refusal::unlikely); ++r)
        names.push_back(to_string(static_cast<Refusal>(r)));
    std::sort(names.begin(), names.end());
    CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
    CHECK(std::find(names.begin(), names.end(), "too_few_ends") != names.end());
    CHECK(std::find(names.begin(), names.end(), "") == names.end());
}

TEST_CASE("a climb is the same by however many threads") {
    const Mesh mesh = load_fixture_body("figure").mesh;
    const Climb<double> alone = climbed(mesh, 4, Thoroughness::exhaustive);
    const core::ThreadScope threads(3);
    const Climb<double> together = climbed(mesh, 4, Thoroughness::exhaustive);
    REQUIRE(together.trail.size() == alone.trail.size());
    for (std::size_t i = 0; i < alone.trail.size(); ++i) CHECK(is_same(together.trail[i], alone.trail[i]));
    REQUIRE(together.found.size() == alone.found.size());
    for (std::size_t i = 0; i < alone.found.size(); ++i) {
        const Candidate<double>&a = alone.found[i].candidate, &b = together.found[i].candidate;
        CHECK(a.evidence.values == b.evidence.values);
        for (std::size_t j = 0; j < a.skeleton.joints.size(); ++j)
            CHECK(a.skeleton.joints[j].position == b.skeleton.joints[j].position);
    }
}

TEST_CASE("where a body lies, and how large it is, does not change what is tried") {
    const Motion motion{random_rotation(6), 250, {1000, -2000, 500}};
    const Mesh mesh = load_fixture_body("figure").mesh;
    const Climb<double> expected = climbed(mesh, 4, Thoroughness::exhaustive);
    const Climb<double> found = climbed(moved(mesh, motion), 4, Thoroughness::exhaustive);
    REQUIRE(found.trail.size() == expected.trail.size());
    bool is_after_fit = false; // others agree with it, too
    for (std::size_t i = 0; i < expected.trail.size(); ++i) {
        CHECK(found.trail[i].hypothesis.effort == expected.trail[i].hypothesis.effort);
        const Effort effort = expected.trail[i].hypothesis.effort; // fits are as far as they converge
        INFO(to_string(effort));
        const int apart = effort == Effort::posed_fit ? 2 : 0; // those that have come to lie alike count once
        CHECK(std::abs(found.trail[i].candidates - expected.trail[i].candidates) <= apart);
        is_after_fit = is_after_fit || effort == Effort::rest_fit || effort == Effort::posed_fit;
        CHECK(found.trail[i].probability == Approx(expected.trail[i].probability).margin(is_after_fit ? 0.03 : 1e-6));
    }
}

TEST_CASE("beside an animal a person is looked for in no more curves, and is no likelier") {
    ExtractOptions options;
    const auto alone = climb(standing_man(), builtin_template("human21"), options);
    options.or_quadruped = true;
    const auto beside = climb(standing_man(), builtin_template("human21"), options);
    REQUIRE(beside.found.size() == 1);
    CHECK(beside.found.front().plan == BodyKind::human);
    CHECK(beside.trail.size() <= alone.trail.size() + 1);
    const double own = alone.found.front().candidate.probability, less = beside.found.front().candidate.probability;
    CHECK(less <= own);
    CHECK(less > own - 0.1);
}
