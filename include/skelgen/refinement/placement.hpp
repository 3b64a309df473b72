#pragma once

#include <optional>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::refinement {

/// The joints of one body while they are being placed: a value that the steps take and return. Refers to the template,
/// which must outlive it.
template <typename Scalar = double>
class Placement {
public:
    /// All joints at the origin. `scale`: rest-pose length to body length.
    Placement(const SkeletonTemplate& skeleton_template, Scalar scale)
        : template_(&skeleton_template), scale_(scale),
          positions_(Points<Scalar>::Zero(static_cast<Eigen::Index>(skeleton_template.joints.size()), 3)) {}
    Placement(const SkeletonTemplate&&, Scalar) = delete;

    [[nodiscard]] const SkeletonTemplate& skeleton_template() const { return *template_; }
    [[nodiscard]] Scalar scale() const { return scale_; }
    [[nodiscard]] const Points<Scalar>& positions() const { return positions_; } ///< per template joint

    [[nodiscard]] JointRole role(int j) const { return template_->joint(j).role; }
    [[nodiscard]] Vector3<Scalar> at(int j) const { return positions_.row(j); }
    void put(int j, const Vector3<Scalar>& p) { positions_.row(j) = p.transpose(); }

    /// First joint of the trunk of that role; -1 when there is none.
    [[nodiscard]] int find(JointRole role) const { return find_joint(*template_, role); }
    /// All joints of that role, of either side, in template order.
    [[nodiscard]] std::vector<int> all(JointRole role) const;

    /// Mean position of the joints of a role; none when there are none.
    [[nodiscard]] std::optional<Vector3<Scalar>> middle(JointRole role) const;
    /// Mean height of the joints of a role in the rest pose, in the template's unit; 0 when there are none.
    [[nodiscard]] double rest_height(JointRole role) const;
    /// Distance of two joints in the rest pose, in the body's unit.
    [[nodiscard]] Scalar rest_distance(int a, int b) const {
        return scale_ * static_cast<Scalar>(rest_length(*template_, a, b));
    }

private:
    const SkeletonTemplate* template_;
    Scalar scale_;
    Points<Scalar> positions_;
};

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/placement.hpp>
#endif
