#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <string>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <skelgen/io/read_mesh.hpp>
#include <skelgen/refinement/refine.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"
#include "mesh_changes.hpp"
#include "stick_figure.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;

namespace {

/// The sample body, and a curve and embedding for it by where its joints really are: what is wrong is the refinement's.
struct SampleBody {
    Body<double> body;
    std::vector<Vec3> truth, tips; ///< per joint, in the body's coordinates
    Vec3 forward;
    double diameter = 0; ///< geodesic, in the same unit
    std::optional<BoneCurve<double>> bones;

    SampleBody() {
        const std::string folder = std::string(SKELGEN_DATA) + "/sample/";
        body = surface::prepare(read_mesh<double>(folder + "body.off"));
        std::ifstream file(folder + "body.json");
        const auto json = nlohmann::json::parse(file);
        const auto place = [&](const nlohmann::json& p) {
            return body.similarity.to_canonical(Vec3(p[0], p[1], p[2]));
        };
        const SkeletonTemplate& human = builtin_template("human21");
        for (const TemplateJoint& joint : human.joints) {
            truth.push_back(place(json["joints"][joint.name]));
            const std::string side = joint.side == Side::left ? "left_" : joint.side == Side::right ? "right_" : "";
            const char* end = joint.role == JointRole::head   ? "head_top"
                              : joint.role == JointRole::hand ? "fingertip"
                                                              : "toe";
            tips.push_back(joint.tip ? place(json["end_points"][side + end]) : Vec3::Zero());
        }
        forward = body.similarity.rotation * -Vec3::UnitY(); // z up, the person's left on +x
        diameter = json["scale"].get<double>() / body.similarity.scale;
        bones.emplace(human, truth, tips);
    }

    /// Per joint, in geodesic diameters.
    [[nodiscard]] Eigen::VectorXd errors(const Points<double>& positions) const {
        Eigen::VectorXd out(positions.rows());
        for (Eigen::Index j = 0; j < out.size(); ++j)
            out[j] = (positions.row(j).transpose() - truth[static_cast<std::size_t>(j)]).norm() / diameter;
        return out;
    }
};

const SampleBody& sample() {
    static const SampleBody made;
    return made;
}

template <typename Scalar>
RefinedJoints<Scalar> refined(const Body<Scalar>& body, const BoneCurve<Scalar>& bones, const SkeletonTemplate& human,
                              const RefinementOptions& options = {}) {
    const auto ends = find_end_points(body, bones.curve, bones.embedding, human);
    return refine(body, ends, bones.curve, bones.embedding, human, options);
}

RefinedJoints<double> refined_sample() { return refined(sample().body, *sample().bones, builtin_template("human21")); }

double largest_distance(const Points<double>& a, const Points<double>& b) {
    return (a - b).rowwise().norm().maxCoeff();
}

} // namespace

TEST_CASE("the sample body's joints are found near where they are") {
    const SkeletonTemplate& human = builtin_template("human21");
    const RefinedJoints<double> joints = refined_sample();
    REQUIRE(joints.positions.rows() == 21);
    const Eigen::VectorXd errors = sample().errors(joints.positions);
    for (Eigen::Index j = 0; j < errors.size(); ++j) {
        INFO(human.joint(static_cast<int>(j)).name << ": " << errors[j]);
        CHECK(errors[j] < 0.025);
    }
    INFO("mean error " << errors.mean());
    CHECK(errors.mean() < 0.008); // people differ by 0.0096 (LF20, table 1)
}

TEST_CASE("the sample body's limbs end in its tips, and its head looks ahead") {
    const SkeletonTemplate& human = builtin_template("human21");
    const RefinedJoints<double> joints = refined_sample();
    REQUIRE(joints.tips.size() == 5);
    for (const auto& [joint, place] : joints.tips) {
        INFO(human.joint(joint).name);
        CHECK((place - sample().tips[static_cast<std::size_t>(joint)]).norm() < 0.03 * sample().diameter);
        CHECK((sample().body.mesh.vertices.rowwise() - place.transpose()).rowwise().norm().minCoeff() < 1e-12);
    }
    REQUIRE(joints.head.has_value());
    CHECK(joints.head->forward.dot(sample().forward) > 0.95);
}

