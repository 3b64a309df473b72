#include "spine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace skelgen::synth {
namespace {

using Eigen::Quaterniond;

constexpr std::array<BodyJoint, 5> column{BodyJoint::crotch, BodyJoint::waist, BodyJoint::chest, BodyJoint::neck,
                                          BodyJoint::head};
constexpr int stations_per_bone = 12;

Vec3 hermite(const Vec3& a, const Vec3& slope_a, const Vec3& b, const Vec3& slope_b, double u) {
    const double u2 = u * u, u3 = u2 * u;
    return a * (2 * u3 - 3 * u2 + 1) + slope_a * (u3 - 2 * u2 + u) + b * (3 * u2 - 2 * u3) + slope_b * (u3 - u2);
}

/// The rest curve's direction at joint i, per metre of height.
Vec3 rest_slope(const PosedSkeleton& skeleton, std::size_t i) {
    const std::size_t below = i == 0 ? 0 : i - 1, above = std::min(i + 1, column.size() - 1);
    const Vec3 step = skeleton.rest_position(column[above]) - skeleton.rest_position(column[below]);
    return step / step.z();
}

/// Joint i is turned half with the bone below it and half with the one above.
Quaterniond joint_turn(const PosedSkeleton& skeleton, std::size_t i) {
    const Quaterniond above(skeleton.frame(column[i]).linear());
    if (i == 0) return above;
    return Quaterniond(skeleton.frame(column[i - 1]).linear()).slerp(0.5, above);
}

/// Along bone i, u from 0 to 1: from the lower joint's turn over the bone's own to the upper joint's.
Quaterniond bone_turn(const PosedSkeleton& skeleton, std::size_t i, double u) {
    const Quaterniond own(skeleton.frame(column[i]).linear());
    return u < 0.5 ? joint_turn(skeleton, i).slerp(2 * u, own) : own.slerp(2 * u - 1, joint_turn(skeleton, i + 1));
}

} // namespace

SpineBend::SpineBend(const PosedSkeleton& skeleton) {
    for (std::size_t i = 0; i + 1 < column.size(); ++i) {
        const Vec3 &low = skeleton.rest_position(column[i]), &high = skeleton.rest_position(column[i + 1]);
        const double rise = high.z() - low.z();
        const Vec3 slope_low = rise * rest_slope(skeleton, i), slope_high = rise * rest_slope(skeleton, i + 1);
        const Vec3 posed_low = joint_turn(skeleton, i) * slope_low,
                   posed_high = joint_turn(skeleton, i + 1) * slope_high;
        const bool last = i + 2 == column.size();
        for (int k = 0; k < stations_per_bone + (last ? 1 : 0); ++k) {
            const double u = static_cast<double>(k) / stations_per_bone;
            Quaterniond turn = bone_turn(skeleton, i, u);
            if (!stations_.empty() && turn.dot(stations_.back().turn) < 0) turn.coeffs() *= -1; // same turn, same sheet
            stations_.push_back(
                {hermite(skeleton.position(column[i]), posed_low, skeleton.position(column[i + 1]), posed_high, u),
                 hermite(low, slope_low, high, slope_high, u), turn, turn * Vec3::UnitZ()});
        }
    }
}

SpineBend::Station SpineBend::between(const Station& a, const Station& b, double u) const {
    Station s;
    s.centre = a.centre + u * (b.centre - a.centre);
    s.rest_centre = a.rest_centre + u * (b.rest_centre - a.rest_centre);
    s.turn = Quaterniond(a.turn.coeffs() + u * (b.turn.coeffs() - a.turn.coeffs())).normalized();
    return s;
}

Vec3 SpineBend::to_rest(const Vec3& world) const {
    const auto into_rest = [&world](const Station& s) -> Vec3 {
        return s.rest_centre + s.turn.conjugate() * (world - s.centre);
    };
    // The plane through the point: where its signed height over the planes changes sign, the crossing nearest the
    // curve (planes cross each other on the inner side of a bend, far from it). Bone by bone, then halving.
    const auto height = [&](std::size_t i) { return (world - stations_[i].centre).dot(stations_[i].normal); };
    double nearest = std::numeric_limits<double>::infinity();
    Station found = stations_.front();
    constexpr std::size_t stride = 6;
    double below = height(0);
    if (below < 0) nearest = (world - stations_.front().centre).squaredNorm();
    for (std::size_t i = stride; i < stations_.size(); i += stride) {
        const double above = height(i);
        if (below >= 0 && above < 0) {
            std::size_t low = i - stride, high = i;
            double at_low = below, at_high = above;
            while (high - low > 1) {
                const std::size_t middle = (low + high) / 2;
                const double at_middle = height(middle);
                if (at_middle >= 0)
                    low = middle, at_low = at_middle;
                else
                    high = middle, at_high = at_middle;
            }
            const Station crossing = between(stations_[low], stations_[high], at_low / (at_low - at_high));
            const double distance = (world - crossing.centre).squaredNorm();
            if (distance < nearest) nearest = distance, found = crossing;
        }
        below = above;
    }
    if (below >= 0 && (world - stations_.back().centre).squaredNorm() < nearest) found = stations_.back();
    return into_rest(found);
}

Vec3 SpineBend::to_world(const Vec3& rest) const {
    std::size_t i = 1;
    while (i + 1 < stations_.size() && stations_[i].rest_centre.z() < rest.z()) ++i;
    const Station &a = stations_[i - 1], &b = stations_[i];
    const double u = std::clamp((rest.z() - a.rest_centre.z()) / (b.rest_centre.z() - a.rest_centre.z()), 0.0, 1.0);
    const Station s = between(a, b, u);
    return s.centre + s.turn * (rest - s.rest_centre);
}

} // namespace skelgen::synth
