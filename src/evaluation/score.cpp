#include <skelgen/evaluation/evaluate.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::evaluation {
namespace {

constexpr double reach = 0.12; // a limb's joint lies within this part of the scale from its marker

constexpr std::array<const char*, 5> ends{"left_hand", "right_hand", "left_foot", "right_foot", "head"};
constexpr std::array<const char*, 5> pairs{"hand", "foot", "elbow", "knee", "shoulder"};
constexpr std::array<std::pair<const char*, const char*>, 2> sides{{{"left", "right"}, {"right", "left"}}};

/// Whether all joints are there that the body has, and none that it lacks.
bool is_complete(const io::GroundTruth& truth, const JointPositions& joints) {
    const auto is_as_it_should = [&](const std::string& name) {
        const auto joint = joints.find(name);
        if (truth.missing.count(name) > 0) return joint == joints.end();
        return joint != joints.end() && joint->second.allFinite();
    };
    return std::all_of(evaluated_joints().begin(), evaluated_joints().end(), is_as_it_should);
}

const Vector3<double>& marker(const io::GroundTruth& truth, const std::string& name) {
    const auto found = truth.markers.find(name);
    if (found == truth.markers.end())
        throw Error(ErrorCode::bad_input, "the truth has no marker \"" + name + "\"; add it");
    return found->second;
}

double distance(const io::GroundTruth& truth, const Vector3<double>& a, const Vector3<double>& b) {
    return (a - b).norm() / truth.scale;
}

/// Whether the end's joint is nearest to its own marker, and near it at all.
bool is_right_limb(const io::GroundTruth& truth, const JointPositions& joints, const std::string& end) {
    const Vector3<double>& joint = joints.at(end);
    const auto to_marker = [&](const std::string& name) { return distance(truth, joint, marker(truth, name)); };
    const auto nearer = [&](const char* a, const char* b) { return to_marker(a) < to_marker(b); };
    return *std::min_element(ends.begin(), ends.end(), nearer) == end && to_marker(end) <= reach;
}

bool is_on_its_side(const io::GroundTruth& truth, const Vector3<double>& joint, const std::string& own,
                    const std::string& other) {
    return distance(truth, joint, marker(truth, own)) < distance(truth, joint, marker(truth, other));
}

std::vector<std::string> find_flipped(const io::GroundTruth& truth, const JointPositions& joints) {
    std::vector<std::string> flipped;
    for (const std::string pair : pairs)
        for (const auto& [side, opposite] : sides) {
            const std::string own = side + ("_" + pair);
            if (truth.missing.count(own) > 0) continue;
            if (!is_on_its_side(truth, joints.at(own), own, opposite + ("_" + pair))) flipped.push_back(own);
        }
    return flipped;
}

} // namespace

const std::vector<std::string>& evaluated_joints() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list{"crotch", "waist", "chest", "neck", "head"};
        for (const std::string side : {"left_", "right_"})
            for (const char* joint : {"shoulder", "elbow", "wrist", "hand", "hip", "knee", "ankle", "foot"})
                list.push_back(side + joint);
        return list;
    }();
    return names;
}

MeshScore score_joints(const io::GroundTruth& truth, const JointPositions& joints) {
    if (truth.not_a_body) throw Error(ErrorCode::bad_input, "there is no body in the truth; no joints can be compared");
    MeshScore score;
    score.complete = is_complete(truth, joints);
    if (!score.complete) return score;

    for (const char* end : ends)
        if (truth.missing.count(end) == 0 && !is_right_limb(truth, joints, end)) score.wrong_limbs.emplace_back(end);
    score.flipped = find_flipped(truth, joints);
    score.limbs = score.wrong_limbs.empty();
    score.sides = score.flipped.empty();
    for (const auto& [name, position] : truth.joints) {
        if (truth.missing.count(name) > 0) continue;
        const auto joint = joints.find(name);
        if (joint == joints.end())
            throw Error(ErrorCode::bad_input,
                        "the truth has a joint \"" + name + "\" that the skeleton does not; rename or remove it");
        score.errors.emplace_back(name, distance(truth, joint->second, position));
    }
    return score;
}

std::vector<std::string> joints_outside(const TriangleMesh<double>& mesh, const JointPositions& joints) {
    std::vector<std::string> outside;
    for (const std::string& name : evaluated_joints()) {
        const auto joint = joints.find(name);
        if (joint != joints.end() && std::abs(core::winding_number(mesh, joint->second)) < 0.5) outside.push_back(name);
    }
    return outside;
}

} // namespace skelgen::evaluation
