#include <skelgen/refinement/settle.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/refinement/cross_section.hpp>

namespace skelgen {
namespace {

using enum JointRole;

// Calibrated; as parts of the thigh, the upper arm and the bone from chest to neck.
constexpr double knee_forward = 0.034, knee_outward = 0.021, straight_knee_up = 0.0125, bent_knee_down = 0.04;
constexpr double hip_outwards = 0.02;
constexpr double shoulder_forward = 0.035, shoulder_outwards = 0.035;
constexpr double neck_backward = 0.065;

/// Positions of a skeleton's joints by role and side.
class Joints {
public:
    Joints(KinematicSkeleton<double>& skeleton, const SkeletonTemplate& skeleton_template)
        : skeleton_(skeleton), template_(skeleton_template) {}

    [[nodiscard]] Vector3<double>* find(JointRole role, Side side = Side::none) {
        for (std::size_t j = 0; j < template_.joints.size(); ++j)
            if (template_.joints[j].role == role && template_.joints[j].side == side)
                return &skeleton_.joints[j].position;
        return nullptr;
    }

private:
    KinematicSkeleton<double>& skeleton_;
    const SkeletonTemplate& template_;
};

Vector3<double> normal_part(const Vector3<double>& v, const Vector3<double>& axis) { return v - v.dot(axis) * axis; }

/// The front of a knee is where the foot points; the more it is bent, the less flesh there is to one side only, and the
/// farther the fold of the skin lies towards the hip from the joint.
void move_knee(Joints& joints, Side side) {
    Vector3<double>* const knee_at = joints.find(knee, side);
    const Vector3<double>*const hip_at = joints.find(hip, side), *const ankle_at = joints.find(ankle, side),
                                *const foot_at = joints.find(foot, side);
    if (!knee_at || !hip_at || !ankle_at || !foot_at) return;
    const Vector3<double> thigh = (*hip_at - *knee_at).normalized(), calf = (*knee_at - *ankle_at).normalized();
    const Vector3<double> up = (thigh + calf).normalized();
    const Vector3<double> forward = normal_part(*foot_at - *ankle_at, up).normalized(), left = up.cross(forward);
    if (!forward.allFinite() || !left.allFinite()) return;
    const double length = (*hip_at - *knee_at).norm(), straight = std::max(0.0, thigh.dot(calf));
    *knee_at +=
        length * (straight * (knee_forward * forward + (side == Side::left ? knee_outward : -knee_outward) * left) +
                  (straight * straight_knee_up - (1 - straight) * bent_knee_down) * up);
}

/// A hip is a little farther down its thigh than the thigh's line goes on to.
void move_hip(Joints& joints, Side side) {
    Vector3<double>* const hip_at = joints.find(hip, side);
    const Vector3<double>* const knee_at = joints.find(knee, side);
    if (hip_at && knee_at) *hip_at += hip_outwards * (*knee_at - *hip_at);
}

/// The back of a neck and the front of the shoulders, by where shoulders, trunk and neck face.
void move_shoulder_girdle(Joints& joints) {
    Vector3<double>*const neck_at = joints.find(neck), *const left_at = joints.find(shoulder, Side::left),
                          *const right_at = joints.find(shoulder, Side::right);
    const Vector3<double>* const chest_at = joints.find(chest);
    if (!neck_at || !chest_at || !left_at || !right_at) return;
    const Vector3<double> up = *neck_at - *chest_at;
    const Vector3<double> forward = (*left_at - *right_at).cross(up).normalized();
    if (!forward.allFinite()) return;
    *neck_at -= neck_backward * up.norm() * forward;
    for (const Side side : {Side::left, Side::right})
        if (const Vector3<double>* const elbow_at = joints.find(elbow, side)) {
            Vector3<double>& shoulder_at = *joints.find(shoulder, side);
            const Vector3<double> arm = *elbow_at - shoulder_at;
            shoulder_at += shoulder_outwards * arm + shoulder_forward * arm.norm() * forward;
        }
}

/// The joint of the same role on the other side; -1 for a joint that has no side.
int counterpart(const SkeletonTemplate& skeleton_template, std::size_t j) {
    const TemplateJoint& joint = skeleton_template.joints[j];
    if (joint.side == Side::none) return -1;
    for (std::size_t k = 0; k < skeleton_template.joints.size(); ++k) {
        const TemplateJoint& other = skeleton_template.joints[k];
        if (other.role == joint.role && other.side != joint.side && other.side != Side::none)
            return static_cast<int>(k);
    }
    return -1;
}

/// Makes the bone between two joints longer by that part of its length.
void stretch(Vector3<double>& a, Vector3<double>& b, double part) {
    const Vector3<double> half = part / 2 * (b - a);
    a -= half;
    b += half;
}

/// Length of the bone from its parent to each joint; 0 for the root.
template <typename Position>
std::vector<double> bone_lengths(const SkeletonTemplate& skeleton_template, Position&& position) {
    std::vector<double> out(skeleton_template.joints.size(), 0);
    for (std::size_t j = 0; j < out.size(); ++j)
        if (const int parent = skeleton_template.joints[j].parent; parent >= 0)
            out[j] = (position(j) - position(static_cast<std::size_t>(parent))).norm();
    return out;
}

double median_of_positive(std::vector<double> values) {
    std::erase_if(values, [](double v) { return !(v > 0); });
    if (values.empty()) return 1;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace

int judge_joints(KinematicSkeleton<double>& skeleton, const SkeletonTemplate& skeleton_template) {
    constexpr double half_by_other_side = 0.15, half_by_template = 0.3; // logarithms of ratios
    const auto lengths = bone_lengths(skeleton_template, [&](std::size_t j) { return skeleton.joints[j].position; });
    const auto rest =
        bone_lengths(skeleton_template, [&](std::size_t j) { return skeleton_template.joints[j].position; });
    std::vector<double> ratios(lengths.size(), 0);
    for (std::size_t j = 0; j < ratios.size(); ++j)
        if (rest[j] > 0) ratios[j] = lengths[j] / rest[j];
    const double scale = median_of_positive(ratios);
    const double slack = 0.1 * scale * median_of_positive(rest); // a short bone's length says little
    const auto compare = [&](double a, double b) { return std::log((a + slack) / (b + slack)); };
    std::vector<double> doubt(skeleton.joints.size(), 0);
    for (std::size_t j = 0; j < doubt.size(); ++j) {
        const int parent = skeleton.joints[j].parent;
        if (parent < 0) continue;
        const double by_template = compare(lengths[j], scale * rest[j]) / half_by_template;
        double bone = by_template * by_template;
        if (const int other = counterpart(skeleton_template, j); other >= 0) {
            const double by_side = compare(lengths[j], lengths[static_cast<std::size_t>(other)]) / half_by_other_side;
            bone += by_side * by_side;
        }
        doubt[j] = std::max(doubt[j], bone);
        const bool same_limb =
            skeleton_template.joints[static_cast<std::size_t>(parent)].side == skeleton_template.joints[j].side;
        if (same_limb)
            doubt[static_cast<std::size_t>(parent)] = std::max(doubt[static_cast<std::size_t>(parent)], bone);
    }
    int misplaced = 0;
    bool limb_misplaced = false;
    for (std::size_t j = 0; j < doubt.size(); ++j) {
        Joint<double>& joint = skeleton.joints[j];
        joint.confidence = 1 / (1 + doubt[j]);
        if (joint.confidence >= 0.1) continue;
        ++misplaced;
        limb_misplaced = limb_misplaced || skeleton_template.joints[j].side != Side::none;
        skeleton.quality.warnings.push_back("joint " + joint.name +
                                            " may be misplaced: its bones have unlikely lengths");
    }
    constexpr double side_in_doubt = 0.75;
    if (limb_misplaced) skeleton.quality.sides_confidence *= side_in_doubt;
    return misplaced;
}

void move_to_bones(KinematicSkeleton<double>& skeleton, const SkeletonTemplate& skeleton_template) {
    Joints joints(skeleton, skeleton_template);
    for (const Side side : {Side::left, Side::right}) {
        move_knee(joints, side);
        move_hip(joints, side);
    }
    move_shoulder_girdle(joints);
}

void balance_bones(KinematicSkeleton<double>& skeleton, const SkeletonTemplate& skeleton_template) {
    constexpr double largest_difference = 0.04;
    constexpr double hopeless = 0.3; // one side is plainly misplaced: averaging would spoil the other
    constexpr int rounds = 30;
    const auto at = [&](int j) -> Vector3<double>& { return skeleton.joints[static_cast<std::size_t>(j)].position; };
    for (int round = 0; round < rounds; ++round)
        for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
            const int left = static_cast<int>(j), right = counterpart(skeleton_template, j);
            if (right < left) continue; // none, or seen from the other side
            const int left_parent = skeleton.joints[j].parent;
            const int right_parent = skeleton.joints[static_cast<std::size_t>(right)].parent;
            if (left_parent == right_parent) continue; // from the trunk: collar bones move
            const double ratio = std::log((at(left) - at(left_parent)).norm() / (at(right) - at(right_parent)).norm());
            const double excess = ratio - std::clamp(ratio, -largest_difference, largest_difference);
            if (!(std::abs(excess) > 0) || std::abs(ratio) > hopeless) continue;
            stretch(at(left), at(left_parent), -excess / 2);
            stretch(at(right), at(right_parent), excess / 2);
        }
}

void keep_inside(KinematicSkeleton<double>& skeleton, const TriangleMesh<double>& mesh,
                 const CurveSkeleton<double>& curve) {
    constexpr int steps = 20;
    const auto is_inside = [&](const Vector3<double>& p) { return winding_number(mesh, p) > 0.5; };
    std::vector<Joint<double>*> outside;
    for (Joint<double>& joint : skeleton.joints)
        if (!is_inside(joint.position)) outside.push_back(&joint);
    if (6 * outside.size() > skeleton.joints.size())
        throw Error(ErrorCode::no_skeleton, "no human body: " + std::to_string(outside.size()) +
                                                " joints of its skeleton would lie outside of it");
    for (Joint<double>* const moved : outside) {
        Joint<double>& joint = *moved;
        Eigen::Index nearest = 0;
        (curve.nodes.rowwise() - joint.position.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
        const Vector3<double> start = joint.position, way = curve.nodes.row(nearest).transpose() - start;
        const auto part = [&](int step) -> Vector3<double> {
            return start + std::min(step, steps) / double{steps} * way;
        };
        int step = 1;
        while (step < steps && !is_inside(part(step))) ++step;
        joint.position = is_inside(part(step + 1)) ? part(step + 1) : part(step); // not on the surface itself
        joint.confidence /= 2;
        skeleton.quality.warnings.push_back("joint " + joint.name + " was outside the surface and has been moved in");
    }
}

void measure_radii(KinematicSkeleton<double>& skeleton, const TriangleMesh<double>& mesh) {
    const Triangles adjacency = face_adjacency(mesh.faces);
    const Slicer slicer(mesh, adjacency);
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        Joint<double>& joint = skeleton.joints[j];
        auto other = static_cast<std::size_t>(std::max(joint.parent, 0));
        if (joint.parent < 0)
            while (other + 1 < skeleton.joints.size() && skeleton.joints[other].parent != static_cast<int>(j)) ++other;
        const Vector3<double> bone = joint.position - skeleton.joints[other].position;
        if (!(bone.norm() > 0)) continue;
        if (const auto section = slicer.around(joint.position, bone.normalized(), 0.5 * bone.norm()))
            joint.radius = section->thickness;
    }
}

} // namespace skelgen
