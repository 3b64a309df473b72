#include <skelgen/applications/bone_sections.hpp>

#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "human.hpp"
#include "shapes.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using test::human;

TEMPLATE_TEST_CASE("sections: circles where planes across the bones cut a ball around them", "[applications][sections]",
                   float, double) {
    const auto skeleton = rest_skeleton<TestType>(human());
    const double radius = 3; // far around all of the skeleton
    const TriangleMesh<double> ball = test::sphere(radius);
    const auto body = surface::prepare(TriangleMesh<TestType>{ball.vertices.cast<TestType>(), ball.faces});
    const int per_bone = 3;
    const auto sections = bone_sections(body, skeleton, human(), per_bone);
    REQUIRE(sections.size() == 21 * per_bone);
    for (std::size_t i = 0; i < sections.size(); ++i) {
        const auto joint = static_cast<std::size_t>(sections[i].joint);
        REQUIRE(joint == i / per_bone);
        const Vector3<TestType> from = skeleton.joints[joint].position;
        const Vector3<TestType> bone = bone_end(skeleton, human(), sections[i].joint) - from;
        const TestType along = (TestType(i % per_bone) + TestType(0.5)) / TestType(per_bone);
        REQUIRE(sections[i].points.size() > 20);
        for (const Vector3<TestType>& point : sections[i].points) {
            CHECK(std::abs((point - from).dot(bone) / bone.squaredNorm() - along) * bone.norm() < 1e-4);
            CHECK(point.norm() == Approx(radius).epsilon(0.01)); // faces lie a little inside
        }
    }
}

TEST_CASE("sections: a bone far outside has none; bad input is refused", "[applications][sections]") {
    const auto body = surface::prepare(test::sphere(1, 3));
    auto skeleton = rest_skeleton<double>(human());
    for (auto& joint : skeleton.joints) joint.position += Eigen::Vector3d(10, 0, 0);
    for (auto& [name, place] : skeleton.end_points) place += Eigen::Vector3d(10, 0, 0);
    CHECK(bone_sections(body, skeleton, human()).empty());
    CHECK_THROWS_AS(bone_sections(body, skeleton, human(), 0), Error);
    skeleton.joints.pop_back();
    CHECK_THROWS_AS(bone_sections(body, skeleton, human()), Error);
}

} // namespace
