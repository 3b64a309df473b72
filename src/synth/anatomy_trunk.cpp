#include "anatomy.hpp"

#include <cmath>

namespace skelgen::synth {
namespace {

struct TrunkRow {
    double height; ///< of a man of 1.75 m
    Ring man;      ///< `at` unused
    Ring woman;
    Ring fat; ///< added per unit of Proportions::fat
};

/// Sections of the trunk from the perineum to the nape, without breasts, buttocks and shoulder blades.
constexpr std::array<TrunkRow, 14> trunk_rows{{
    {0.850, {0, .118, .066, .070}, {0, .126, .064, .074}, {0, .05, .04, .05}},
    {0.880, {0, .158, .090, .092}, {0, .170, .086, .096}, {0, .09, .06, .08}},
    {0.940, {0, .169, .101, .092}, {0, .180, .096, .095}, {0, .10, .10, .08}},
    {1.000, {0, .160, .103, .085}, {0, .167, .099, .084}, {0, .11, .14, .07}},
    {1.061, {0, .146, .101, .079}, {0, .133, .092, .073}, {0, .12, .16, .06}},
    {1.130, {0, .147, .102, .083}, {0, .127, .090, .075}, {0, .11, .15, .06}},
    {1.200, {0, .156, .108, .096}, {0, .135, .094, .088}, {0, .09, .11, .06}},
    {1.280, {0, .165, .112, .110}, {0, .146, .096, .100}, {0, .07, .08, .06}},
    {1.340, {0, .160, .104, .115}, {0, .142, .088, .105}, {0, .06, .06, .06}},
    {1.385, {0, .135, .083, .110}, {0, .119, .071, .099}, {0, .05, .04, .05}},
    {1.430, {0, .083, .058, .089}, {0, .072, .050, .079}, {0, .03, .03, .04}},
    {1.465, {0, .061, .056, .067}, {0, .052, .051, .058}, {0, .02, .03, .03}},
    {1.510, {0, .057, .074, .042}, {0, .048, .068, .035}, {0, .02, .03, .02}},
    {1.560, {0, .057, .096, .024}, {0, .048, .089, .018}, {0, .02, .03, .02}},
}};

/// From the heights of the table to those of this person.
class Heights {
public:
    Heights(const Proportions& p, const PosedSkeleton& s)
        : scale_(p.scale), knots_{{{0.872, s.rest_position(BodyJoint::left_hip).z()},
                                   {0.959, s.rest_position(BodyJoint::crotch).z()},
                                   {1.056, s.rest_position(BodyJoint::waist).z()},
                                   {1.260, s.rest_position(BodyJoint::chest).z()},
                                   {1.485, s.rest_position(BodyJoint::neck).z()},
                                   {1.585, s.rest_position(BodyJoint::head).z() + skull_origin(p).z()}}} {}

