// Bodies at rest, laid into their surface alone.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/find_curve.hpp>
#include <skelgen/embedding/reduced_graph.hpp>
#include <skelgen/search/line.hpp>
#include <skelgen/search/rest_fit.hpp>
#include <skelgen/surface/body.hpp>

#include "catch.hpp"
#include "fixture_bodies.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::search;
using namespace skelgen::test;

namespace {

const SkeletonTemplate& human21() { return builtin_template("human21"); }

Mesh turned(Mesh mesh, const Eigen::Quaterniond& rotation) {
    mesh.vertices = (mesh.vertices * rotation.toRotationMatrix().transpose()).eval();
    return mesh;
}

double extent_of(const Mesh& mesh) {
    return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).maxCoeff();
}

} // namespace

TEST_CASE("the planes in which a box mirrors itself lie in its middle, across its sides") {
    const Body<double> body = prepare(box(Vec3(1, 2, 4), 3));
    const auto planes = mirror_planes(body);
    REQUIRE(planes.size() == 3);
    const Vec3 middle = (body.mesh.vertices.colwise().maxCoeff() + body.mesh.vertices.colwise().minCoeff()) / 2;
    std::set<Eigen::Index> axes;
    for (const MirrorPlane& plane : planes) {
        Eigen::Index axis = 0;
        CHECK(plane.normal.cwiseAbs().maxCoeff(&axis) > 0.999);
        axes.insert(axis);
        CHECK(plane.offset == Approx(plane.normal.dot(middle)).margin(0.01));
        CHECK(plane.share > 0.8); // places are taken of the surface, some of which have none so near
    }
    CHECK(axes.size() == 3);
    CHECK(planes[0].share >= planes[1].share);
    CHECK(planes[1].share >= planes[2].share);
}

TEST_CASE("who stands at rest is found by the surface alone, left on the left, whichever way turned") {
    const std::vector<Eigen::Quaterniond> turns{Eigen::Quaterniond::Identity(),
                                                Eigen::Quaterniond(Eigen::AngleAxisd(3.1, Vec3::UnitZ())),
                                                Eigen::Quaterniond(Eigen::AngleAxisd(3.0, Vec3::UnitX())),
                                                Eigen::Quaterniond(Eigen::AngleAxisd(1.3, Vec3(1, 2, 3).normalized()))};
    for (const std::string name : {"standing-man", "figure"}) {
        const FixtureBody known = load_fixture_body(name);
        const double extent = extent_of(known.mesh);
        for (const Eigen::Quaterniond& turn : turns) {
            INFO(name << ", turned by " << turn.angularDistance(Eigen::Quaterniond::Identity()));
            const Body<double> body = prepare(turned(known.mesh, turn));
            const auto fit = fit_at_rest(body, human21());
            REQUIRE(fit);
            CHECK(fit->mirror > 0.8);
            CHECK(fit->skeleton_template.is_adapted);
            const auto found =
                skeleton_of(body, find_curve(body, curve_options(Effort::draft, {})), place_joints(body, *fit));
            REQUIRE(found);
            CHECK(found->evidence[Witness::fitted] == 1);
            CHECK(found->evidence[Witness::fit_cost] == std::log(fit->cost));
            const auto skeleton = surface::to_input(body, found->skeleton);
            double sum = 0;
            for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
                const Joint<double>& joint = skeleton.joints[j];
                const Vec3 truth = turn * known.truth.joints.at(j).second;
                const double error = (joint.position - truth).norm() / extent;
                INFO(joint.name);
                CHECK(error < (joint.name == "head" ? 0.15 : 0.1)); // limbs, and sides: these are farther apart
                sum += error;
            }
            CHECK(sum / static_cast<double>(skeleton.joints.size()) < 0.04);
        }
    }
}

