// The straight line from a body, its curve and a template to a skeleton, as values.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/template_rules.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/search/ladder.hpp>

#include "catch.hpp"
#include "embedding/human_curve.hpp"
#include "fixture_bodies.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::search;
using namespace skelgen::test;

namespace {

/// A body with its curve and its truth.
struct PreparedBody {
    FixtureBody known;
    Body<double> body;
    curve::CurveResult<double> curve;
};

/// The walking woman with a whole curve, made once.
const PreparedBody& walker() {
    static const PreparedBody made = [] {
        FixtureBody known = load_fixture_body("walking-woman");
        Body<double> body = prepare(known.mesh);
        curve::CurveResult<double> curve = find_curve(body);
        return PreparedBody{std::move(known), std::move(body), std::move(curve)};
    }();
    return made;
}

/// Without the joints of that role; their children hang on their parents.
SkeletonTemplate without(const SkeletonTemplate& t, JointRole role) {
    SkeletonTemplate out{t.name + "-less", {}};
    std::vector<int> index(t.joints.size(), -1); // of a joint, or of the nearest kept one above it
    for (std::size_t j = 0; j < t.joints.size(); ++j) {
        const int parent = t.joints[j].parent < 0 ? -1 : index[static_cast<std::size_t>(t.joints[j].parent)];
        index[j] = parent;
        if (t.joints[j].role == role) continue;
        index[j] = static_cast<int>(out.joints.size());
        out.joints.push_back(t.joints[j]);
        out.joints.back().parent = parent;
    }
    return out;
}

double distance(const KinematicSkeleton<double>& a, const KinematicSkeleton<double>& b, const std::string& name) {
    return (a.joints[static_cast<std::size_t>(find_joint(a, name))].position -
            b.joints[static_cast<std::size_t>(find_joint(b, name))].position)
        .norm();
}

/// Why no human21 is found in a body and a curve; none where one is.
Refusal refusal_of(const Body<double>& body, const CurveSkeleton<double>& curve) {
    curve::CurveResult<double> found;
    found.curve = curve;
    const auto candidate = skeleton_of(body, found, builtin_template("human21"));
    if (candidate) return Refusal::none;
    CHECK(candidate.failure().what.find("no human body: ") == 0);
    return candidate.failure().reason;
}

/// A path of nodes along x, a star's rays at its start.
CurveSkeleton<double> path_with_rays(int nodes, int rays) {
    CurveSkeleton<double> curve;
    curve.nodes.resize(nodes + rays, 3);
    for (int i = 0; i < nodes + rays; ++i) {
        curve.nodes.row(i) << (i < nodes ? 0.1 * i : std::cos(i)), i < nodes ? 0 : std::sin(i), 0;
        curve.regions.push_back({});
        curve.radii.push_back(0.05);
        if (i > 0) curve.edges.push_back({i < nodes ? i - 1 : 0, i});
    }
    return curve;
}

} // namespace

TEST_CASE("what a search tries first is prepare, find_curve of a draft and skeleton_of") {
    const Mesh& mesh = walker().known.mesh;
    const Body<double>& body = walker().body;
    ExtractOptions options;
    options.budget = 1;
    const curve::CurveResult<double> draft = find_curve(body, curve_options(Effort::draft, options.curve));
    const auto alone = skeleton_of(body, draft, builtin_template("human21"));
    REQUIRE(alone);
    const KinematicSkeleton<double> skeleton = surface::to_input(body, alone->skeleton);
    const auto climb = search::climb(mesh, builtin_template("human21"), options, Thoroughness::exhaustive);
    REQUIRE_FALSE(climb.found.empty());
    const Found<double>& first = climb.found.front();
    const KinematicSkeleton<double> found = surface::to_input(*first.body, first.candidate.skeleton);
    for (std::size_t j = 0; j < found.joints.size(); ++j)
        CHECK(skeleton.joints[j].position == found.joints[j].position);
    CHECK(skeleton.end_points == found.end_points);
    CHECK(alone->geodesic_diameter == first.candidate.geodesic_diameter);
    CHECK(first.curve->curve.nodes == draft.curve.nodes);

    const Extraction<double> whole = extract(mesh, options);
    CHECK(body.similarity.scale * alone->geodesic_diameter == Approx(whole.geodesic_diameter).epsilon(0.05));
    CHECK(whole.body.mesh.vertices == body.mesh.vertices);
    CHECK(whole.mesh.vertices == mesh.vertices);
    CHECK(whole.skeleton_template.name == "human21");

    CHECK(draft.converged);
    CHECK(whole.timings.surface > 0);
    CHECK(whole.timings.curve > 0);
    CHECK(whole.timings.refine > 0);
    CHECK(whole.timings.surface + whole.timings.curve + whole.timings.embed + whole.timings.refine +
              whole.timings.sides <=
          whole.timings.total);
}

