#include <skelgen/applications/impl/heat_weights.hpp>
#include <skelgen/core/builtin_templates.hpp>

#include "anatomy/rest_skeleton.hpp"
#include "applications/weights.hpp"
#include "catch.hpp"
#include "human.hpp"
#include "shapes.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;

/// Two bones along the axis of a capsule that reaches from z = -0.5 to 4.5.
template <typename Scalar>
std::vector<Bone<Scalar>> two_bones() {
    return {{0, {0, 0, 0}, {0, 0, 2}, Scalar(0.5), Scalar(0.5)}, {1, {0, 0, 2}, {0, 0, 4}, Scalar(0.5), Scalar(0.5)}};
}

TEMPLATE_TEST_CASE("heat: halves where bones meet, all of a bone far from others", "[applications][weights]", float,
                   double) {
    const auto body = test::body_of<TestType>(test::capsule(0.5, 4));
    const auto weights = heat_weights(heat_in(body, two_bones<TestType>(), 3));
    REQUIRE(weights);
    CHECK((weights->rowwise().sum().array() - 1).abs().maxCoeff() < 1e-12);
    CHECK(weights->minCoeff() >= 0);
    CHECK(weights->col(2).maxCoeff() == 0); // has no bone
    for (Eigen::Index v = 0; v < weights->rows(); ++v) {
        const double z = static_cast<double>(body.mesh.vertices(v, 2)), first = (*weights)(v, 0);
        if (z < 0.5) CHECK(first > 0.97);
        if (z > 3.5) CHECK(first < 0.03);
        if (z < 1.9) CHECK(first > 0.5);
        if (z > 2.1) CHECK(first < 0.5);
    }
}

