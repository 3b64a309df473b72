#include <skelgen/core/template_rules.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include <skelgen/core/error.hpp>

namespace skelgen {
namespace {

/// Where a joint may stand: limbs grow from a joint of the trunk, and within a chain the rank rises.
enum class Chain { trunk, arm, leg };

struct RoleRule {
    std::string_view name;
    Chain chain;
    int rank;
    bool repeats; ///< may several joints have the role?
    bool ends;    ///< does a branch end here?
};

RoleRule rule_of(JointRole role) {
    switch (role) {
    case JointRole::pelvis:
        return {"pelvis", Chain::trunk, 0, false, false};
    case JointRole::waist:
        return {"waist", Chain::trunk, 1, true, false};
    case JointRole::chest:
        return {"chest", Chain::trunk, 2, false, false};
    case JointRole::neck:
        return {"neck", Chain::trunk, 3, true, false};
    case JointRole::head:
        return {"head", Chain::trunk, 4, false, true};
    case JointRole::shoulder:
        return {"shoulder", Chain::arm, 0, false, false};
    case JointRole::elbow:
        return {"elbow", Chain::arm, 1, false, false};
    case JointRole::wrist:
        return {"wrist", Chain::arm, 2, false, false};
    case JointRole::hand:
        return {"hand", Chain::arm, 3, false, true};
    case JointRole::hip:
        return {"hip", Chain::leg, 0, false, false};
    case JointRole::knee:
        return {"knee", Chain::leg, 1, false, false};
    case JointRole::ankle:
        return {"ankle", Chain::leg, 2, false, false};
    case JointRole::foot:
        return {"foot", Chain::leg, 3, false, true};
    }
    throw Error(ErrorCode::usage, "JointRole holds a value that is none of its enumerators");
}

std::string quoted(const TemplateJoint& joint) { return "joint '" + joint.name + "'"; }

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::bad_input, what); }

bool is_same_place(const TemplateJoint& a, const TemplateJoint& b) { return a.role == b.role && a.side == b.side; }

const TemplateJoint* find(const SkeletonTemplate& t, JointRole role, Side side) {
    const auto found = std::find_if(t.joints.begin(), t.joints.end(),
                                    [&](const TemplateJoint& j) { return j.role == role && j.side == side; });
    return found == t.joints.end() ? nullptr : &*found;
}

std::string place_name(JointRole role, Side side) {
    const std::string role_name(to_string(role));
    return side == Side::none ? role_name : std::string(to_string(side)) + " " + role_name;
}

void check_tip(const TemplateJoint& joint) {
    if (!joint.tip) return;
    if (!rule_of(joint.role).ends) refuse(quoted(joint) + " has a tip: only the head, hands and feet may");
    if (!joint.tip->allFinite()) refuse(quoted(joint) + " has a tip that is not finite");
    if (*joint.tip == joint.position)
        refuse(quoted(joint) + " has its tip in its own place: move the tip to the surface");
}

void check_values(const SkeletonTemplate& t) {
    if (t.name.empty()) refuse("the template has no name: give it one");
    if (t.joints.empty()) refuse("the template has no joints");
    for (const TemplateJoint& joint : t.joints) {
        if (joint.name.empty()) refuse("a joint has an empty name: give every joint a name of its own");
        if (!joint.position.allFinite()) refuse(quoted(joint) + " has a position that is not finite");
        check_tip(joint);
        const bool on_a_side = joint.side != Side::none;
        const bool in_the_trunk = rule_of(joint.role).chain == Chain::trunk;
        if (on_a_side && in_the_trunk)
            refuse(quoted(joint) + " is a " + std::string(to_string(joint.role)) + ": its side must be none");
        if (!on_a_side && !in_the_trunk)
            refuse(quoted(joint) + " is a " + std::string(to_string(joint.role)) + ": its side must be left or right");
    }
}

void check_uniqueness(const SkeletonTemplate& t) {
    for (std::size_t i = 0; i < t.joints.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const TemplateJoint& joint = t.joints[i];
            if (joint.name == t.joints[k].name) refuse("two joints are named '" + joint.name + "'");
            if (is_same_place(joint, t.joints[k]) && !rule_of(joint.role).repeats)
                refuse("joints '" + t.joints[k].name + "' and '" + joint.name + "' are both the " +
                       place_name(joint.role, joint.side) + ": there must be one");
        }
}

void check_completeness(const SkeletonTemplate& t) {
    constexpr std::array required{
        std::pair{JointRole::pelvis, Side::none}, std::pair{JointRole::chest, Side::none},
        std::pair{JointRole::head, Side::none},   std::pair{JointRole::hand, Side::left},
        std::pair{JointRole::hand, Side::right},  std::pair{JointRole::foot, Side::left},
        std::pair{JointRole::foot, Side::right},
    };
    for (const auto& [role, side] : required)
        if (find(t, role, side) == nullptr) refuse("there is no " + place_name(role, side) + ": add one");
}

void check_symmetry(const SkeletonTemplate& t) {
    for (const TemplateJoint& joint : t.joints) {
        if (joint.side == Side::none) continue;
        const Side other_side = joint.side == Side::left ? Side::right : Side::left;
        const TemplateJoint* other = find(t, joint.role, other_side);
        if (other == nullptr)
            refuse(quoted(joint) + " has no counterpart: add a " + place_name(joint.role, other_side));
        if (joint.side == Side::left && joint.position.x() <= other->position.x())
            refuse(quoted(joint) + " is not to the left of '" + other->name +
                   "': x must grow towards the person's own left");
    }
}

bool may_follow(const TemplateJoint& parent, const TemplateJoint& child) {
    const RoleRule above = rule_of(parent.role);
    const RoleRule below = rule_of(child.role);
    if (above.chain == below.chain)
        return parent.side == child.side && (above.rank < below.rank || (above.rank == below.rank && below.repeats));
    return (below.chain == Chain::arm && parent.role == JointRole::chest) ||
           (below.chain == Chain::leg && parent.role == JointRole::pelvis);
}

void check_bone(const TemplateJoint& parent, const TemplateJoint& child) {
    if (!may_follow(parent, child))
        refuse(quoted(child) + ", a " + place_name(child.role, child.side) + ", cannot hang on '" + parent.name +
               "', a " + place_name(parent.role, parent.side));
    if (parent.position == child.position)
        refuse(quoted(child) + " lies where its parent '" + parent.name + "' lies: a bone needs a length");
}

void check_tree(const SkeletonTemplate& t) {
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
        check_bone(t.joints[parent], joint);
        has_child[parent] = true;
    }
    for (std::size_t i = 0; i < t.joints.size(); ++i)
        if (has_child[i] == rule_of(t.joints[i].role).ends)
            refuse(quoted(t.joints[i]) + (has_child[i] ? " must end its branch, and has a child"
                                                       : " ends a branch: only the head, hands and feet may"));
}

} // namespace

std::string_view to_string(JointRole role) { return rule_of(role).name; }

std::string_view to_string(Side side) {
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

void validate_template(const SkeletonTemplate& skeleton_template) {
    check_values(skeleton_template);
    check_uniqueness(skeleton_template);
    check_completeness(skeleton_template);
    check_symmetry(skeleton_template);
    check_tree(skeleton_template);
}

} // namespace skelgen