TEST_CASE("a skeleton of the same body, curve and template is the same, to the last bit") {
    const auto& [known, body, curve] = walker();
    const auto a = skeleton_of(body, curve, builtin_template("human21"));
    const auto b = skeleton_of(body, curve, builtin_template("human21"));
    REQUIRE(a);
    REQUIRE(b);
    for (std::size_t j = 0; j < a->skeleton.joints.size(); ++j) {
        CHECK(a->skeleton.joints[j].position == b->skeleton.joints[j].position);
        CHECK(a->skeleton.joints[j].radius == b->skeleton.joints[j].radius);
    }
    CHECK(a->skeleton.end_points == b->skeleton.end_points);
    CHECK(a->evidence.values == b->evidence.values);
    CHECK(a->probability == b->probability);
    CHECK(a->doubt == b->doubt);
    CHECK(a->geodesic_diameter == b->geodesic_diameter);
    CHECK(a->skeleton.quality.matched_nodes == 7);
}

TEST_CASE("a template that was laid into the curve before gives the same skeleton") {
    const auto& [known, body, curve] = walker();
    const SkeletonTemplate& human = builtin_template("human21");
    const auto embedding = embedding::embed(curve.curve, human);
    REQUIRE(embedding);
    const auto from_laid = skeleton_of(body, curve, embedding::LaidTemplate{human, *embedding});
    const auto at_once = skeleton_of(body, curve, human);
    REQUIRE(from_laid);
    REQUIRE(at_once);
    for (std::size_t j = 0; j < at_once->skeleton.joints.size(); ++j)
        CHECK(from_laid->skeleton.joints[j].position == at_once->skeleton.joints[j].position);
    CHECK(from_laid->probability == at_once->probability);
}

TEST_CASE("where the curve has lost an arm to the other one, the skeleton's arms lie in each other") {
    const auto& [known, body, whole_curve] = walker();
    const SkeletonTemplate& human = builtin_template("human21");
    curve::CurveResult<double> curve = whole_curve;
    const auto whole = skeleton_of(body, curve, human);
    REQUIRE(whole);

    const auto embedding = embedding::embed(curve.curve, human);
    REQUIRE(embedding);
    const auto arm_of = [&](Side side) {
        for (const embedding::Chain& chain : embedding->chains)
            if (chain.joints.back() == find_joint(human, JointRole::hand, side)) return chain.nodes;
        return std::vector<int>{};
    };
    const std::vector<int> lost = arm_of(Side::left), kept = arm_of(Side::right);
    for (std::size_t i = 1; i < lost.size(); ++i)
        curve.curve.nodes.row(lost[i]) = curve.curve.nodes.row(kept[i * (kept.size() - 1) / (lost.size() - 1)]);
    const auto found = skeleton_of(body, curve, human);
    REQUIRE(found);
    CHECK(whole->evidence[Witness::apart] < 0.5);
    CHECK(found->evidence[Witness::apart] > 0.8);
}

TEST_CASE("another template takes the same body and curve") {
    const auto& [known, body, curve] = walker();
    const auto human = skeleton_of(body, curve, builtin_template("human21"));
    const auto pinocchio = skeleton_of(body, curve, builtin_template("pinocchio18"));
    REQUIRE(human);
    REQUIRE(pinocchio);
    CHECK(pinocchio->skeleton.joints.size() == 18);
    CHECK(pinocchio->skeleton.template_name == "pinocchio18");
    for (const std::string side : {"left", "right"}) {
        CHECK(distance(human->skeleton, pinocchio->skeleton, side + "_elbow") < 0.015 * human->geodesic_diameter);
        CHECK(distance(human->skeleton, pinocchio->skeleton, side + "_ankle") < 0.015 * human->geodesic_diameter);
    }
}

TEST_CASE("the unit of a template does not matter") {
    const auto& [known, body, curve] = walker();
    SkeletonTemplate centimetres = builtin_template("human21");
    for (TemplateJoint& joint : centimetres.joints) {
        joint.position *= 100;
        joint.radius *= 100;
        if (joint.tip) *joint.tip *= 100;
    }
    const auto expected = skeleton_of(body, curve, builtin_template("human21"));
    const auto found = skeleton_of(body, curve, centimetres);
    REQUIRE(expected);
    REQUIRE(found);
    for (const Joint<double>& joint : expected->skeleton.joints)
        CHECK(distance(found->skeleton, expected->skeleton, joint.name) < 1e-10 * expected->geodesic_diameter);
}

