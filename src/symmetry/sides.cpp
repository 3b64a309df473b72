#include <skelgen/symmetry/sides.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

#include <skelgen/core/error.hpp>
#include <skelgen/symmetry/standing_pose.hpp>

namespace skelgen {
namespace {

using enum JointRole;

/// Looks joints up by role and side.
class Anatomy {
public:
    Anatomy(const RefinedJoints& joints, const SkeletonTemplate& skeleton_template)
        : joints_(joints), template_(skeleton_template) {}

    [[nodiscard]] std::optional<Vector3<double>> find(JointRole role, Side side = Side::none) const {
        for (std::size_t j = 0; j < template_.joints.size(); ++j)
            if (template_.joints[j].role == role && template_.joints[j].side == side)
                return joints_.positions.row(static_cast<Eigen::Index>(j)).transpose();
        return std::nullopt;
    }
    [[nodiscard]] Vector3<double> get(JointRole role, Side side = Side::none) const {
        const auto found = find(role, side);
        if (!found) throw Error(ErrorCode::usage, "the template lacks a joint that telling the sides needs; add it");
        return *found;
    }
    [[nodiscard]] std::optional<Vector3<double>> tip(JointRole role, Side side) const {
        for (const auto& [j, point] : joints_.tips) {
            const TemplateJoint& joint = template_.joints[static_cast<std::size_t>(j)];
            if (joint.role == role && joint.side == side) return point;
        }
        return std::nullopt;
    }

private:
    const RefinedJoints& joints_;
    const SkeletonTemplate& template_;
};

LegBones<double> leg_bones(const Anatomy& anatomy, Side side) {
    const Vector3<double> knee_at = anatomy.get(knee, side);
    const Vector3<double> ankle_at = anatomy.find(ankle, side).value_or(knee_at);
    const Vector3<double> toe = anatomy.tip(foot, side).value_or(anatomy.get(foot, side));
    return {knee_at - anatomy.get(hip, side), ankle_at - knee_at, toe - ankle_at};
}

double sum(const std::vector<SideVote>& votes) {
    double total = 0;
    for (const SideVote& vote : votes) total += vote.strength;
    return total;
}

/// 1 when all witnesses agree and at least one of them is strong, 0 when they cancel out or none says anything.
double confidence_of(const std::vector<SideVote>& votes) {
    constexpr double strong = 0.5; // one foot turned out by 60 degrees
    double magnitude = 0;
    for (const SideVote& vote : votes) magnitude += std::abs(vote.strength);
    if (!(magnitude > 0)) return 0;
    return std::abs(sum(votes)) / magnitude * std::min(1.0, magnitude / strong);
}

} // namespace

SidesDecision decide_sides(const RefinedJoints& joints, const SkeletonTemplate& skeleton_template,
                           const SidesOptions& options) {
    const Anatomy anatomy(joints, skeleton_template);
    const Vector3<double> root = anatomy.get(pelvis);
    const Vector3<double> hips_middle = 0.5 * (anatomy.get(hip, Side::left) + anatomy.get(hip, Side::right));
    const Vector3<double> spine = anatomy.find(waist).value_or(anatomy.get(chest)) - hips_middle;
    const Vector3<double> up = spine.normalized();
    const Vector3<double> hips = anatomy.get(hip, Side::left) - anatomy.get(hip, Side::right);
    const Vector3<double> across = detail::without_component(hips, up).normalized();
    if (!(spine.norm() > 0) || !(across.norm() > 0.5))
        throw Error(ErrorCode::no_skeleton, "no human body: its trunk or its hips have no extent");

    SidesDecision out;
    Vector3<double> forward = Vector3<double>::Zero();
    for (const Side side : {Side::left, Side::right}) {
        const LegBones<double> leg = leg_bones(anatomy, side);
        const Vector3<double> standing = detail::without_component(standing_foot_direction(leg, up, across), up);
        forward += standing;
        // up x forward is left: does the foot say that `across` points left?
        out.votes.push_back({"foot", options.foot * up.cross(standing).dot(across)});
        // The calf folds backwards: thigh x calf points left.
        const Vector3<double> hinge = leg.thigh.normalized().cross(leg.calf.normalized());
        out.votes.push_back({"knee", options.knee * hinge.dot(across)});
        const auto shoulder_at = anatomy.find(shoulder, side), elbow_at = anatomy.find(elbow, side);
        const auto hand_at = anatomy.find(wrist, side) ? anatomy.find(wrist, side) : anatomy.find(hand, side);
        if (shoulder_at && elbow_at && hand_at) {
            // The forearm folds forwards: forearm x upper arm points left.
            const Vector3<double> fold =
                (*hand_at - *elbow_at).normalized().cross((*elbow_at - *shoulder_at).normalized());
            out.votes.push_back({"elbow", options.elbow * fold.dot(across)});
        }
    }
    constexpr double clear_head = 0.08, clear_trunk = 0.012; // median frontness over 96 bodies
    const auto vote_of_shape = [&](const Vector3<double>& facing, double frontness) {
        return std::min(1.0, frontness) * up.cross(facing).dot(across);
    };
    if (joints.head)
        out.votes.push_back(
            {"head", options.head * vote_of_shape(joints.head->forward, joints.head->frontness / clear_head)});
    if (joints.trunk)
        out.votes.push_back(
            {"trunk", options.trunk * vote_of_shape(joints.trunk->forward, joints.trunk->frontness / clear_trunk)});
    out.swap_legs = sum(out.votes) < 0;
    out.confidence = confidence_of(out.votes);

    // Where the feet say nothing, or are outvoted, the hips decide; where they speak, they know better than hips that a
    // deep crouch hides.
    const Vector3<double> decided = out.swap_legs ? Vector3<double>(-across) : across;
    Vector3<double> left = up.cross(forward);
    if (!(left.norm() > 0.5) || left.dot(decided) < 0) left = decided;
    out.frame.origin = root;
    out.frame.up = up;
    out.frame.left = detail::without_component(left, up).normalized();
    out.frame.forward = out.frame.left.cross(up);
    const auto left_shoulder = anatomy.find(shoulder, Side::left), right_shoulder = anatomy.find(shoulder, Side::right);
    if (left_shoulder && right_shoulder) out.swap_arms = (*left_shoulder - *right_shoulder).dot(left) < 0;
    return out;
}

namespace {

bool is_leg(JointRole role) { return role == hip || role == knee || role == ankle || role == foot; }

/// The joint that ends up under the name of template joint `j`.
std::size_t source_of(std::size_t j, const SkeletonTemplate& skeleton_template, const SidesDecision& sides) {
    const TemplateJoint& joint = skeleton_template.joints[j];
    const bool swapped = joint.side != Side::none && (is_leg(joint.role) ? sides.swap_legs : sides.swap_arms);
    if (!swapped) return j;
    for (std::size_t k = 0; k < skeleton_template.joints.size(); ++k) {
        const TemplateJoint& other = skeleton_template.joints[k];
        if (other.role == joint.role && other.side != joint.side && other.side != Side::none) return k;
    }
    return j;
}

std::string end_point_name(const TemplateJoint& joint) {
    const std::string prefix = joint.side == Side::left ? "left_" : joint.side == Side::right ? "right_" : "";
    return prefix + (joint.role == hand ? "fingertip" : joint.role == foot ? "toe" : "head_top");
}

/// Votes of one kind added up, positive for the sides as decided.
std::vector<SideVote> by_witness(const SidesDecision& sides) {
    std::vector<SideVote> out;
    for (const SideVote& vote : sides.votes) {
        auto same = std::find_if(out.begin(), out.end(), [&](const SideVote& v) { return v.witness == vote.witness; });
        if (same == out.end()) same = out.insert(out.end(), {vote.witness, 0});
        same->strength += sides.swap_legs ? -vote.strength : vote.strength;
    }
    return out;
}

} // namespace

KinematicSkeleton<double> assemble(const RefinedJoints& joints, const SkeletonTemplate& skeleton_template,
                                   const SidesDecision& sides) {
    KinematicSkeleton<double> out;
    out.template_name = skeleton_template.name;
    for (std::size_t j = 0; j < skeleton_template.joints.size(); ++j) {
        const TemplateJoint& joint = skeleton_template.joints[j];
        const auto source = static_cast<Eigen::Index>(source_of(j, skeleton_template, sides));
        out.joints.push_back({joint.name, joint.parent, joints.positions.row(source).transpose(), 0});
        for (const auto& [end, tip] : joints.tips)
            if (end == source) out.end_points.emplace_back(end_point_name(joint), tip);
    }
    out.frame = sides.frame;
    out.quality.sides_confidence = sides.confidence;
    out.quality.side_votes = by_witness(sides);
    if (sides.confidence < 0.5) {
        std::string against;
        for (const SideVote& vote : out.quality.side_votes)
            if (vote.strength < 0) against += (against.empty() ? "" : ", ") + vote.witness;
        out.quality.warnings.push_back("left and right may be exchanged: " +
                                       (against.empty() ? "feet, knees, elbows, head and trunk hardly tell them"
                                                        : "the witnesses disagree (against: " + against + ")"));
    }
    return out;
}

} // namespace skelgen