TEST_CASE("where both hands are cut off, they are missing and the wrists are at the ends of the arms") {
    const SkeletonTemplate& human = builtin_template("human21");
    const SampleBody& whole = sample();
    const std::vector<bool> all = refined_sample().is_present;
    CHECK(std::all_of(all.begin(), all.end(), std::identity()));

    const auto place = [&](JointRole role, Side side) {
        return whole.truth[static_cast<std::size_t>(joint_of(role, side))];
    };
    const auto is_hand = [&](const Vec3& p, Side side) {
        const Vec3 wrist = place(JointRole::wrist, side), hand = place(JointRole::hand, side);
        return (p - wrist).dot(wrist - place(JointRole::elbow, side)) > 0 &&
               (p - hand).norm() < 2 * (hand - wrist).norm();
    };
    TriangleMesh<double> cut{whole.body.mesh.vertices, {}};
    std::vector<Eigen::RowVector3i> kept;
    for (Eigen::Index f = 0; f < whole.body.mesh.faces.rows(); ++f) {
        bool off = false;
        for (int k = 0; k < 3; ++k) {
            const Vec3 p = whole.body.mesh.vertices.row(whole.body.mesh.faces(f, k));
            off = off || is_hand(p, Side::left) || is_hand(p, Side::right);
        }
        if (!off) kept.emplace_back(whole.body.mesh.faces.row(f));
    }
    cut.faces.resize(static_cast<Eigen::Index>(kept.size()), 3);
    for (std::size_t f = 0; f < kept.size(); ++f) cut.faces.row(static_cast<Eigen::Index>(f)) = kept[f];

    const Body<double> body = surface::prepare(cut);
    std::vector<Vec3> truth, tips;
    for (std::size_t j = 0; j < whole.truth.size(); ++j) {
        const bool gone = human.joints[j].role == JointRole::hand;
        truth.push_back(
            body.similarity.to_canonical(gone ? place(JointRole::wrist, human.joints[j].side) : whole.truth[j]));
        tips.push_back(gone ? truth.back() : Vec3(body.similarity.to_canonical(whole.tips[j])));
    }
    const RefinedJoints<double> joints = refined(body, BoneCurve<double>(human, truth, tips), human);
    CHECK(joints.tips.size() == 3);
    for (std::size_t j = 0; j < truth.size(); ++j) {
        INFO(human.joints[j].name);
        CHECK(joints.is_present[j] == (human.joints[j].role != JointRole::hand));
        const double error = (joints.positions.row(static_cast<Eigen::Index>(j)).transpose() - truth[j]).norm();
        if (joints.is_present[j]) CHECK(error * body.similarity.scale < 0.05 * whole.diameter);
    }
}

TEST_CASE("where the curve runs through the trunk moves no joint") {
    const SkeletonTemplate& human = builtin_template("human21");
    BoneCurve<double> bones = *sample().bones;
    const auto before = refined(sample().body, bones, human);
    const int chest = joint_of(JointRole::chest);
    for (const embedding::Chain& chain : bones.embedding.chains)
        for (std::size_t i = 0; i + 1 < chain.nodes.size() && chain.joints.back() == chest; ++i)
            bones.curve.nodes.row(chain.nodes[i]) += (i % 2 == 0 ? 0.01 : -0.01) * Vec3(1, 1, 1).transpose();
    CHECK(refined(sample().body, bones, human).positions == before.positions);
}

TEST_CASE("a template in another unit has the same joints") {
    const RefinedJoints<double> joints = refined_sample();
    for (const double unit : {100.0, 0.001}) {
        const SkeletonTemplate human = scaled(builtin_template("human21"), unit);
        const RefinedJoints<double> same = refined(sample().body, *sample().bones, human);
        CHECK(largest_distance(same.positions, joints.positions) < 1e-9);
        CHECK(same.head->frontness == Approx(joints.head->frontness));
    }
}

