#include "trunk_joints.hpp"

#include <algorithm>
#include <cmath>

namespace skelgen::detail {
namespace {

using enum JointRole;

/// Centre of the limb's last own section, for the limb that begins with joint `j`.
Vector3<double> attachment_point(const Placement& placement, int j) {
    for (const Limb& limb : placement.limbs())
        if (limb.joints.front() == j) return on(limb, std::max(limb.attachment, arc_of(limb, 0)));
    return placement.at(j);
}

/// Mean thickness of the thighs where they are on their own; 0 when nowhere.
double thigh_thickness(const Placement& placement) {
    double sum = 0, count = 0;
    for (const Limb& limb : placement.limbs()) {
        if (placement.joint(limb.joints.front()).role != hip || limb.joints.size() < 2) continue;
        for (Eigen::Index i = 0; i < limb.line.arc.size(); ++i) {
            if (limb.line.arc[i] < limb.attachment || limb.line.arc[i] > arc_of(limb, 1)) continue;
            sum += limb.line.thickness[i];
            count += 1;
        }
    }
    return count > 0 ? sum / count : 0;
}

/// Mean angle in radians by which the thighs are raised from the prolonged trunk; 0 without legs.
double hip_flexion(const Placement& placement, const Vector3<double>& trunk) {
    double sum = 0, count = 0;
    for (const Limb& limb : placement.limbs()) {
        if (placement.joint(limb.joints.front()).role != hip || limb.joints.size() < 2) continue;
        const Vector3<double> thigh = placement.at(limb.joints[1]) - placement.at(limb.joints[0]);
        sum += std::acos(std::clamp(-thigh.normalized().dot(trunk.normalized()), -1.0, 1.0));
        count += 1;
    }
    return count > 0 ? sum / count : 0;
}

} // namespace

void narrow_hips(Placement& placement) {
    const std::vector<int> hips = placement.all(hip);
    if (hips.size() != 2) return;
    const Vector3<double> centre = 0.5 * (placement.at(hips[0]) + placement.at(hips[1]));
    Vector3<double> across = placement.at(hips[0]) - placement.at(hips[1]);
    const double rest = placement.rest_distance(hips[0], hips[1]);
    const Vector3<double> thighs = attachment_point(placement, hips[0]) - attachment_point(placement, hips[1]);
    const bool crossed = across.dot(thighs) < 0.3 * rest * thighs.norm(); // thigh lines that met before the hips
    if (crossed) across = thighs;
    if (!crossed && across.norm() <= rest) return;
    placement.put(hips[0], centre + 0.5 * rest * across.normalized());
    placement.put(hips[1], centre - 0.5 * rest * across.normalized());
}

void place_trunk(Placement& placement, const Slicer& slicer, const Vector3<double>& root,
                 const RefinementOptions& options) {
    const Vector3<double> low = placement.middle(hip).value_or(root);
    const bool has_neck = placement.find(neck) >= 0;
    const int top = has_neck ? placement.find(neck) : placement.find(chest);
    if (!has_neck) placement.put(top, placement.middle(shoulder).value_or(low));
    const Vector3<double> axis = placement.at(top) - low;
    const double flexion = hip_flexion(placement, axis);
    const double rest_low = placement.rest_height(hip), rest_high = placement.joint(top).position.z();
    for (int j = 0; j < static_cast<int>(placement.size()); ++j) {
        const TemplateJoint& joint = placement.joint(j);
        if (j == top || (joint.role != pelvis && joint.role != waist && joint.role != chest)) continue;
        double height = (joint.position.z() - rest_low) / (rest_high - rest_low);
        if (joint.role == waist) height -= options.waist_lowering * flexion;
        const Vector3<double> p = low + height * axis;
        placement.put(j, p);
        if (joint.role != waist) continue;
        const auto section = slicer.around(p, axis.normalized(), 0.1 * placement.scale());
        if (section && (section->centroid - p).norm() < section->thickness) placement.put(j, section->centroid);
    }
}

void raise_crotch(Placement& placement, const TriangleMesh<double>& mesh, const RefinementOptions& options) {
    const int low = placement.find(pelvis);
    const int above = placement.find(waist) >= 0 ? placement.find(waist) : placement.find(chest);
    const double enough = options.crotch_depth * thigh_thickness(placement);
    const Vector3<double> start = placement.at(low), end = placement.at(above);
    constexpr int steps = 10;
    for (int step = 0; step <= steps; ++step) {
        const Vector3<double> p = start + step * 0.5 / steps * (end - start); // never past the middle of the bone
        placement.put(low, p);
        if ((mesh.vertices.rowwise() - p.transpose()).rowwise().norm().minCoeff() >= enough) return;
    }
}

} // namespace skelgen::detail