TEST_CASE("a template that may lack joints is solved without them, sides and all") {
    const auto& [known, body, curve] = walker();
    using enum JointRole;
    SkeletonTemplate least = builtin_template("human21");
    for (const JointRole role : {waist, neck, shoulder, elbow, wrist, ankle}) {
        least = without(least, role);
        for (const SkeletonTemplate& wanted : {without(builtin_template("human21"), role), least}) {
            INFO("without " << to_string(role) << ", " << wanted.joints.size() << " joints");
            const auto found = skeleton_of(body, curve, wanted);
            REQUIRE(found);
            const KinematicSkeleton<double> skeleton = surface::to_input(body, found->skeleton);
            const double diameter = body.similarity.scale * found->geodesic_diameter;
            for (const auto& [name, place] : known.truth.joints) {
                const int joint = find_joint(skeleton, name);
                if (joint < 0) continue;
                INFO(name);
                const Vec3 position = skeleton.joints[static_cast<std::size_t>(joint)].position;
                const bool in_limb = name.find('_') != std::string::npos;
                // Without a neck nothing says where on the trunk a chest ends.
                CHECK((position - place).norm() < (in_limb ? 0.06 : 0.1) * diameter);
            }
        }
    }
    CHECK(least.joints.size() == 11);
}

TEST_CASE("that there is no body is a result, not an exception: a ball's curve is a point") {
    const Body<double> ball = prepare(sphere(1, 3));
    const curve::CurveResult<double> point = find_curve(ball);
    REQUIRE(point.is_point);
    const auto found = skeleton_of(ball, point, builtin_template("human21"));
    REQUIRE_FALSE(found);
    CHECK(found.failure().reason == Refusal::too_compact);
    CHECK(found.failure().what.find("no human body: too compact") == 0);
}

TEST_CASE("a curve that no template can be laid into is refused for what it is") {
    const Body<double>& body = walker().body;
    CHECK(refusal_of(body, path_with_rays(5, 0)) == Refusal::too_few_ends);
    CHECK(refusal_of(body, path_with_rays(2, 200)) == Refusal::too_many_ends);
    CurveSkeleton<double> in_pieces = human_curve();
    in_pieces.edges.erase(in_pieces.edges.begin() + 3);
    CHECK(refusal_of(body, in_pieces) == Refusal::curve_in_pieces);
    CHECK(refusal_of(body, walker().curve.curve) == Refusal::none);
}

TEST_CASE("where both legs are one, the hips have no extent") {
    const auto& [known, body, curve] = walker();
    const SkeletonTemplate& human = builtin_template("human21");
    const auto embedding = embedding::embed(curve.curve, human);
    REQUIRE(embedding);
    embedding::LaidTemplate laid{human, *embedding};
    const auto leg_of = [&](Side side) -> embedding::Chain& {
        const int foot = find_joint(human, JointRole::foot, side);
        return *std::find_if(laid.embedding.chains.begin(), laid.embedding.chains.end(),
                             [&](const embedding::Chain& chain) { return chain.joints.back() == foot; });
    };
    leg_of(Side::left).nodes = leg_of(Side::right).nodes;
    laid.embedding.node_of_joint[static_cast<std::size_t>(find_joint(human, JointRole::foot, Side::left))] =
        laid.embedding.node_of_joint[static_cast<std::size_t>(find_joint(human, JointRole::foot, Side::right))];
    const auto found = skeleton_of(body, curve, laid);
    REQUIRE_FALSE(found);
    CHECK(found.failure().reason == Refusal::flat_trunk);
}

TEST_CASE("a template that breaks a rule is refused before anything is computed, and so is an option") {
    const Body<double> ball = prepare(sphere(1, 3));
    SkeletonTemplate wanted = builtin_template("human21");
    const auto error_of = [&](const ExtractOptions& options) {
        try {
            static_cast<void>(skeleton_of(ball, curve::CurveResult<double>{}, wanted, options));
        } catch (const Error& error) {
            return error.code();
        }
        return ErrorCode::internal;
    };
    ExtractOptions options;
    options.matching.distance_scale = 0;
    CHECK(error_of(options) == ErrorCode::usage);
    wanted.joints.pop_back();
    CHECK(error_of({}) == ErrorCode::bad_input);
}
