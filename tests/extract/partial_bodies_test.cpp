// Bodies that lack a part, on a body made by code.

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/extract.hpp>

#include "catch.hpp"
#include "fixture_bodies.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::test;

namespace {

/// The body without the faces that `is_off` says by their middles.
template <typename IsOff>
TriangleMesh<double> without_faces(const TriangleMesh<double>& mesh, const IsOff& is_off) {
    TriangleMesh<double> out{mesh.vertices, Triangles(mesh.faces.rows(), 3)};
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        Vector3<double> middle = Vector3<double>::Zero();
        for (int k = 0; k < 3; ++k) middle += point(mesh.vertices, mesh.faces(f, k)) / 3;
        if (!is_off(middle)) out.faces.row(kept++) = mesh.faces.row(f);
    }
    out.faces.conservativeResize(kept, 3);
    return out;
}

/// The body without what is nearest to one of these joints.
TriangleMesh<double> without_parts(const FixtureBody& body, const std::set<std::string>& joints) {
    return without_faces(body.mesh, [&](const Vector3<double>& place) {
        const auto nearest =
            std::min_element(body.truth.joints.begin(), body.truth.joints.end(), [&](const auto& a, const auto& b) {
                return (a.second - place).norm() < (b.second - place).norm();
            });
        return joints.count(nearest->first) > 0;
    });
}

TriangleMesh<double> without_head(const FixtureBody& body) {
    const auto at = [&](const std::string& name) {
        return std::find_if(body.truth.joints.begin(), body.truth.joints.end(),
                            [&](const auto& joint) { return joint.first == name; })
            ->second;
    };
    const Vector3<double> neck = at("neck"), up = at("head") - neck;
    return without_faces(body.mesh, [&](const Vector3<double>& place) {
        return (place - neck).dot(up) > 0.3 * up.squaredNorm() && (place - neck).norm() < 0.17 * body.truth.scale;
    });
}

/// Exactly these joints are said to be missing, and all others are where they are. `at_stub`: one that may be said to
/// be where the limb is cut off.
void check_lacks(const TriangleMesh<double>& cut, const FixtureBody& body, const std::set<std::string>& missing,
                 const std::string& at_stub = {}) {
    const Extraction<double> extraction = extract(cut);
    const KinematicSkeleton<double>& found = extraction.skeleton;
    for (std::size_t j = 0; j < found.joints.size(); ++j) {
        const Joint<double>& joint = found.joints[j];
        INFO(joint.name);
        if (joint.name == at_stub) continue;
        CHECK(joint.is_present == (missing.count(joint.name) == 0));
        if (joint.is_present)
            CHECK((joint.position - body.truth.joints[j].second).norm() < 0.08 * body.truth.scale);
        else
            CHECK(joint.confidence == 0);
    }
    CHECK_FALSE(found.quality.warnings.empty());
    const auto likeliest = std::max_element(extraction.trail.begin(), extraction.trail.end(),
                                            [](const auto& a, const auto& b) { return a.probability < b.probability; });
    REQUIRE(likeliest != extraction.trail.end());
    CHECK(likeliest->lacks_limb);
}

} // namespace

TEST_CASE("a body without an arm, a leg or its head has the joints that are left, on the right sides") {
    const FixtureBody body = load_fixture_body("walking-woman");
    for (const std::set<std::string>& missing :
         {std::set<std::string>{"left_elbow", "left_wrist", "left_hand"}, {"right_elbow", "right_wrist", "right_hand"}})
        check_lacks(without_parts(body, missing), body, missing);
    // What is left of a thigh may pass for all of it.
    const std::set<std::string> leg{"left_knee", "left_ankle", "left_foot"};
    check_lacks(without_parts(body, leg), body, leg, "left_knee");
    check_lacks(without_head(body), body, {"head"});
}

TEST_CASE("that a body lacks its head is said, and costs confidence") {
    const FixtureBody body = load_fixture_body("standing-man");
    const auto found = extract(without_head(body));
    const auto& warnings = found.skeleton.quality.warnings;
    CHECK(std::find(warnings.begin(), warnings.end(), "the body seems to lack its head") != warnings.end());
    CHECK(found.skeleton.quality.sides_confidence < extract(body.mesh).skeleton.quality.sides_confidence);
}
