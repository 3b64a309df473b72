#include "placement.hpp"

#include <utility>

#include <skelgen/core/polyline.hpp>

namespace skelgen::detail {

Placement::Placement(const SkeletonTemplate& skeleton_template, std::vector<Limb> limbs, double scale)
    : template_(skeleton_template), limbs_(std::move(limbs)), scale_(scale),
      positions_(Points<double>::Zero(static_cast<Eigen::Index>(skeleton_template.joints.size()), 3)) {}

std::vector<int> Placement::all(JointRole role) const {
    std::vector<int> joints;
    for (std::size_t j = 0; j < template_.joints.size(); ++j)
        if (template_.joints[j].role == role) joints.push_back(static_cast<int>(j));
    return joints;
}

int Placement::find(JointRole role) const {
    const std::vector<int> joints = all(role);
    return joints.empty() ? -1 : joints.front();
}

std::optional<std::size_t> Placement::find(const Limb& limb, JointRole role) const {
    for (std::size_t i = 0; i < limb.joints.size(); ++i)
        if (joint(limb.joints[i]).role == role) return i;
    return std::nullopt;
}

std::optional<Vector3<double>> Placement::middle(JointRole role) const {
    const std::vector<int> joints = all(role);
    if (joints.empty()) return std::nullopt;
    Vector3<double> sum = Vector3<double>::Zero();
    for (const int j : joints) sum += at(j);
    return Vector3<double>(sum / static_cast<double>(joints.size()));
}

double Placement::rest_height(JointRole role) const {
    const std::vector<int> joints = all(role);
    double sum = 0;
    for (const int j : joints) sum += joint(j).position.z();
    return joints.empty() ? 0 : sum / static_cast<double>(joints.size());
}

double arc_of(const Limb& limb, std::size_t i) { return limb.line.arc[limb.line.arc.size() - 1] - limb.from_tip[i]; }

Vector3<double> on(const Limb& limb, double arc) { return point_at(limb.line.points, limb.line.arc, arc); }

} // namespace skelgen::detail
