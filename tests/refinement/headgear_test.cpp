#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/refinement/impl/headgear.hpp>
#include <skelgen/refinement/impl/refine.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::core;
using namespace skelgen::test;

namespace {

constexpr double throat_height = 0.05, head_radius = 0.07, top_of_head = 0.25, top_of_horn = 0.5;

double ball(const Vec3& p, double height, double radius) { return (p - height * Vec3::UnitZ()).norm() - radius; }

/// A trunk, a neck that is thinnest at `throat_height`, and a head, around z.
double bust(const Vec3& p) {
    const double neck = p.head<2>().norm() - 0.04 - 2 * (p.z() - throat_height) * (p.z() - throat_height);
    return std::min({ball(p, -0.3, 0.2), std::max(neck, std::abs(p.z()) - 0.18), ball(p, 0.18, head_radius)});
}

double with_horn(const Vec3& p) {
    return std::min(bust(p), std::max(p.head<2>().norm() - 0.02, std::abs(p.z() - 0.35) - (top_of_horn - 0.35)));
}

/// A figure around z from the middle of its trunk to its top, the curve there, and the head's limb as it is drawn for a
/// head without anything on it.
struct Figure {
    Mesh mesh;
    Triangles adjacency;
    CurveSkeleton<double> curve;
    embedding::Embedding embedding;
    Limb<double> limb;

    template <typename Field>
    Figure(const Field& field, double top)
        : mesh(level_set(field, Vec3(-0.25, -0.25, -0.55), Vec3(0.25, 0.25, 0.55), 0.01)),
          adjacency(face_adjacency(mesh.faces)) {
        constexpr int head = 2;
        constexpr double first = -0.3, spacing = 0.01;
        const int count = static_cast<int>((top - first) / spacing);
        curve.nodes.setZero(count, 3);
        for (int i = 0; i < count; ++i) {
            curve.nodes(i, 2) = first + i * spacing;
            curve.radii.push_back(std::max(0.0, -field(Vec3(curve.nodes.row(i)))));
        }
        embedding::Chain chain{{0, 1, head}, std::vector<int>(static_cast<std::size_t>(count))};
        std::iota(chain.nodes.begin(), chain.nodes.end(), 0);
        embedding.chains.push_back(chain);
        limb.joints = {1, head};
        limb.from_tip = {0.25, 0.18}; // of an adult's, from the top
        limb.line = draw_centreline(slicer(), curve.nodes);
    }

    [[nodiscard]] Slicer<double> slicer() const { return {mesh, adjacency}; }
    [[nodiscard]] auto throat(int end = 2) const { return find_throat_on_curve(end, curve, embedding, slicer()); }
};

} // namespace

TEST_CASE("headgear: a throat is between trunk and head, whatever the head wears") {
    for (const Figure& figure : {Figure(bust, top_of_head), Figure(with_horn, top_of_horn)}) {
        const auto throat = figure.throat();
        REQUIRE(throat.has_value());
        CHECK((throat->place - Vec3(0, 0, throat_height)).norm() < 0.015);
        CHECK(throat->up.z() > 0.999);
        CHECK(throat->girth == Approx(head_radius).epsilon(0.05));
        CHECK(throat->arc == Approx(0.35).margin(0.015)); // from the first node
    }
}

TEST_CASE("headgear: no throat where nothing is thinner, where what is beyond is no head, and in other limbs") {
    const auto post = [](const Vec3& p) { return std::max(p.head<2>().norm() - 0.06, std::abs(p.z()) - 0.4); };
    CHECK_FALSE(Figure(post, 0.4).throat().has_value());
    const auto knob = [](const Vec3& p) { // a stick with a thick end on the trunk: no more a head than a horn's tip is
        const double stick = std::max(p.head<2>().norm() - 0.02, std::abs(p.z()) - 0.2);
        return std::min({ball(p, -0.3, 0.2), stick, ball(p, 0.2, 0.04)});
    };
    CHECK_FALSE(Figure(knob, 0.24).throat().has_value());
    CHECK_FALSE(Figure(bust, top_of_head).throat(1).has_value());
}

