#include <skelgen/evaluation/evaluate.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::evaluation {
namespace {

constexpr double reach = 0.12; // a limb's joint lies within this part of the scale from its marker

/// What tells whether a skeleton is right: limbs' ends, and joints that have a side.
struct Marked {
    std::vector<std::string> ends, pairs;
};

const Marked& marked_of(BodyKind plan) {
    static const Marked human{{"left_hand", "right_hand", "left_foot", "right_foot", "head"},
                              {"hand", "foot", "elbow", "knee", "shoulder"}},
        quadruped{{"left_fore_foot", "right_fore_foot", "left_hind_foot", "right_hind_foot", "head", "tail"},
                  {"fore_foot", "hind_foot", "fore_lower", "hind_lower", "fore_upper", "hind_upper"}};
    return plan == BodyKind::human ? human : quadruped;
}

constexpr std::array<std::pair<const char*, const char*>, 2> sides{{{"left", "right"}, {"right", "left"}}};

bool is_of_tail(const std::string& joint) { return joint.starts_with("tail"); }

/// Whether all joints are there that the body has, and none that it lacks. A tail may be missed: that is a wrong limb.
bool is_complete(const io::GroundTruth& truth, const JointPositions& joints) {
    const auto is_as_it_should = [&](const std::string& name) {
        const auto joint = joints.find(name);
        if (truth.missing.count(name) > 0) return joint == joints.end();
        if (joint == joints.end()) return truth.plan == BodyKind::quadruped && is_of_tail(name);
        return joint->second.allFinite();
    };
    const std::vector<std::string>& wanted = evaluated_joints(truth.plan);
    return std::all_of(wanted.begin(), wanted.end(), is_as_it_should);
}

/// Of an animal whatever is known: markers, or else joints.
std::optional<Vector3<double>> known_place(const io::GroundTruth& truth, const std::string& name) {
    if (const auto found = truth.markers.find(name); found != truth.markers.end()) return found->second;
    if (truth.plan == BodyKind::human) return {};
    for (const auto& [joint, place] : truth.joints)
        if (joint == name) return place;
    return {};
}

Vector3<double> marker(const io::GroundTruth& truth, const std::string& name) {
    const auto found = known_place(truth, name);
    if (!found) throw Error(ErrorCode::bad_input, "the truth has no marker \"" + name + "\"; add it");
    return *found;
}

/// Where a limb's end was found: a tail's is its tip.
std::optional<Vector3<double>> found_end(const JointPositions& joints, const std::string& end) {
    for (const std::string& name : is_of_tail(end) ? std::vector<std::string>{"tail_tip", "tail4"} : std::vector{end})
        if (const auto found = joints.find(name); found != joints.end()) return found->second;
    return {};
}

double distance(const io::GroundTruth& truth, const Vector3<double>& a, const Vector3<double>& b) {
    return (a - b).norm() / truth.scale;
}

/// Whether the end is there, nearest to its own marker, and near it at all.
bool is_right_limb(const io::GroundTruth& truth, const JointPositions& joints, const std::string& end) {
    const auto place = found_end(joints, end);
    if (!place) return false;
    const double to_own = distance(truth, *place, marker(truth, end));
    if (!(to_own <= reach)) return false;
    return std::all_of(marked_of(truth.plan).ends.begin(), marked_of(truth.plan).ends.end(), [&](const auto& other) {
        if (is_of_tail(other) && !known_place(truth, other)) return true;
        return other == end || to_own < distance(truth, *place, marker(truth, other));
    });
}

bool is_on_its_side(const io::GroundTruth& truth, const Vector3<double>& joint, const std::string& own,
                    const std::string& other) {
    return distance(truth, joint, marker(truth, own)) < distance(truth, joint, marker(truth, other));
}

std::vector<std::string> find_flipped(const io::GroundTruth& truth, const JointPositions& joints) {
    std::vector<std::string> flipped;
    for (const std::string& pair : marked_of(truth.plan).pairs)
        for (const auto& [side, opposite] : sides) {
            const std::string own = side + ("_" + pair), other = opposite + ("_" + pair);
            if (truth.missing.count(own) > 0) continue;
            if (truth.plan == BodyKind::quadruped && !(known_place(truth, own) && known_place(truth, other))) continue;
            if (!is_on_its_side(truth, joints.at(own), own, other)) flipped.push_back(own);
        }
    return flipped;
}

} // namespace

const std::vector<std::string>& evaluated_joints(BodyKind plan) {
    const auto names_of = [](const char* name) {
        std::vector<std::string> names;
        for (const TemplateJoint& joint : builtin_template(name).joints) names.push_back(joint.name);
        return names;
    };
    static const std::vector<std::string> human = names_of("human21"), quadruped = names_of("quadruped");
    return plan == BodyKind::human ? human : quadruped;
}

MeshScore score_joints(const io::GroundTruth& truth, const JointPositions& joints) {
    if (truth.not_a_body) throw Error(ErrorCode::bad_input, "there is no body in the truth; no joints can be compared");
    MeshScore score;
    score.plan = truth.plan;
    score.complete = is_complete(truth, joints);
    if (!score.complete) return score;

    for (const std::string& end : marked_of(truth.plan).ends) {
        const bool is_there = is_of_tail(end) ? known_place(truth, end).has_value() : truth.missing.count(end) == 0;
        if (is_there && !is_right_limb(truth, joints, end)) score.wrong_limbs.push_back(end);
    }
    score.flipped = find_flipped(truth, joints);
    score.limbs = score.wrong_limbs.empty();
    score.sides = score.flipped.empty();
    for (const auto& [name, position] : truth.joints) {
        if (truth.missing.count(name) > 0) continue;
        const auto joint = joints.find(name);
        if (joint == joints.end() && truth.plan == BodyKind::quadruped && is_of_tail(name)) continue;
        if (joint == joints.end())
            throw Error(ErrorCode::bad_input,
                        "the truth has a joint \"" + name + "\" that the skeleton does not; rename or remove it");
        score.errors.emplace_back(name, distance(truth, joint->second, position));
    }
    for (const auto& [name, position] : truth.digits)
        if (const auto joint = joints.find(name); joint != joints.end())
            score.digits.emplace_back(name, distance(truth, joint->second, position));
    return score;
}

std::vector<std::string> joints_outside(const TriangleMesh<double>& mesh, const JointPositions& joints, BodyKind plan) {
    std::vector<std::string> outside;
    for (const std::string& name : evaluated_joints(plan)) {
        const auto joint = joints.find(name);
        if (joint != joints.end() && std::abs(core::winding_number(mesh, joint->second)) < 0.5) outside.push_back(name);
    }
    return outside;
}

} // namespace skelgen::evaluation
