#pragma once

#include <skelgen/core/template_rules.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include <skelgen/core/error.hpp>
#include <skelgen/core/header_only.hpp>

namespace skelgen {
namespace core::detail {

/// Roles in the order of JointRole, which is also the order in which they follow each other along a trunk or a limb.
constexpr std::array<std::string_view, 17> role_names{
    "pelvis", "waist", "chest",           "neck",       "head", "shoulder", "elbow", "wrist", "hand", "hip", "knee",
    "ankle",  "foot",  "shoulder_girdle", "hip_girdle", "tail", "ear"};

/// Roles that animals alone have.
constexpr bool is_animals(JointRole role) { return role >= JointRole::shoulder_girdle; }

/// May several joints have the role?
constexpr bool repeats(JointRole role) {
    return role == JointRole::waist || role == JointRole::neck || role == JointRole::tail;
}

inline std::string quoted(const TemplateJoint& joint) { return "joint '" + joint.name + "'"; }

[[noreturn]] inline void refuse(const std::string& what) { throw Error(ErrorCode::bad_input, what); }

inline std::string place_name(JointRole role, Side side) {
    const std::string role_name(to_string(role));
    return side == Side::none ? role_name : std::string(to_string(side)) + " " + role_name;
}

inline void check_tip(const TemplateJoint& joint) {
    if (!joint.tip) return;
    if (!ends_limb(joint.role)) refuse(quoted(joint) + " has a tip: only the head, hands and feet may");
    if (!joint.tip->allFinite()) refuse(quoted(joint) + " has a tip that is not finite");
    if (*joint.tip == joint.position)
        refuse(quoted(joint) + " has its tip in its own place: move the tip to the surface");
}

inline void check_values(const SkeletonTemplate& t) {
    if (t.name.empty()) refuse("the template has no name: give it one");
    if (t.joints.empty()) refuse("the template has no joints");
    for (const TemplateJoint& joint : t.joints) {
        if (joint.name.empty()) refuse("a joint has an empty name: give every joint a name of its own");
        if (!joint.position.allFinite()) refuse(quoted(joint) + " has a position that is not finite");
        check_tip(joint);
        const bool on_a_side = joint.side != Side::none;
        const bool in_the_trunk =
            part_of(joint.role) == BodyPart::trunk && (!is_animals(joint.role) || joint.role == JointRole::tail);
        if (on_a_side && in_the_trunk)
            refuse(quoted(joint) + " is a " + std::string(to_string(joint.role)) + ": its side must be none");
        if (!on_a_side && !in_the_trunk)
            refuse(quoted(joint) + " is a " + std::string(to_string(joint.role)) + ": its side must be left or right");
    }
}

inline void check_uniqueness(const SkeletonTemplate& t) {
    for (std::size_t i = 0; i < t.joints.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const TemplateJoint& joint = t.joints[i];
            if (joint.name == t.joints[k].name) refuse("two joints are named '" + joint.name + "'");
            if (joint.role == t.joints[k].role && joint.side == t.joints[k].side && !repeats(joint.role))
                refuse("joints '" + t.joints[k].name + "' and '" + joint.name + "' are both the " +
                       place_name(joint.role, joint.side) + ": there must be one");
        }
}

inline void check_completeness(const SkeletonTemplate& t) {
    using enum JointRole;
    for (const JointRole role : {pelvis, chest, head})
        if (find_joint(t, role) < 0) refuse("there is no " + place_name(role, Side::none) + ": add one");
    for (const JointRole role : {hand, hip, knee, foot})
        for (const Side side : {Side::left, Side::right})
            if (find_joint(t, role, side) < 0) refuse("there is no " + place_name(role, side) + ": add one");
}

inline void check_symmetry(const SkeletonTemplate& t) {
    for (std::size_t j = 0; j < t.joints.size(); ++j) {
        const TemplateJoint& joint = t.joints[j];
        if (joint.side == Side::none) continue;
        const Side other_side = joint.side == Side::left ? Side::right : Side::left;
        const int other = counterpart(t, static_cast<int>(j));
        if (other < 0) refuse(quoted(joint) + " has no counterpart: add a " + place_name(joint.role, other_side));
        if (joint.side == Side::left && joint.position.x() <= t.joint(other).position.x())
            refuse(quoted(joint) + " is not to the left of '" + t.joint(other).name +
                   "': x must grow towards the person's own left");
    }
}

/// Heights along the trunk are measured from the hips to its upper end.
inline void check_trunk(const SkeletonTemplate& t) {
    const int neck = find_joint(t, JointRole::neck);
    const TemplateJoint& top = t.joint(neck >= 0 ? neck : find_joint(t, JointRole::chest));
    for (const Side side : {Side::left, Side::right}) {
        const TemplateJoint& hip = t.joint(find_joint(t, JointRole::hip, side));
        if (!(top.position.y() > hip.position.y()))
            refuse(quoted(top) + " is not above '" + hip.name + "': y must grow from the hips to the head");
    }
}

inline bool may_follow(const TemplateJoint& parent, const TemplateJoint& child) {
    const BodyPart part = part_of(child.role);
    if (part_of(parent.role) == part)
        return parent.side == child.side &&
               (parent.role < child.role || (parent.role == child.role && repeats(child.role)));
    return (part == BodyPart::arm && parent.role == JointRole::chest) ||
           (part == BodyPart::leg && parent.role == JointRole::pelvis);
}

inline void check_bone(const TemplateJoint& parent, const TemplateJoint& child) {
    if (!may_follow(parent, child))
        refuse(quoted(child) + ", a " + place_name(child.role, child.side) + ", cannot hang on '" + parent.name +
               "', a " + place_name(parent.role, parent.side));
    if (parent.position == child.position)
        refuse(quoted(child) + " lies where its parent '" + parent.name + "' lies: a bone needs a length");
}

inline void check_human_roles(const SkeletonTemplate& t) {
    for (const TemplateJoint& joint : t.joints)
        if (is_animals(joint.role))
            refuse(quoted(joint) + " is a " + std::string(to_string(joint.role)) +
                   ": only a template of the plan quadruped has one");
}

/// How many joints of a role are placed in an animal.
constexpr int most_of(JointRole role) { return role == JointRole::tail ? 4 : repeats(role) ? 2 : 1; }

inline void check_counts(const SkeletonTemplate& t) {
    for (const TemplateJoint& joint : t.joints) {
        const auto is_alike = [&](const TemplateJoint& other) {
            return other.role == joint.role && other.side == joint.side;
        };
        if (std::count_if(t.joints.begin(), t.joints.end(), is_alike) > most_of(joint.role))
            refuse("there are more than " + std::to_string(most_of(joint.role)) + " joints of the role " +
                   std::string(to_string(joint.role)) + ": leave some out");
    }
}

inline void check_tree(const SkeletonTemplate& t) {
    if (t.joints.front().role != JointRole::pelvis)
        refuse(quoted(t.joints.front()) + " comes first: the root, which is the pelvis, must");
    std::vector<bool> has_child(t.joints.size(), false);
    for (std::size_t i = 0; i < t.joints.size(); ++i) {
        const TemplateJoint& joint = t.joints[i];
        if ((joint.parent < 0) != (i == 0))
            refuse(quoted(joint) + (i == 0 ? " comes first and has a parent: the first joint is the root"
                                           : " has no parent: only the first joint, the root, may have none"));
        if (i == 0) continue;
        const auto parent = static_cast<std::size_t>(joint.parent);
        if (parent >= i) refuse(quoted(joint) + " comes before its parent: list parents before children");
        if (t.plan == BodyKind::human) check_bone(t.joints[parent], joint);
        has_child[parent] = true;
    }
    if (t.plan == BodyKind::quadruped) return;
    for (std::size_t i = 0; i < t.joints.size(); ++i)
        if (has_child[i] == ends_limb(t.joints[i].role))
            refuse(quoted(t.joints[i]) + (has_child[i] ? " must end its branch, and has a child"
                                                       : " ends a branch: only the head, hands and feet may"));
}

} // namespace core::detail

SKELGEN_INLINE std::string_view to_string(JointRole role) {
    const auto i = static_cast<std::size_t>(role);
    if (i >= core::detail::role_names.size())
        throw Error(ErrorCode::usage, "JointRole holds a value that is none of its enumerators");
    return core::detail::role_names[i];
}

SKELGEN_INLINE std::string_view to_string(BodyKind plan) { return plan == BodyKind::human ? "human" : "quadruped"; }

SKELGEN_INLINE std::string_view to_string(Side side) {
    switch (side) {
    case Side::none:
        return "none";
    case Side::left:
        return "left";
    case Side::right:
        return "right";
    }
    throw Error(ErrorCode::usage, "Side holds a value that is none of its enumerators");
}

SKELGEN_INLINE void validate_template(const SkeletonTemplate& skeleton_template) {
    const bool is_human = skeleton_template.plan == BodyKind::human;
    core::detail::check_values(skeleton_template);
    if (is_human) core::detail::check_human_roles(skeleton_template);
    core::detail::check_uniqueness(skeleton_template);
    core::detail::check_completeness(skeleton_template);
    core::detail::check_symmetry(skeleton_template);
    core::detail::check_tree(skeleton_template);
    if (is_human)
        core::detail::check_trunk(skeleton_template);
    else
        core::detail::check_counts(skeleton_template);
}

} // namespace skelgen
