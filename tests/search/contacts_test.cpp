#include <algorithm>
#include <limits>
#include <map>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/find_curve.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/search/impl/contacts.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::embedding;
using namespace skelgen::test;

namespace {

double thickness_of(const TemplateJoint& joint) {
    using enum JointRole;
    switch (joint.role) {
    case waist:
    case chest:
    case head:
        return 0.09;
    case hip:
    case knee:
        return 0.06;
    case wrist:
    case hand:
        return 0.03;
    default:
        return 0.045;
    }
}

/// human21's bones as round limbs of likely thicknesses; the left hand on the thigh, or, like the right one, free.
Mesh limbs(bool touching) {
    SkeletonTemplate human = builtin_template("human21");
    const auto joint = [&](const char* name) -> TemplateJoint& {
        return *std::find_if(human.joints.begin(), human.joints.end(), [&](const auto& j) { return j.name == name; });
    };
    if (touching) {
        joint("left_elbow").position = {0.33, 1.2, -0.02};
        joint("left_wrist").position = {0.22, 0.99, 0.06};
        joint("left_hand").position = {0.18, 0.9, 0.06};
        joint("left_hand").tip = Vec3(0.15, 0.82, 0.05);
        for (const char* name : {"left_hip", "left_knee", "left_ankle", "left_foot"}) // a step aside
            joint(name).position.x() += 0.04;
        joint("left_foot").tip->x() += 0.04;
    }
    struct Bone {
        Vec3 from, to;
        double radius;
    };
    std::vector<Bone> bones;
    for (const TemplateJoint& j : human.joints) {
        if (j.parent >= 0) bones.push_back({human.joint(j.parent).position, j.position, thickness_of(j)});
        if (j.tip) bones.push_back({j.position, *j.tip, thickness_of(j)});
    }
    const auto field = [&](const Vec3& p) {
        double distance = std::numeric_limits<double>::infinity();
        for (const Bone& bone : bones)
            distance = std::min(distance, segment_distance(p, bone.from, bone.to) - bone.radius);
        return distance;
    };
    return level_set(field, {-1, -0.1, -0.2}, {1, 1.95, 0.35}, 0.02);
}

bool is_closed(const Triangles& adjacency) { return adjacency.minCoeff() >= 0; }

} // namespace

TEMPLATE_TEST_CASE("a body with a hand on its thigh is cut there, and its curve is a tree that the template fits", "",
                   float, double) {
    const Mesh mesh = limbs(true);
    const Body<TestType> body = surface::prepare(TriangleMesh<TestType>{mesh.vertices.cast<TestType>(), mesh.faces});
    const curve::CurveResult<TestType> looped = curve::find_curve(body);
    REQUIRE(core::cycle_count(looped.curve) == 1);

    const auto ways = search::cut_at_contacts(body, looped.curve, builtin_template("human21"));
    REQUIRE(!ways.empty());
    const Body<TestType>* parted = &ways.front();
    const CurveSkeleton<TestType> tree = curve::find_curve(*parted).curve;
    CHECK(core::cycle_count(tree) == 0);
    CHECK(embed(tree, builtin_template("human21")));
    CHECK(is_closed(parted->adjacency));
    CHECK(core::surface_area(parted->mesh) > 0.98 * core::surface_area(body.mesh));
    CHECK(core::surface_area(parted->mesh) < 1.1 * core::surface_area(body.mesh));
    CHECK(parted->similarity.scale == body.similarity.scale);

    // Vertices keep their source and, but along the cut, where they draw back, their place; those that close the holes
    // have no source.
    std::map<int, int> vertex_of_source;
    for (std::size_t v = 0; v < body.source.size(); ++v) vertex_of_source[body.source[v]] = static_cast<int>(v);
    REQUIRE(parted->source.size() == static_cast<std::size_t>(parted->mesh.vertices.rows()));
    std::size_t added = 0, moved = 0;
    for (std::size_t v = 0; v < parted->source.size(); ++v) {
        const int source = parted->source[v];
        added += source < 0;
        if (source < 0) continue;
        const Vector3<TestType> here = parted->mesh.vertices.row(static_cast<Eigen::Index>(v));
        const TestType distance = (here - body.mesh.vertices.row(vertex_of_source.at(source)).transpose()).norm();
        REQUIRE(distance < 0.02); // a cell of the level set
        moved += distance > 0;
    }
    CHECK(moved < parted->source.size() / 50);
    CHECK(added >= 2);
    CHECK(added < 20);
}

TEST_CASE("a body that stands free has nothing to part") {
    const Body<double> body = surface::prepare(limbs(false));
    const curve::CurveResult<double> found = curve::find_curve(body);
    REQUIRE(core::cycle_count(found.curve) == 0);
    CHECK(search::cut_at_contacts(body, found.curve, builtin_template("human21")).empty());
}

TEST_CASE("a ring is not cut: the template does not fit what would be left") {
    const Body<double> body = surface::prepare(torus(1, 0.2));
    const curve::CurveResult<double> found = curve::find_curve(body);
    REQUIRE(core::cycle_count(found.curve) == 1);
    CHECK(search::cut_at_contacts(body, found.curve, builtin_template("human21")).empty());
}

TEST_CASE("more loops than a body can have contacts are not cut one after the other") {
    const Body<double> body = surface::prepare(limbs(false));
    CurveSkeleton<double> ladder = curve::find_curve(body).curve;
    const auto node = [&](int i) { return i % static_cast<int>(ladder.nodes.rows()); };
    for (int i = 0; core::cycle_count(ladder) <= search::most_contacts; ++i)
        ladder.edges.push_back({node(i), node(i + 7)});
    CHECK(search::cut_at_contacts(body, ladder, builtin_template("human21")).empty());
}
