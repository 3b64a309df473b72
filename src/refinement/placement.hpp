#pragma once

#include <optional>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/limbs.hpp>

namespace skelgen::detail {

/// The joints of one body while they are being placed, and what placing them needs to know.
class Placement {
public:
    /// `scale`: rest-pose length to body length.
    Placement(const SkeletonTemplate& skeleton_template, std::vector<Limb> limbs, double scale);

    [[nodiscard]] const std::vector<Limb>& limbs() const { return limbs_; }
    [[nodiscard]] const Points<double>& positions() const { return positions_; }
    [[nodiscard]] double scale() const { return scale_; }

    [[nodiscard]] std::size_t size() const { return template_.joints.size(); }
    [[nodiscard]] const TemplateJoint& joint(int j) const { return template_.joints[static_cast<std::size_t>(j)]; }
    [[nodiscard]] Vector3<double> at(int j) const { return positions_.row(j); }
    void put(int j, const Vector3<double>& p) { positions_.row(j) = p.transpose(); }

    /// First joint of that role; -1 when there is none.
    [[nodiscard]] int find(JointRole role) const;
    [[nodiscard]] std::vector<int> all(JointRole role) const;
    /// Index in the limb of its joint of that role.
    [[nodiscard]] std::optional<std::size_t> find(const Limb& limb, JointRole role) const;

    /// Mean position of the joints of a role; none when there are none.
    [[nodiscard]] std::optional<Vector3<double>> middle(JointRole role) const;
    /// Mean height of the joints of a role in the rest pose, in the template's unit.
    [[nodiscard]] double rest_height(JointRole role) const;
    [[nodiscard]] double rest_distance(int a, int b) const {
        return scale_ * (joint(a).position - joint(b).position).norm();
    }

private:
    const SkeletonTemplate& template_;
    std::vector<Limb> limbs_;
    double scale_;
    Points<double> positions_;
};

/// Arc length on the limb's centreline at its joint number `i`.
[[nodiscard]] double arc_of(const Limb& limb, std::size_t i);
/// The centreline's point there.
[[nodiscard]] Vector3<double> on(const Limb& limb, double arc);

} // namespace skelgen::detail
