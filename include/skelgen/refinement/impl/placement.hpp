#pragma once

#include <skelgen/refinement/placement.hpp>

#include <cstddef>

namespace skelgen::refinement {

template <typename Scalar>
std::vector<int> Placement<Scalar>::all(JointRole role) const {
    std::vector<int> joints;
    for (std::size_t j = 0; j < template_->joints.size(); ++j)
        if (template_->joints[j].role == role) joints.push_back(static_cast<int>(j));
    return joints;
}

template <typename Scalar>
std::optional<Vector3<Scalar>> Placement<Scalar>::middle(JointRole role) const {
    const std::vector<int> joints = all(role);
    if (joints.empty()) return std::nullopt;
    Vector3<Scalar> sum = Vector3<Scalar>::Zero();
    for (const int j : joints) sum += at(j);
    return Vector3<Scalar>(sum / static_cast<Scalar>(joints.size()));
}

template <typename Scalar>
double Placement<Scalar>::rest_height(JointRole role) const {
    const std::vector<int> joints = all(role);
    double sum = 0;
    for (const int j : joints) sum += template_->joint(j).position.y();
    return joints.empty() ? 0 : sum / static_cast<double>(joints.size());
}

} // namespace skelgen::refinement