TEST_CASE("headgear: a limb without it ends at the crown and has its neck below the throat") {
    const Figure bare(bust, top_of_head), horned(with_horn, top_of_horn);
    CHECK_FALSE(has_neck_in_head(bare.limb, bare.throat().value(), bare.limb.from_tip.front()));
    const auto throat = horned.throat();
    REQUIRE(throat.has_value());
    CHECK(has_neck_in_head(horned.limb, *throat, horned.limb.from_tip.front()));

    const Limb<double> limb = without_headgear(horned.limb, *throat, horned.slicer());
    CHECK_FALSE(has_neck_in_head(limb, *throat, horned.limb.from_tip.front()));
    const double height = head_radius / 0.263; // of a head of that girth, from the neck to its crown
    CHECK(tip_of(limb).z() == Approx(throat_height + 0.8 * height).margin(0.02));
    const double neck = point_on(limb, arc_of(limb, 0)).z(), head = point_on(limb, arc_of(limb, 1)).z();
    CHECK(neck == Approx(throat_height - 0.11 * height).margin(0.02));
    CHECK(head - neck == Approx(0.25 - 0.18).margin(0.005)); // as an adult's
}

TEMPLATE_TEST_CASE("headgear: a child's head has its joint where an adult's is, a drawn figure's goes with its size",
                   "", float, double) {
    using Scalar = TestType;
    CHECK(head_joint_growth(Scalar(1)) == Scalar(1));
    CHECK(head_joint_growth(Scalar(1.5)) == Scalar(1));
    CHECK(head_joint_growth(Scalar(2)) == Scalar(2));
    CHECK(head_joint_growth(Scalar(3)) == Scalar(3));
    CHECK(head_joint_growth(Scalar(1.75)) == Approx(1 + 0.5 * 0.75));
}

TEST_CASE("a head that shows none so near the top is looked for as far down as the arms, not below them") {
    const auto body = body_of<double>(level_set(bust, Vec3(-0.25, -0.25, -0.55), Vec3(0.25, 0.25, 0.55), 0.01));
    const Slicer<double> slicer(body);
    const auto end = end_point_near(body, Vec3(0, 0, top_of_head));
    Limb<double> limb;
    limb.joints = {joint_of(JointRole::neck), joint_of(JointRole::head)};
    limb.from_tip = {0.055, 0.04}; // its head is more than twice as broad as that
    limb = draw_limb(std::move(limb), slicer, end);
    const RefinementOptions options;
    REQUIRE_FALSE(refinement::detail::head_of(limb, slicer, options.head));

    const double to_arms = std::numeric_limits<double>::infinity(), to_face = 0.1;
    const auto larger = refinement::detail::with_far_larger_head(limb, slicer, end, to_arms, options);
    REQUIRE(larger);
    CHECK(larger->from_tip.front() > to_face);
    CHECK_FALSE(refinement::detail::with_far_larger_head(limb, slicer, end, to_face, options));
}

TEST_CASE("how far it is to the nearest arm") {
    const auto body = body_of<double>(sphere(1, 4));
    const Slicer<double> slicer(body);
    const auto end = end_point_near(body, Vec3::UnitZ());
    const auto arm = [](const Vec3& from) {
        return limb_along({0.5 * from, 2 * from},
                          {joint_of(JointRole::shoulder, Side::left), joint_of(JointRole::elbow, Side::left)},
                          {1.0, 0.5});
    };
    const SkeletonTemplate& human = builtin_template("human21");
    const auto distance = [&](const std::vector<Limb<double>>& limbs) {
        return refinement::detail::distance_to_arms(end, limbs, slicer, human);
    };
    CHECK(distance({arm(Vec3::UnitX())}) == Approx(pi / 2).epsilon(0.03));
    CHECK(distance({arm(-Vec3::UnitZ()), arm(Vec3(0, 1, 1).normalized())}) == Approx(pi / 4).epsilon(0.03));
    CHECK(std::isinf(distance({})));
}
