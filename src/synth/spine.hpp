#pragma once

#include <vector>

#include "kinematics.hpp"
#include "primitives.hpp"

namespace skelgen::synth {

/// The bending of the trunk and neck: a smooth curve through crotch, waist, chest, neck and head that carries a turning
/// cross-section plane. It takes points of the posed trunk back to the rest pose, where the trunk is modelled.
class SpineBend {
public:
    explicit SpineBend(const PosedSkeleton& skeleton);

    /// Where a point around the posed spine lies in the rest pose.
    [[nodiscard]] Vec3 to_rest(const Vec3& world) const;

    /// The inverse for points at the heights of the spine.
    [[nodiscard]] Vec3 to_world(const Vec3& rest) const;

private:
    struct Station {
        Vec3 centre;      ///< posed
        Vec3 rest_centre; ///< at rest
        Eigen::Quaterniond turn;
        Vec3 normal; ///< of the posed plane
    };
    [[nodiscard]] Station between(const Station& a, const Station& b, double u) const;

    std::vector<Station> stations_; ///< from the crotch up
};

} // namespace skelgen::synth
