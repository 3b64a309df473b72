// The pipeline's halves as values: a body, its curve, a template fitted to both.

#include <string>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/template_rules.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/extract.hpp>

#include "catch.hpp"
#include "extract/same_skeleton.hpp"
#include "fixture_bodies.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::test;

namespace {

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

template <typename Edit>
std::string refusal(Edit&& edit) {
    ExtractOptions options;
    edit(options);
    try {
        static_cast<void>(extract_skeleton(sphere(1), options));
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
        return error.what();
    }
    return {};
}

double distance(const KinematicSkeleton<double>& a, const KinematicSkeleton<double>& b, const std::string& name) {
    return (a.joints[static_cast<std::size_t>(find_joint(a, name))].position -
            b.joints[static_cast<std::size_t>(find_joint(b, name))].position)
        .norm();
}

} // namespace

TEST_CASE("extract_skeleton is prepare, find_curve and fit, of most bodies with the curve of a first try") {
    const Mesh mesh = load_fixture_body("walking-woman").mesh;
    const Body<double> body = prepare(mesh);
    const curve::CurveResult<double> curve = find_curve(body, for_first_try({}).curve);
    const auto found = fit(body, curve, builtin_template("human21"));
    REQUIRE(found);
    const Extraction<double> whole = extract_skeleton(mesh);
    for (std::size_t j = 0; j < whole.skeleton.joints.size(); ++j)
        CHECK(found->skeleton.joints[j].position == whole.skeleton.joints[j].position);
    CHECK(found->geodesic_diameter == whole.geodesic_diameter);

    // The curve that comes out is the one that went in, made whole, in the input's coordinates.
    CHECK(curve.converged);
    CHECK(found->curve.nodes == surface::to_input(body, finished(curve, body).curve).nodes);
    CHECK(whole.timings.surface > 0);
    CHECK(whole.timings.curve > 0);
    CHECK(whole.timings.refine > 0);
    CHECK(whole.timings.surface + whole.timings.curve + whole.timings.embed + whole.timings.refine +
              whole.timings.sides <=
          whole.timings.total);
}

TEST_CASE("where the curve has lost an arm to the other one, another curve is looked for") {
    const Body<double> body = prepare(load_fixture_body("walking-woman").mesh);
    const SkeletonTemplate& human = builtin_template("human21");
    curve::CurveResult<double> curve = find_curve(body);
    const auto whole = fit(body, curve, human);
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
    const auto found = fit(body, curve, human);
    REQUIRE(found);
    for (const char* joint : {"left_elbow", "right_elbow", "left_hand", "right_hand"}) {
        INFO(joint);
        CHECK(distance(found->skeleton, whole->skeleton, joint) < 0.02 * whole->geodesic_diameter);
    }
}

TEST_CASE("another template takes the same body and curve") {
    const FixtureBody walker = load_fixture_body("walking-woman");
    const Body<double> body = prepare(walker.mesh);
    const curve::CurveResult<double> curve = find_curve(body);
    const auto human = fit(body, curve, builtin_template("human21"));
    const auto pinocchio = fit(body, curve, builtin_template("pinocchio18"));
    REQUIRE(human);
    REQUIRE(pinocchio);
    CHECK(pinocchio->skeleton.joints.size() == 18);
    for (const std::string side : {"left", "right"}) {
        CHECK(distance(human->skeleton, pinocchio->skeleton, side + "_elbow") < 0.03);
        CHECK(distance(human->skeleton, pinocchio->skeleton, side + "_ankle") < 0.03);
    }
}

TEST_CASE("the unit of a template does not matter") {
    const Mesh mesh = load_fixture_body("kneeling-boy").mesh;
    ExtractOptions centimetres;
    centimetres.skeleton_template = builtin_template("human21");
    for (TemplateJoint& joint : centimetres.skeleton_template.joints) {
        joint.position *= 100;
        joint.radius *= 100;
        if (joint.tip) *joint.tip *= 100;
    }
    CHECK(difference(extract_skeleton(mesh, centimetres), extract_skeleton(mesh)).joint < 1e-10);
}

TEST_CASE("a template that may lack joints is solved without them, sides and all") {
    const FixtureBody walker = load_fixture_body("walking-woman");
    const Body<double> body = prepare(walker.mesh);
    const curve::CurveResult<double> curve = find_curve(body);
    using enum JointRole;
    SkeletonTemplate least = builtin_template("human21");
    for (const JointRole role : {waist, neck, shoulder, elbow, wrist, ankle}) {
        least = without(least, role);
        for (const SkeletonTemplate& wanted : {without(builtin_template("human21"), role), least}) {
            INFO("without " << to_string(role) << ", " << wanted.joints.size() << " joints");
            const auto found = fit(body, curve, wanted);
            REQUIRE(found);
            for (const auto& [name, place] : walker.truth.joints) {
                const int joint = find_joint(found->skeleton, name);
                if (joint < 0) continue;
                INFO(name);
                const Vec3 position = found->skeleton.joints[static_cast<std::size_t>(joint)].position;
                const bool in_limb =
                    found->skeleton.joints[static_cast<std::size_t>(joint)].name.find('_') != std::string::npos;
                // Without a neck nothing says where on the trunk a chest ends.
                CHECK((position - place).norm() < (in_limb ? 0.06 : 0.1) * found->geodesic_diameter);
            }
        }
    }
    CHECK(least.joints.size() == 11);
}

TEST_CASE("that there is no body is a result, not an exception") {
    const Body<double> ball = prepare(sphere(1, 4));
    const auto found = fit(ball, find_curve(ball), builtin_template("human21"));
    REQUIRE_FALSE(found);
    CHECK(found.failure().what.find("no human body") == 0);

    const Mesh two = side_by_side(sphere(1), moved(sphere(0.5), {Eigen::Matrix3d::Identity(), 1, Vec3(3, 0, 0)}));
    CHECK_THROWS_AS(extract_skeleton(two), Error);
}

TEST_CASE("a template that breaks a rule is refused before anything is computed") {
    const Body<double> ball = prepare(sphere(1));
    SkeletonTemplate wanted = builtin_template("human21");
    wanted.joints.pop_back();
    try {
        static_cast<void>(fit(ball, curve::CurveResult<double>{}, wanted));
        FAIL("it was accepted");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
    }
}

TEST_CASE("options out of their range are refused, with the range") {
    const std::string vertices = refusal([](auto& o) { o.curve.proxy.vertices = 0; });
    CHECK(vertices.find("option ") == 0);
    CHECK(vertices.find("is 0: it must be from ") != std::string::npos);
    CHECK_FALSE(refusal([](auto& o) { o.curve.contraction.iterations = -1; }).empty());
    CHECK_FALSE(refusal([](auto& o) { o.curve.contraction.laplacian_weight = std::nan(""); }).empty());
    CHECK_FALSE(refusal([](auto& o) { o.matching.distance_scale = 0; }).empty());
    CHECK_FALSE(refusal([](auto& o) { o.refinement.centreline.step = 0; }).empty());
    CHECK_FALSE(refusal([](auto& o) { o.refinement.head.slice = 0; }).empty());
    CHECK_FALSE(refusal([](auto& o) { o.prepare.denoise.most_passes = -1; }).empty());
    CHECK_FALSE(refusal([](auto& o) { o.sides.foot = -1; }).empty());
}