    [[nodiscard]] double operator()(double average) const {
        if (average <= knots_.front()[0]) return knots_.front()[1] + scale_ * (average - knots_.front()[0]);
        std::size_t i = 1;
        while (i + 1 < knots_.size() && knots_[i][0] < average) ++i;
        return std::lerp(knots_[i - 1][1], knots_[i][1],
                         (average - knots_[i - 1][0]) / (knots_[i][0] - knots_[i - 1][0]));
    }

private:
    double scale_;
    std::array<std::array<double, 2>, 6> knots_;
};

/// Width factor at a height: hips below the waist, shoulders above it, the neck with the head.
double width_factor(const Proportions& p, double height) {
    const double up = std::clamp((height - 1.0) / 0.25, 0.0, 1.0);
    const double neck = std::clamp((height - 1.40) / 0.08, 0.0, 1.0);
    const double neck_size = std::sqrt(p.head_scale / p.scale) * (1 - 0.22 * (1 - p.maturity)) * (1 + 0.08 * p.muscle);
    return std::lerp(std::lerp(p.hip_factor, p.shoulder_factor, up), neck_size, neck);
}

Tube trunk_outline(const Proportions& p, const Heights& heights) {
    std::vector<Ring> rings;
    for (const TrunkRow& row : trunk_rows) {
        const auto mix = [&](double Ring::*extent) {
            const double lean = std::lerp(row.woman.*extent, row.man.*extent, p.masculinity);
            return p.scale * (lean + p.fat * (row.fat.*extent) * (p.fat < 0 ? 0.8 : 1.0));
        };
        const double wide = width_factor(p, row.height);
        // The belly of children stands out; the neck's depth goes with its width.
        const double deep = 1 + (row.height > 1.42 ? wide - 1 : 0.06 * (1 - p.maturity));
        rings.push_back(
            {heights(row.height), wide * mix(&Ring::side), deep * mix(&Ring::front), deep * mix(&Ring::back)});
    }
    return Tube(std::move(rings), 2.5, 0.035 * p.scale, 0.03 * p.scale);
}

/// Turns by half of what the thigh turns, about the hip: buttocks are pulled along.
Vec3 half_with_thigh(const PosedSkeleton& s, BodyJoint hip, const Vec3& p) {
    const Eigen::Quaterniond turn(s.frame(BodyJoint::crotch).linear().transpose() * s.frame(hip).linear());
    const Vec3& centre = s.rest_position(hip);
    return centre + Eigen::Quaterniond::Identity().slerp(0.4, turn) * (p - centre);
}

/// The posed shoulder joint in the rest coordinates of the chest.
Vec3 shoulder_at_rest(const PosedSkeleton& s, BodyJoint shoulder) {
    return s.rest_position(BodyJoint::chest) + s.frame(BodyJoint::chest).inverse() * s.position(shoulder);
}

void add_buttock(std::vector<Blob>& blobs, const Proportions& p, const PosedSkeleton& s, const Heights& heights,
                 BodyJoint hip) {
    const double k = p.scale, woman = 1 - p.masculinity, side = side_of(hip);
    const Vec3 centre = half_with_thigh(
        s, hip, {side * 0.074 * k * p.hip_factor * (1 + 0.25 * p.fat), (0.054 + 0.055 * p.fat) * k, heights(0.897)});
    const double full = k * (1 + 0.06 * woman + 0.45 * p.fat + 0.05 * p.muscle);
    blobs.push_back({Ellipsoid{centre, full * Vec3(0.076, 0.066, 0.088)}, 0.026 * k});
}

void add_shoulder_girdle(std::vector<Blob>& blobs, const Proportions& p, const PosedSkeleton& s, const Heights& heights,
                         BodyJoint shoulder) {
    const double k = p.scale, side = side_of(shoulder), build = k * (0.9 + 0.1 * p.masculinity + 0.12 * p.fat);
    const double strong = 1 + 0.5 * (p.muscle - 0.3);
    const Vec3 rest = s.rest_position(shoulder), joint = shoulder_at_rest(s, shoulder), moved = joint - rest;
    const Vec3 acromion = joint + Vec3(-side * 0.008, 0.004, 0.026) * k;
    const auto at = [&](double x, double y, double z) {
        return Vec3(side * x * k * p.shoulder_factor, y * k, heights(z));
    };

    // Between rib cage and arm, below the collar bone.
    blobs.push_back(
        {RoundCone{at(0.085, 0.012, 1.345), joint + Vec3(-side * 0.014, 0, -0.004) * k, 0.068 * build, 0.050 * build},
         0.035 * k});
    // Trapezius, collar bone, shoulder blade.
    blobs.push_back({RoundCone{at(0.020, 0.026, 1.485), acromion, 0.034 * build * strong, 0.022 * build}, 0.035 * k});
    blobs.push_back(
        {RoundCone{at(0.018, -0.062, 1.402), acromion + Vec3(0, -0.014, 0.002) * k, 0.010 * k, 0.009 * k}, 0.014 * k});
    const Vec3 blade = at(0.082, 0.088 + 0.05 * p.fat, 1.325) + 0.6 * moved;
    const Mat3 tilt = Eigen::AngleAxisd(side * 0.25, Vec3::UnitY()).toRotationMatrix();
    blobs.push_back({Ellipsoid{blade, k * Vec3(0.052, 0.028, 0.078), tilt}, 0.032 * k});
}

void add_chest(std::vector<Blob>& blobs, const Proportions& p, const Heights& heights, double side) {
    const double k = p.scale, woman = (1 - p.masculinity) * p.maturity;
    const double strong = p.masculinity * (0.6 + p.muscle) * (0.4 + 0.6 * p.maturity);
    const auto at = [&](double x, double y, double z) {
        return Vec3(side * x * k * p.shoulder_factor, y * k, heights(z));
    };
    const double forward = 0.06 * p.fat;
    blobs.push_back(
        {Ellipsoid{at(0.072, -0.074 - forward - 0.008 * strong, 1.305), k * Vec3(0.084, 0.030 + 0.006 * strong, 0.056)},
         0.028 * k});
    const double breast = woman * (0.050 + 0.035 * p.fat) + (1 - woman) * 0.035 * std::max(0.0, p.fat);
    if (breast > 0.015)
        blobs.push_back({Ellipsoid{at(0.074, -0.070 - forward - 0.3 * breast, 1.262 - 0.2 * breast),
                                   k * Vec3(breast + 0.010, breast + 0.008, breast + 0.010)},
                         0.020 * k});
}

} // namespace

std::vector<Blob> trunk(const Proportions& p, const PosedSkeleton& s) {
    const Heights heights(p, s);
    const double k = p.scale;
    std::vector<Blob> blobs{{trunk_outline(p, heights), 0}};
    for (const double side : {1.0, -1.0}) add_chest(blobs, p, heights, side);
    for (const BodyJoint shoulder : {BodyJoint::left_shoulder, BodyJoint::right_shoulder})
        add_shoulder_girdle(blobs, p, s, heights, shoulder);
    for (const BodyJoint hip : {BodyJoint::left_hip, BodyJoint::right_hip}) add_buttock(blobs, p, s, heights, hip);
    // A belly below the navel, the furrow of the spine.
    blobs.push_back({Ellipsoid{{0, -(0.052 + 0.15 * p.fat) * k, heights(1.02)},
                               k * Vec3(0.085 + 0.06 * p.fat, 0.052 + 0.03 * p.fat, 0.095 + 0.02 * p.fat)},
                     0.04 * k});
    const double furrow = 1 / (1 + 3 * std::max(0.0, p.fat));
    blobs.push_back({RoundCone{{0, (0.100 + 0.06 * p.fat) * k, heights(1.04)},
                               {0, (0.136 + 0.06 * p.fat) * k, heights(1.32)},
                               0.012 * k * furrow,
                               0.014 * k * furrow},
                     0.03 * k, Use::carve});
    return blobs;
}

} // namespace skelgen::synth
