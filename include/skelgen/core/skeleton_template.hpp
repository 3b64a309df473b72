#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// The anatomical meaning of a template joint: what the refinement's prior knowledge (LF20 section 3.2.2) is addressed
/// to. On four legs, fore legs have the roles of arms; those from shoulder_girdle on are animals' alone.
enum class JointRole {
    pelvis,
    waist,
    chest,
    neck,
    head,
    shoulder,
    elbow,
    wrist,
    hand,
    hip,
    knee,
    ankle,
    foot,
    shoulder_girdle,
    hip_girdle,
    tail,
    ear
};

/// How a body is made: what is looked for, and how.
enum class BodyKind { human, quadruped };

enum class Side { none, left, right };

/// What names of a side's joints and parts begin with; nothing for those of none.
[[nodiscard]] constexpr std::string_view side_prefix(Side side) {
    return side == Side::left ? "left_" : side == Side::right ? "right_" : "";
}

/// A name without its side, left_elbow as elbow.
struct SidedName {
    Side side = Side::none;
    std::string_view plain; ///< within the whole name
};

[[nodiscard]] constexpr SidedName split_side(std::string_view name) {
    for (const Side side : {Side::left, Side::right})
        if (name.starts_with(side_prefix(side))) return {side, name.substr(side_prefix(side).size())};
    return {Side::none, name};
}

/// The name of the same joint or part on the other side.
[[nodiscard]] inline std::string mirrored_name(std::string_view name) {
    const auto [side, plain] = split_side(name);
    if (side == Side::none) return std::string(name);
    return std::string(side_prefix(side == Side::left ? Side::right : Side::left)).append(plain);
}

/// 1 for the left side, -1 for the right one, 0 for none: as x in template coordinates.
[[nodiscard]] constexpr int sign_of(Side side) { return side == Side::left ? 1 : side == Side::right ? -1 : 0; }

/// The part of the body that a role belongs to.
enum class BodyPart { trunk, arm, leg };

[[nodiscard]] constexpr BodyPart part_of(JointRole role) {
    if (role >= JointRole::shoulder_girdle) return BodyPart::trunk;
    if (role >= JointRole::hip) return BodyPart::leg;
    return role >= JointRole::shoulder ? BodyPart::arm : BodyPart::trunk;
}

/// Does a limb end in a joint of this role?
[[nodiscard]] constexpr bool ends_limb(JointRole role) {
    return role == JointRole::head || role == JointRole::hand || role == JointRole::foot;
}

/// One joint of a template, in a rest pose that only has to have the right proportions. Rest poses are read from files
/// and tabulated: they are double whatever the scalar of the mesh.
struct TemplateJoint {
    std::string name;
    int parent = -1; ///< index into the joints, smaller than the joint's own; -1 for the root
    JointRole role = JointRole::pelvis;
    Side side = Side::none;
    Vector3<double> position = Vector3<double>::Zero(); ///< rest pose, any unit: x to the body's left, y up, z forward
    double radius = 0; ///< of an end joint: mean distance to the surface around it, same unit; 0: not known
    std::optional<Vector3<double>> tip; ///< of an end joint: the limb's end on the surface, same coordinates
    bool is_absent = false;             ///< the body looked for lacks it, and all joints after it: see without_limb
};

/// A kinematic skeleton to be found in a mesh: a tree of joints with parents before children.
struct SkeletonTemplate {
    std::string name;
    std::vector<TemplateJoint> joints;
    bool is_adapted = false; ///< head and limbs have the lengths of a body that was laid into a surface
    BodyKind plan = BodyKind::human;

    [[nodiscard]] const TemplateJoint& joint(int j) const { return joints[static_cast<std::size_t>(j)]; }
};

/// What the end of the limb that a joint ends in is called: head_top, left_fingertip, right_toe; of animals head_tip,
/// left_fore_toe, right_hind_toe. The joint's role must be one that ends a limb.
[[nodiscard]] inline std::string end_point_name(const SkeletonTemplate& skeleton_template, const TemplateJoint& joint) {
    const bool is_human = skeleton_template.plan == BodyKind::human;
    const char* end = joint.role == JointRole::hand   ? (is_human ? "fingertip" : "fore_toe")
                      : joint.role == JointRole::foot ? (is_human ? "toe" : "hind_toe")
                                                      : (is_human ? "head_top" : "head_tip");
    return std::string(side_prefix(joint.side)) + end;
}

/// Index of the first joint of that role and side; -1 where there is none. O(joints).
[[nodiscard]] inline int find_joint(const SkeletonTemplate& skeleton_template, JointRole role, Side side = Side::none) {
    for (std::size_t j = 0; j < skeleton_template.joints.size(); ++j)
        if (skeleton_template.joints[j].role == role && skeleton_template.joints[j].side == side)
            return static_cast<int>(j);
    return -1;
}

/// Index of the joint of the same role on the other side; -1 for a joint that has no side. O(joints).
[[nodiscard]] inline int counterpart(const SkeletonTemplate& skeleton_template, int j) {
    const TemplateJoint& joint = skeleton_template.joint(j);
    if (joint.side == Side::none) return -1;
    return find_joint(skeleton_template, joint.role, joint.side == Side::left ? Side::right : Side::left);
}

/// Is a joint all that is left of its limb or of the head, a shoulder, hip or neck that nothing follows? Such a joint
/// is in the trunk: no branch of a curve leads to it. O(joints).
[[nodiscard]] inline bool is_bare(const SkeletonTemplate& skeleton_template, int j) {
    const JointRole role = skeleton_template.joint(j).role;
    if (role != JointRole::neck && role != JointRole::shoulder && role != JointRole::hip) return false;
    for (const TemplateJoint& joint : skeleton_template.joints)
        if (joint.parent == j && !joint.is_absent) return false;
    return true;
}

/// The template of a body whose limb ends before joint `first`, which is not the root: that joint and all after it are
/// absent. A limb then ends a little beyond the joint before it: people cut beside joints. O(joints^2).
[[nodiscard]] inline SkeletonTemplate without_limb(SkeletonTemplate skeleton_template, int first) {
    constexpr double left = 0.15; // of the next bone
    std::vector<TemplateJoint>& joints = skeleton_template.joints;
    const auto at = [&](int j) -> TemplateJoint& { return joints[static_cast<std::size_t>(j)]; };
    at(first).is_absent = true;
    for (TemplateJoint& joint : joints)
        if (joint.parent >= 0 && at(joint.parent).is_absent) joint.is_absent = true;
    TemplateJoint& last = at(at(first).parent);
    if (part_of(last.role) != BodyPart::trunk && !is_bare(skeleton_template, at(first).parent))
        last.tip = last.position + left * (at(first).position - last.position);
    return skeleton_template;
}

/// Length of the bone between two joints in the rest pose, in the template's unit.
[[nodiscard]] inline double rest_length(const SkeletonTemplate& skeleton_template, int a, int b) {
    return (skeleton_template.joint(a).position - skeleton_template.joint(b).position).norm();
}

} // namespace skelgen
