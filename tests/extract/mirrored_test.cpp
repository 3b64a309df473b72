// Bodies that mirror themselves have skeletons and rigs that do.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <skelgen/applications/impl/bind.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/symmetry/exact_mirror.hpp>

#include "catch.hpp"
#include "fixture_bodies.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::symmetry;
using test::Vec3;

namespace {

const SkeletonTemplate& human21() { return builtin_template("human21"); }

Vec3 at_x_mirrored(const Vec3& place) { return {-place.x(), place.y(), place.z()}; }

std::size_t other_side(std::size_t j) {
    const int other = counterpart(human21(), static_cast<int>(j));
    return other >= 0 ? static_cast<std::size_t>(other) : j;
}

/// The farthest that a joint is from its counterpart's mirror image.
template <typename Joints>
double asymmetry(const Joints& joints) {
    double worst = 0;
    for (std::size_t j = 0; j < joints.size(); ++j)
        worst = std::max(worst, (joints[j].position - at_x_mirrored(joints[other_side(j)].position)).norm());
    return worst;
}

} // namespace

TEST_CASE("exact mirrors: of a shape that has one, each vertex with its image, seams or not", "[extract][mirrored]") {
    auto mesh = test::with_mirrored_half(test::subdivided(test::box(Vec3(1, 2, 4), 2), 1));
    mesh.vertices.col(1) += mesh.vertices.col(2) * 0.3 + mesh.vertices.col(2).cwiseAbs2() * 0.1; // x alone is left
    const auto mirror = exact_mirror(mesh);
    REQUIRE(mirror);
    CHECK(std::abs(mirror->normal.x()) == Approx(1).margin(1e-9));
    CHECK(mirror->offset == Approx(0).margin(1e-9));
    for (std::size_t v = 0; v < mirror->partner.size(); ++v) {
        const auto row = static_cast<Eigen::Index>(v);
        const Vec3 image = mesh.vertices.row(mirror->partner[v]).transpose();
        REQUIRE((at_x_mirrored(mesh.vertices.row(row).transpose()) - image).norm() < 1e-9);
    }
    // A seam on one side: a face that has its corners for itself.
    auto torn = mesh;
    torn.vertices.conservativeResize(mesh.vertices.rows() + 4, 3);
    for (int k = 0; k < 3; ++k) {
        torn.vertices.row(mesh.vertices.rows() + k) = mesh.vertices.row(mesh.faces(0, k));
        torn.faces(0, k) = static_cast<int>(mesh.vertices.rows()) + k;
    }
    torn.vertices.row(mesh.vertices.rows() + 3).setConstant(7); // no face uses it
    const auto of_torn = exact_mirror(torn);
    REQUIRE(of_torn);
    CHECK(of_torn->partner.back() == -1);
    // A vertex that is off by 1e-4 of the size has no image.
    mesh.vertices(mesh.vertices.rows() - 1, 2) += 1e-4 * 4.6; // one of the mirrored half
    CHECK_FALSE(exact_mirror(mesh));
}

TEST_CASE("mirrored bodies get mirrored skeletons and weights", "[extract][mirrored][slow]") {
    const auto mesh = test::with_mirrored_half(test::load_fixture_body("heels-together-man").mesh);
    const auto found = extract(mesh);
    CHECK(asymmetry(found.skeleton.joints) < 1e-6);
    CHECK(std::abs(found.skeleton.frame.left.x()) == Approx(1).margin(1e-9));
    for (std::size_t j = 0; j < found.skeleton.joints.size(); ++j)
        CHECK(found.skeleton.joints[j].radius == Approx(found.skeleton.joints[other_side(j)].radius));
    const auto mirror = exact_mirror(mesh);
    REQUIRE(mirror);
    CHECK(is_mirrored(found.skeleton, human21(), *mirror, 1e-6));

    const auto skin = applications::bind(mesh, found.body, found.skeleton, human21());
    const auto dense = [&](Eigen::Index v) {
        std::vector<double> of_joint(found.skeleton.joints.size(), 0);
        for (int k = 0; k < applications::Skin<double>::influences; ++k)
            of_joint[static_cast<std::size_t>(skin.joints(v, k))] += skin.weights(v, k);
        return of_joint;
    };
    double worst = 0;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        const auto own = dense(v), its = dense(mirror->partner[static_cast<std::size_t>(v)]);
        for (std::size_t j = 0; j < own.size(); ++j) worst = std::max(worst, std::abs(own[j] - its[other_side(j)]));
    }
    CHECK(worst < 1e-6);
}

TEST_CASE("skeletons that do not nearly mirror themselves stay; what one side lacks the other gives",
          "[extract][mirrored]") {
    KinematicSkeleton<double> skeleton;
    for (const TemplateJoint& joint : human21().joints)
        skeleton.joints.push_back({joint.name, joint.parent, joint.position});
    skeleton.frame.left = Vec3::UnitX();
    skeleton.frame.up = Vec3::UnitY();
    skeleton.frame.forward = Vec3::UnitZ();
    const ExactMirror<double> mirror;
    const auto hand = static_cast<std::size_t>(find_joint(skeleton, "left_hand"));
    const Vec3 right = skeleton.joints[other_side(hand)].position;

    auto bent = skeleton;
    bent.joints[hand].position += Vec3(0, 0.02, 0);
    const auto even = mirrored_evenly(bent, human21(), mirror, 2.0);
    CHECK(even.joints[hand].position.y() == Approx(right.y() + 0.01));
    CHECK(asymmetry(even.joints) < 1e-12);

    bent.joints[hand].position += Vec3(0, 0.4, 0);
    CHECK(mirrored_evenly(bent, human21(), mirror, 2.0).joints[hand].position == bent.joints[hand].position);

    auto lacking = bent; // the left hand is nowhere near, but it is not there
    lacking.joints[hand].is_present = false;
    const auto given = mirrored_evenly(lacking, human21(), mirror, 2.0);
    CHECK(given.joints[hand].is_present);
    CHECK((given.joints[hand].position - at_x_mirrored(right)).norm() < 1e-12);

    ExactMirror<double> across;
    across.normal = Vec3::UnitZ(); // front and back alike
    const auto same = mirrored_evenly(skeleton, human21(), across, 2.0);
    CHECK(same.frame.left == skeleton.frame.left);
    skeleton.joints.pop_back();
    CHECK_THROWS_AS(is_mirrored(skeleton, human21(), mirror, 1e-6), Error);
}
