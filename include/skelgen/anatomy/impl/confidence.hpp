#pragma once

#include <skelgen/anatomy/confidence.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace skelgen::anatomy {
namespace detail {

/// 1 where there are none.
inline double median_of_positive(std::vector<double> values) {
    std::erase_if(values, [](double v) { return !(v > 0); });
    if (values.empty()) return 1;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Per joint, how unlikely the bone from its parent is: the sum of the squared deviations from the template and from
/// the other side, each relative to where it halves the confidence. 0 for the root and for what is missing. Confidences
/// are double whatever the scalar: no more than the bones' lengths goes into them.
template <typename Scalar>
std::vector<double> bone_doubts(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                                const std::vector<Scalar>& measured) {
    // Logarithms of ratios; calibrated so that confidences say what the header promises of them.
    constexpr double half_by_other_side = 0.15, half_by_template = 0.3;
    const auto at = [](int j) { return static_cast<std::size_t>(j); };
    const auto joints = static_cast<int>(skeleton.joints.size());
    std::vector<double> lengths(at(joints), 0), rest(at(joints), 0), ratios(at(joints), 0);
    for (int j = 0; j < joints; ++j) {
        const int parent = skeleton.joints[at(j)].parent;
        if (parent < 0 || !skeleton.joints[at(j)].is_present) continue;
        lengths[at(j)] =
            static_cast<double>((skeleton.joints[at(j)].position - skeleton.joints[at(parent)].position).norm());
        rest[at(j)] = rest_length(skeleton_template, j, parent);
        if (rest[at(j)] > 0) ratios[at(j)] = lengths[at(j)] / rest[at(j)];
    }
    const double scale = median_of_positive(ratios);
    const double slack = 0.1 * scale * median_of_positive(rest); // a short bone's length says little
    const auto compare = [&](double a, double b) { return std::log((a + slack) / (b + slack)); };
    std::vector<double> doubt(at(joints), 0);
    for (int j = 0; j < joints; ++j) {
        if (skeleton.joints[at(j)].parent < 0 || !skeleton.joints[at(j)].is_present) continue;
        const double by_template = compare(lengths[at(j)], scale * rest[at(j)]) / half_by_template;
        doubt[at(j)] = by_template * by_template;
        const int other = counterpart(skeleton_template, j);
        if (other >= 0 && skeleton.joints[at(other)].is_present) {
            const double by_side =
                compare(static_cast<double>(measured[at(j)]), static_cast<double>(measured[at(other)])) /
                half_by_other_side;
            doubt[at(j)] += by_side * by_side;
        }
    }
    return doubt;
}

} // namespace detail

template <typename Scalar>
std::vector<double> joint_doubts(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                                 const std::vector<Scalar>& measured) {
    const std::vector<double> bones = detail::bone_doubts(skeleton, skeleton_template, measured);
    std::vector<double> doubt = bones;
    for (std::size_t j = 0; j < bones.size(); ++j) {
        const int parent = skeleton.joints[j].parent;
        if (parent < 0 || skeleton_template.joint(parent).side != skeleton_template.joints[j].side) continue;
        double& of_parent = doubt[static_cast<std::size_t>(parent)];
        of_parent = std::max(of_parent, bones[j]);
    }
    return doubt;
}

} // namespace skelgen::anatomy