TEST_CASE("the axes of a body at rest are a curve with the template in it, each bone once") {
    const Body<double> body = prepare(load_fixture_body("standing-man").mesh);
    const auto fit = fit_at_rest(body, human21());
    REQUIRE(fit);
    const auto graph = core::curve_graph(fit->lines);
    for (const double distance : core::shortest_paths(graph, 0).distance) CHECK(std::isfinite(distance));
    CHECK(fit->lines.edges.size() + 1 == static_cast<std::size_t>(fit->lines.nodes.rows())); // a tree
    REQUIRE(fit->lines.radii.size() == static_cast<std::size_t>(fit->lines.nodes.rows()));
    CHECK(*std::min_element(fit->lines.radii.begin(), fit->lines.radii.end()) >= 0);

    const auto reduced = embedding::reduce<double>(human21());
    for (int j = 0; j < static_cast<int>(human21().joints.size()); ++j) {
        INFO(human21().joint(j).name);
        const bool is_kept = std::count(reduced.origin.begin(), reduced.origin.end(), j) > 0;
        CHECK((fit->embedding.node_of_joint[static_cast<std::size_t>(j)] >= 0) == is_kept);
    }
    std::set<std::pair<int, int>> bones;
    std::size_t count = 0;
    for (const embedding::Chain& chain : fit->embedding.chains) {
        for (std::size_t i = 1; i < chain.joints.size(); ++i, ++count) {
            CHECK(human21().joint(chain.joints[i]).parent == chain.joints[i - 1]);
            bones.emplace(chain.joints[i - 1], chain.joints[i]);
        }
        CHECK(chain.nodes.front() == fit->embedding.node_of_joint[static_cast<std::size_t>(chain.joints.front())]);
        CHECK(chain.nodes.back() == fit->embedding.node_of_joint[static_cast<std::size_t>(chain.joints.back())]);
    }
    CHECK(count == human21().joints.size() - 1);
    CHECK(bones.size() == count);
}

TEST_CASE("of a body at rest the ends of the limbs are placed by the surface, what is nearer the trunk as laid") {
    using enum JointRole;
    const Body<double> body = prepare(load_fixture_body("standing-man").mesh);
    const auto fit = fit_at_rest(body, human21());
    REQUIRE(fit);
    const auto placed = place_joints(body, *fit);
    for (int j = 0; j < static_cast<int>(human21().joints.size()); ++j) {
        INFO(human21().joint(j).name);
        const JointRole role = human21().joint(j).role;
        const bool is_outer = role == wrist || role == hand || role == ankle || role == foot;
        CHECK((core::point(placed.joints.positions, j) != core::point(fit->joints.positions, j)) == is_outer);
    }
}

TEST_CASE("a body at rest is laid to where a joint is known to be, and so is the other side's") {
    const Body<double> body = prepare(load_fixture_body("standing-man").mesh);
    const auto free = fit_at_rest(body, human21());
    REQUIRE(free);
    const double size = core::bounding_diagonal(body.mesh.vertices);
    for (const JointRole role : {JointRole::knee, JointRole::wrist, JointRole::foot}) {
        const int left = find_joint(human21(), role, Side::left), right = find_joint(human21(), role, Side::right);
        INFO(human21().joint(left).name);
        const Vec3 inwards = core::point(free->joints.positions, right) - core::point(free->joints.positions, left);
        const Vec3 place = core::point(free->joints.positions, left) + 0.04 * size * inwards.normalized();
        const auto fit = fit_at_rest(body, human21(), {{left, place}});
        REQUIRE(fit);
        CHECK(std::set<int>(fit->known.begin(), fit->known.end()) == std::set<int>{left, right});
        const auto placed = place_joints(body, *fit);
        const Vec3 one = core::point(placed.joints.positions, left),
                   other = core::point(placed.joints.positions, right);
        // Which side is the left one is not told yet.
        CHECK(std::min((one - place).norm(), (other - place).norm()) < 0.01 * size);
        CHECK((one - other).norm() == Approx(inwards.norm() - 0.08 * size).margin(0.02 * size));
    }
}

TEST_CASE("no body at rest is laid where there is no volume, no mirror, or no whole template") {
    CHECK_FALSE(fit_at_rest(prepare(box(Vec3(1, 2, 1e-9), 3)), human21()));
    const Body<double> body = prepare(load_fixture_body("standing-man").mesh);
    SkeletonTemplate headless = human21();
    headless.joints[static_cast<std::size_t>(find_joint(human21(), JointRole::head))].is_absent = true;
    CHECK_FALSE(fit_at_rest(body, headless));
}