TEST_CASE("in float the joints are the same to a ten-thousandth of the body") {
    const SkeletonTemplate& human = builtin_template("human21");
    const SampleBody& body = sample();
    const Body<float> rounded = body_of<float>(body.body.mesh);
    const BoneCurve<float> bones(human, body.truth, body.tips);
    const Points<double> found = refined(rounded, bones, human).positions.cast<double>();
    CHECK(largest_distance(found, refined_sample().positions) < 1e-4 * body.diameter);
}

TEST_CASE("the joints turn with the body") {
    const SkeletonTemplate& human = builtin_template("human21");
    const RefinedJoints<double> joints = refined_sample();
    const Motion motion{random_rotation(11), 1, Vec3(0.3, -2, 1)};
    std::vector<Vec3> truth, tips;
    for (const Vec3& p : sample().truth) truth.push_back(motion.apply(p));
    for (const Vec3& p : sample().tips) tips.push_back(motion.apply(p));
    const BoneCurve<double> bones(human, truth, tips);
    const RefinedJoints<double> turned = refined(body_of<double>(moved(sample().body.mesh, motion)), bones, human);
    for (Eigen::Index j = 0; j < turned.positions.rows(); ++j)
        CHECK((motion.undo(turned.positions.row(j).transpose()) - joints.positions.row(j).transpose()).norm() < 1e-6);
}

TEST_CASE("a stick figure at rest has its joints near their places at rest, both sides alike") {
    const SkeletonTemplate& human = builtin_template("human21");
    const StickFigure<double> figure;
    const auto ends = find_end_points(figure.body, figure.curve, figure.embedding, human);
    const auto joints = refine(figure.body, ends, figure.curve, figure.embedding, human);
    const double diameter = geodesic_diameter(ends);
    for (int j = 0; j < 21; ++j) {
        const TemplateJoint& joint = human.joint(j);
        const Vec3 found = joints.positions.row(j).transpose();
        INFO(joint.name);
        CHECK((found - joint.position).norm() < 0.04 * diameter); // it has neither calves nor a throat to go by
        if (joint.side != Side::left) continue;
        const Vec3 other = joints.positions.row(counterpart(human, j)).transpose();
        CHECK((found - Vec3(-other.x(), other.y(), other.z())).norm() < 0.01 * diameter);
    }
}

TEST_CASE("options that make no sense are refused, whichever step they are for") {
    const SkeletonTemplate& human = builtin_template("human21");
    const auto refusal = [&](const RefinementOptions& options) -> std::string {
        try {
            (void)refined(sample().body, *sample().bones, human, options);
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::usage);
            return error.what();
        }
        return "";
    };
    CHECK(refusal({}).empty());
    RefinementOptions options;
    options.centreline.step = 0;
    CHECK(refusal(options).find("refinement.centreline.step") != std::string::npos);
    options = {};
    options.bend.full = options.bend.from;
    CHECK(refusal(options).find("refinement.bend.full") != std::string::npos);
    options = {};
    options.larger_head = -1;
    CHECK(refusal(options).find("refinement.larger_head") != std::string::npos);
    options = {};
    options.thickness_profile.bone_deviation = 0;
    CHECK(refusal(options).find("refinement.thickness_profile.bone_deviation") != std::string::npos);
    options = {};
    options.thickness_profile.heel_deviation = -1;
    CHECK(refusal(options).find("refinement.thickness_profile.heel_deviation") != std::string::npos);
    options = {};
    options.thickness_profile.ankle_beyond_heel = 2;
    CHECK(refusal(options).find("refinement.thickness_profile.ankle_beyond_heel") != std::string::npos);
    options = {};
    options.crotch.depth = std::nan("");
    CHECK(refusal(options).find("refinement.crotch.depth") != std::string::npos);
}
