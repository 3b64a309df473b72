#pragma once

#include <optional>
#include <string>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// The anatomical meaning of a template joint: what the refinement's prior knowledge (LF20 3.2.2) is addressed to.
enum class JointRole { pelvis, waist, chest, neck, head, shoulder, elbow, wrist, hand, hip, knee, ankle, foot };

enum class Side { none, left, right };

/// One joint of a template, in a rest pose that only has to have the right proportions.
struct TemplateJoint {
    std::string name;
    int parent = -1; ///< index into the joints, smaller than the joint's own; -1 for the root
    JointRole role = JointRole::pelvis;
    Side side = Side::none;
    Vector3<double> position = Vector3<double>::Zero(); ///< rest pose, any unit: x to the body's left, y forward, z up
    double radius = 0; ///< of an end joint: mean distance to the surface around it, same unit; 0: not known
    std::optional<Vector3<double>> tip; ///< of an end joint: the limb's end on the surface, same coordinates
};

/// A kinematic skeleton to be found in a mesh: a tree of joints with parents before children.
struct SkeletonTemplate {
    std::string name;
    std::vector<TemplateJoint> joints;
};

} // namespace skelgen
