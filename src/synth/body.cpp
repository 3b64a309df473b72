#include <skelgen/synth/body.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>

#include "body_surface.hpp"
#include "geodesic.hpp"
#include "held_things.hpp"
#include "implicit_body.hpp"
#include "pieces.hpp"

namespace skelgen::synth {
namespace {

struct EndPoint {
    const char* name;
    BodyJoint beyond; ///< the last joint before it
};

constexpr std::array<EndPoint, 5> end_points{{{"head_top", BodyJoint::head},
                                              {"left_fingertip", BodyJoint::left_hand},
                                              {"right_fingertip", BodyJoint::right_hand},
                                              {"left_toe", BodyJoint::left_foot},
                                              {"right_toe", BodyJoint::right_foot}}};

/// Whether `joint` hangs on one of `cuts` (a cut joint itself stays, at the end of the stump).
bool beyond_any(BodyJoint joint, const std::vector<BodyJoint>& cuts) {
    for (; joint != BodyJoint::crotch; joint = joint_parent(joint))
        if (std::find(cuts.begin(), cuts.end(), joint_parent(joint)) != cuts.end()) return true;
    return false;
}

void check_faces(int faces) {
    if (faces >= least_faces && faces <= most_faces) return;
    std::ostringstream what;
    what << faces << " faces is out of range: give " << least_faces << " to " << most_faces;
    throw Error(ErrorCode::usage, what.str());
}

std::vector<int> vertices_at(const TriangleMesh<double>& mesh, const std::array<Vec3, 5>& points) {
    std::vector<int> vertices;
    for (const Vec3& p : points) {
        Eigen::Index nearest = 0;
        (mesh.vertices.rowwise() - p.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
        vertices.push_back(static_cast<int>(nearest));
    }
    return vertices;
}

double clearance(const Proportions& proportions, const BodyPose& pose, const std::array<HandShape, 2>& hands = {}) {
    return ImplicitBody(proportions, pose, hands).clearance();
}

/// Puts the lowest vertex on the ground, which was at the height that is returned.
double stand_on_ground(SynthBody& body) {
    const double ground = body.mesh.vertices.col(2).minCoeff();
    body.mesh.vertices.col(2).array() -= ground;
    for (auto& joint : body.truth.joints) joint.z() -= ground;
    for (DigitTruth& digit : body.truth.digits) {
        for (auto& joint : digit.joints) joint.z() -= ground;
        digit.tip.z() -= ground;
    }
    return ground;
}

/// A robot's hands are balls, and its end points are those of its boxes.
void take_robots_ends(SynthBody& body) {
    body.truth.digits.clear();
    for (auto& [name, place] : body.truth.end_points) {
        Eigen::Index nearest = 0;
        (body.mesh.vertices.rowwise() - place.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
        place = body.mesh.vertices.row(nearest).transpose();
    }
}

nlohmann::ordered_json to_json(const Vector3<double>& p) { return {p.x(), p.y(), p.z()}; }

} // namespace

SynthBody synthesize_body(const BodyPlan& plan) {
    check_faces(plan.faces);
    check_pose(plan.pose);
    for (const HandShape& hand : plan.hands) check_hand(hand);
    const Proportions proportions = proportions_of(plan.shape);
    const ImplicitBody field = dressed_field(plan, proportions);

    SynthBody body;
    body.mesh = mesh_surface(surface_of(field, proportions), plan.faces, !plan.may_touch);
    for (std::size_t j = 0; j < body.truth.joints.size(); ++j) {
        body.truth.joints[j] = field.skeleton().frames[j].translation();
        if (beyond_any(static_cast<BodyJoint>(j), plan.missing))
            body.truth.missing.push_back(static_cast<BodyJoint>(j));
    }
    for (const DigitTruth& digit : field.digits())
        if (!beyond_any(digit.side == Side::left ? BodyJoint::left_hand : BodyJoint::right_hand, plan.missing))
            body.truth.digits.push_back(digit);
    const std::vector<int> tips = vertices_at(body.mesh, field.extremities());
    body.truth.geodesic_diameter = geodesic_diameter(body.mesh, tips);
    const double ground = stand_on_ground(body);
    for (std::size_t i = 0; i < tips.size(); ++i)
        if (!beyond_any(end_points[i].beyond, plan.missing))
            body.truth.end_points.emplace_back(end_points[i].name, body.mesh.vertices.row(tips[i]).transpose());
    if (plan.pieces.any()) {
        body.mesh =
            put_together(naked_field(plan, proportions), field, proportions, plan.pieces, plan.faces, !plan.may_touch);
        body.mesh.vertices.col(2).array() -= ground;
    }
    if (plan.pieces.limbs == LimbPieces::apart) take_robots_ends(body);
    body.mesh = with_held_things(body.mesh, field, plan, ground);
    if (plan.faults.any()) body.mesh = with_scan_faults(body.mesh, plan.faults);
    return body;
}

SynthBody synthesize_body(const BodyShape& shape, const BodyPose& pose, int faces) {
    BodyPlan plan;
    plan.shape = shape, plan.pose = pose, plan.faces = faces;
    return synthesize_body(plan);
}

double limb_clearance(const BodyShape& shape, const BodyPose& pose) {
    check_pose(pose);
    return clearance(proportions_of(shape), pose);
}

double limb_clearance(const BodyPlan& plan) {
    check_pose(plan.pose);
    for (const HandShape& hand : plan.hands) check_hand(hand);
    return clearance(proportions_of(plan.shape), plan.pose, plan.hands);
}

BodyPose spread_limbs(const BodyShape& shape, const BodyPose& pose) {
    check_pose(pose);
    const Proportions proportions = proportions_of(shape);
    BodyPose spread = pose;
    for (int step = 0; step < 12; ++step) {
        if (clearance(proportions, spread) >= least_gap * proportions.scale) return spread;
        for (const BodyJoint joint :
             {BodyJoint::left_shoulder, BodyJoint::right_shoulder, BodyJoint::left_hip, BodyJoint::right_hip}) {
            double& side = spread.at(joint).side;
            side = std::min(side + 2.5, joint_limits(joint).high.side);
        }
    }
    throw Error(ErrorCode::usage, "parts of this body touch in this pose however far arms and legs are spread: "
                                  "take another pose or a lighter body");
}

BodyPose random_free_pose(const BodyShape& shape, std::uint64_t seed) {
    const Proportions proportions = proportions_of(shape);
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15; // spreads neighbouring seeds' attempts apart
    for (std::uint64_t attempt = 0; attempt < 2000; ++attempt) {
        const BodyPose pose = random_pose(seed + attempt * golden);
        if (clearance(proportions, pose) >= least_gap * proportions.scale) return pose;
    }
    throw Error(ErrorCode::usage,
                "no random pose was found in which this body's limbs do not touch: take a lighter body");
}

std::string truth_to_json(const BodyTruth& truth, const std::string& mesh_file) {
    using Json = nlohmann::ordered_json;
    Json json;
    json["mesh"] = mesh_file;
    json["scale"] = truth.geodesic_diameter;
    json["source"] = "skelgen synth: exact by construction";
    Json joints = Json::object(), markers = Json::object(), tips = Json::object(), missing = Json::array();
    for (int j = 0; j < body_joint_count; ++j)
        joints[std::string(joint_name(static_cast<BodyJoint>(j)))] = to_json(truth.joints[static_cast<std::size_t>(j)]);
    for (const char* joint : {"hand", "foot", "elbow", "knee", "shoulder"})
        for (const char* side : {"left_", "right_"})
            markers[std::string(side) + joint] = joints[std::string(side) + joint];
    markers["head"] = joints["head"];
    for (const auto& [name, position] : truth.end_points) tips[name] = to_json(position);
    json["joints"] = joints;
    json["markers"] = markers;
    Json fingers = Json::object(), fused = Json::object();
    std::string leader; // of those that are one: the first joint of the first one
    for (const DigitTruth& digit : truth.digits) {
        for (std::size_t k = 0; k < digit.joints.size(); ++k)
            fingers[hands::joint_name(digit.side, digit.digit, k + 1)] = to_json(digit.joints[k]);
        tips[hands::tip_name(digit.side, digit.digit)] = to_json(digit.tip);
        if (digit.is_fused)
            fused[leader].push_back(std::string(hands::name_of(digit.digit)));
        else
            leader = hands::joint_name(digit.side, digit.digit, 1);
    }
    json["end_points"] = tips;
    if (!fingers.empty()) json["fingers"] = fingers;
    if (!fused.empty()) json["fused"] = fused;
    for (const BodyJoint joint : truth.missing) missing.push_back(std::string(joint_name(joint)));
    if (!missing.empty()) json["missing"] = missing;
    return json.dump(1) + "\n";
}

} // namespace skelgen::synth