TEST_CASE("concentrated weights have narrower bends, the same joint first, and sum to 1", "[applications][weights]") {
    JointWeights weights(3, 3);
    weights << 0.5, 0.5, 0, 0.8, 0.2, 0, 0, 0, 1;
    const JointWeights narrow = concentrated(weights);
    CHECK((narrow.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-15);
    CHECK(narrow(0, 0) == 0.5);
    CHECK(narrow(1, 0) == Approx(0.512 / 0.52));
    CHECK(narrow.row(2) == weights.row(2));
}

TEST_CASE("narrow hinges: odds of what an elbow carries are squared, all else keeps its shares",
          "[applications][weights]") {
    const auto at = [](JointRole role) { return Eigen::Index(find_joint(test::human(), role, Side::left)); };
    const Eigen::Index chest = find_joint(test::human(), JointRole::chest), shoulder = at(JointRole::shoulder),
                       elbow = at(JointRole::elbow), wrist = at(JointRole::wrist);
    JointWeights weights = JointWeights::Zero(3, Eigen::Index(test::human().joints.size()));
    weights(0, shoulder) = 0.2; // 1 to 4
    weights(0, elbow) = 0.6;
    weights(0, wrist) = 0.2;
    weights(1, shoulder) = weights(1, elbow) = 0.5;
    weights(2, chest) = 0.3;
    weights(2, shoulder) = 0.7;
    const JointWeights narrow = with_narrow_hinges(weights, test::human());
    CHECK((narrow.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-15);
    CHECK(narrow(0, shoulder) == Approx(1.0 / 17)); // 1 to 16
    CHECK(narrow(0, elbow) == Approx(3 * narrow(0, wrist)));
    CHECK(narrow.row(1).isApprox(weights.row(1)));
    CHECK(narrow.row(2) == weights.row(2));
}

TEST_CASE("heat: only bones in sight warm", "[applications][weights]") {
    // Beside the capsule, and nearer to its one side than the bone within.
    std::vector<Bone<double>> bones{{0, {0, 0, 0}, {0, 0, 4}, 0, 0}, {1, {0.6, 0, 0}, {0.6, 0, 4}, 0, 0}};
    const auto body = test::body_of<double>(test::capsule(0.5, 4));
    const auto weights = heat_weights(heat_in(body, bones, 2));
    REQUIRE(weights);
    for (Eigen::Index v = 0; v < weights->rows(); ++v)
        if (body.mesh.vertices(v, 0) < -0.1) CHECK((*weights)(v, 0) > 0.5);

    bones = {{0, {100, 0, 0}, {100, 0, 1}, 0, 0}};
    const auto inside_out = test::body_of<double>(test::capsule(0.5, 4));
    CHECK(heat_weights(heat_in(inside_out, bones, 1))); // seen from outside
    CHECK_FALSE(heat_weights(heat_in(inside_out, {}, 1)));
}

TEST_CASE("heat: bones of a limb warm that limb's region alone", "[applications][weights]") {
    const auto body = test::body_of<double>(test::capsule(0.5, 4));
    LimbRegions regions{{0, 1}, std::vector<int>(static_cast<std::size_t>(body.mesh.vertices.rows()), 0)};
    for (Eigen::Index v = 0; v < body.mesh.vertices.rows(); ++v)
        if (body.mesh.vertices(v, 2) > 3) regions.of_vertex[static_cast<std::size_t>(v)] = 1;
    const auto weights = heat_weights(heat_in(body, two_bones<double>(), 2, regions));
    REQUIRE(weights);
    for (Eigen::Index v = 0; v < weights->rows(); ++v) { // the border is where the regions', not the bones', is
        const double z = body.mesh.vertices(v, 2);
        if (z < 2.8) CHECK((*weights)(v, 0) > 0.5);
        if (z > 3.2) CHECK((*weights)(v, 1) > 0.5);
    }
}

TEST_CASE("heat: a limb's bones warm nothing that is far beyond the limb along the surface",
          "[applications][weights]") {
    // The limb's bone, which ends at z = 4, lies in the capsule beside the trunk's.
    const std::vector<Bone<double>> bones{{0, {0, 0, 0}, {0, 0, 4}, 1, 1}, {1, {0.2, 0, 0}, {0.2, 0, 4}, 1, 1}};
    const auto body = test::body_of<double>(test::capsule(0.5, 4));
    const auto n = static_cast<std::size_t>(body.mesh.vertices.rows());
    LimbRegions regions{{-1, 1}, std::vector<int>(n, 1), std::vector<double>(n), {{}, {4, 4, 0}}};
    const auto way = [](double z) { return z < 2 ? 8 - z : 4 - z; }; // as if one came to the lower half over others
    for (std::size_t v = 0; v < n; ++v) regions.from_end[v] = way(body.mesh.vertices(static_cast<Eigen::Index>(v), 2));
    const Heat heat = heat_in(body, bones, 2, regions);
    for (Eigen::Index v = 0; v < heat.of_joint.rows(); ++v) {
        const bool is_nearer = body.mesh.vertices(v, 0) > 0.1;
        CHECK((heat.of_joint(v, 1) > 0) == (is_nearer && body.mesh.vertices(v, 2) >= 2));
    }
    regions.from_end.assign(n, 4.3); // what limb and trunk share
    const Heat shared = heat_in(body, bones, 2, regions);
    CHECK(shared.of_joint.col(1) == heat_in(body, bones, 2).of_joint.col(1));
}

TEST_CASE("heat: two poses alike give the weights of one", "[applications][weights]") {
    const auto body = test::body_of<double>(test::capsule(0.5, 4));
    const Heat heat = heat_in(body, two_bones<double>(), 2);
    const auto one = heat_weights(heat);
    const auto two = heat_weights(heat + heat);
    REQUIRE(one);
    REQUIRE(two);
    CHECK((*one - *two).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("one limb: where limbs meet the trunk takes what they lose", "[applications][weights]") {
    const SkeletonTemplate& human = builtin_template("human21");
    const int left = find_joint(human, JointRole::hip, Side::left),
              right = find_joint(human, JointRole::hip, Side::right);
    const int left_knee = find_joint(human, JointRole::knee, Side::left);
    const int right_hand = find_joint(human, JointRole::hand, Side::right);
    JointWeights weights = JointWeights::Zero(4, static_cast<Eigen::Index>(human.joints.size()));
    weights(0, 0) = 0.4, weights(0, left) = 0.3, weights(0, right) = 0.3; // in the crotch
    weights(1, 0) = 0.4, weights(1, left) = 0.5, weights(1, right) = 0.1;
    weights(2, left) = 0.6, weights(2, right_hand) = 0.4; // a hand grown together with a thigh
    weights(3, left) = 0.5, weights(3, left_knee) = 0.5;  // one limb alone: as it was
    const JointWeights one = following_one_limb(weights, human);
    CHECK(one(0, 0) == Approx(1));
    CHECK(one(1, left) == Approx(0.4));
    CHECK(one(1, right) == 0);
    CHECK(one(1, 0) == Approx(0.6));
    CHECK(one(2, left) == Approx(1));
    CHECK(one.row(3) == weights.row(3));
    CHECK((one.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-12);
}

TEST_CASE("islands: a vertex alone gets its neighbours' mean", "[applications][weights]") {
    const TriangleMesh<double> mesh = test::sphere(1, 2);
    JointWeights weights = JointWeights::Zero(mesh.vertices.rows(), 3);
    for (Eigen::Index v = 0; v < weights.rows(); ++v) weights(v, mesh.vertices(v, 2) > 0 ? 0 : 1) = 1;
    const JointWeights as_they_were = weights;
    CHECK(without_islands(weights, mesh.faces) == as_they_were);
    Eigen::Index top = 0;
    mesh.vertices.col(2).maxCoeff(&top);
    weights.row(top) << 0.1, 0.1, 0.8;
    CHECK((without_islands(weights, mesh.faces) - as_they_were).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("islands: none is left, wherever the realms of many joints meet", "[applications][weights]") {
    const TriangleMesh<double> mesh = test::sphere(1, 3);
    // Each vertex follows most a joint of its own, and all follow a second one, which no mean may make the strongest.
    const Eigen::Index n = mesh.vertices.rows();
    JointWeights weights = JointWeights::Zero(n, n + 1);
    for (Eigen::Index v = 0; v < n; ++v) weights.row(v)(v) = 0.6;
    weights.col(n).setConstant(0.4);
    const JointWeights joined = without_islands(weights, mesh.faces);
    CHECK((joined.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-12);
    CHECK(test::islands(strongest_influences<double>(weights), mesh.faces) == n);
    CHECK(test::islands(strongest_influences<double>(joined), mesh.faces) == 0);
    for (Eigen::Index v = 0; v < n; ++v) CHECK(joined.row(v).maxCoeff() > 0.5);
}

} // namespace
