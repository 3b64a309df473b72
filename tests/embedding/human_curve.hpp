#pragma once

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/curve_skeleton.hpp>

namespace skelgen::test {

/// The bones of human21 as a curve: node j is joint j, the tips come after the joints; every bone cut in two by further
/// nodes. The head's end is thick, as heads are.
inline CurveSkeleton<double> human_curve() {
    const SkeletonTemplate& human = builtin_template("human21");
    CurveSkeleton<double> curve;
    const auto add = [&](const Vector3<double>& p, double radius) {
        const auto node = static_cast<int>(curve.nodes.rows());
        curve.nodes.conservativeResize(node + 1, 3);
        curve.nodes.row(node) = p.transpose();
        curve.regions.push_back({node});
        curve.radii.push_back(radius);
        return node;
    };
    const auto thickness = [](const TemplateJoint& joint) {
        return joint.role == JointRole::head ? 0.09 : joint.role == JointRole::hand ? 0.03 : 0.05;
    };
    for (const TemplateJoint& joint : human.joints) add(joint.position, thickness(joint));
    for (std::size_t j = 0; j < human.joints.size(); ++j) {
        const TemplateJoint& joint = human.joints[j];
        if (joint.parent >= 0) {
            const TemplateJoint& parent = human.joints[static_cast<std::size_t>(joint.parent)];
            const int middle = add(0.5 * (parent.position + joint.position), thickness(joint));
            curve.edges.push_back({joint.parent, middle});
            curve.edges.push_back({static_cast<int>(j), middle});
        }
        if (joint.tip) curve.edges.push_back({static_cast<int>(j), add(*joint.tip, 0)});
    }
    return curve;
}

/// The same curve in another precision.
template <typename Scalar>
CurveSkeleton<Scalar> in_precision(const CurveSkeleton<double>& curve) {
    return {curve.nodes.cast<Scalar>(), curve.edges, curve.regions, {curve.radii.begin(), curve.radii.end()}};
}

} // namespace skelgen::test
