#pragma once

#include <optional>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/refine.hpp>

namespace skelgen::symmetry::detail {

template <typename Scalar>
bool is_present(const refinement::RefinedJoints<Scalar>& joints, int j) {
    return joints.is_present.empty() || joints.is_present[static_cast<std::size_t>(j)];
}

/// Refined joints, looked up by role and side. What is cut off is not found.
template <typename Scalar>
class JointsByRole {
public:
    JointsByRole(const refinement::RefinedJoints<Scalar>& joints, const SkeletonTemplate& skeleton_template)
        : joints_(joints), template_(skeleton_template) {}

    [[nodiscard]] std::optional<Vector3<Scalar>> find(JointRole role, Side side = Side::none) const {
        const int j = find_joint(template_, role, side);
        if (j < 0 || !is_present(joints_, j)) return std::nullopt;
        return core::point(joints_.positions, j);
    }

    /// Of a joint that every template has and no body lacks.
    [[nodiscard]] Vector3<Scalar> get(JointRole role, Side side = Side::none) const { return find(role, side).value(); }

    /// The end of the limb of which this is the last joint.
    [[nodiscard]] std::optional<Vector3<Scalar>> tip(JointRole role, Side side) const {
        const int j = find_joint(template_, role, side);
        for (const auto& [end, point] : joints_.tips)
            if (end == j) return point;
        return std::nullopt;
    }

private:
    const refinement::RefinedJoints<Scalar>& joints_;
    const SkeletonTemplate& template_;
};

} // namespace skelgen::symmetry::detail
