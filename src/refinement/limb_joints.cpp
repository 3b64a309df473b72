#include "limb_joints.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "bone_line.hpp"

namespace skelgen::detail {
namespace {

using enum JointRole;

constexpr double degrees_per_radian = 57.29577951308232;

double smooth_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

} // namespace

void place_by_ratio(Placement& placement, const Limb& limb) {
    for (std::size_t i = 0; i < limb.joints.size(); ++i) placement.put(limb.joints[i], on(limb, arc_of(limb, i)));
}

void place_neck(Placement& placement, const Limb& limb, const HeadShape& head, const RefinementOptions& options) {
    if (placement.joint(limb.joints.front()).role != neck || !head.throat) return;
    const Vector3<double> place = placement.at(limb.joints.front());
    const double height = (limb.line.points.bottomRows<1>().transpose() - place).norm();
    const double higher = (*head.throat - place).dot(head.up) - options.neck_below_throat * height;
    placement.put(limb.joints.front(), place + options.throat_weight * higher * head.up);
}

void place_wrist(Placement& placement, const Limb& limb, const RefinementOptions& options) {
    const auto found = placement.find(limb, wrist);
    if (!found || *found == 0) return;
    const double window = options.wrist_window * (limb.from_tip[*found - 1] - limb.from_tip[*found]);
    const double centre = arc_of(limb, *found);
    Eigen::Index thinnest = -1;
    for (Eigen::Index i = 0; i < limb.line.arc.size(); ++i) {
        if (std::abs(limb.line.arc[i] - centre) > window || limb.line.area[i] <= 0) continue;
        if (thinnest < 0 || limb.line.thickness[i] < limb.line.thickness[thinnest]) thinnest = i;
    }
    if (thinnest >= 0) placement.put(limb.joints[*found], limb.line.points.row(thinnest).transpose());
}

void place_bend(Placement& placement, const Limb& limb, const RefinementOptions& options) {
    for (std::size_t i = 1; i + 1 < limb.joints.size(); ++i) {
        const JointRole role = placement.joint(limb.joints[i]).role;
        if (role != elbow && role != knee) continue;
        const double here = arc_of(limb, i), inner = arc_of(limb, i - 1), outer = arc_of(limb, i + 1);
        const double inner_start = std::max(limb.attachment, inner + 0.15 * (here - inner));
        auto upper = fit_bone(limb.line, inner_start, here - 0.2 * (here - inner), options.flatness);
        if (!upper) upper = fit_bone(limb.line, inner_start, here, options.flatness); // little of it is on its own
        const auto lower =
            fit_bone(limb.line, here + 0.2 * (outer - here), outer - 0.1 * (outer - here), options.flatness);
        if (!upper || !lower) continue;
        const double angle =
            std::acos(std::clamp(upper->direction.dot(lower->direction), -1.0, 1.0)) * degrees_per_radian;
        const auto meeting = meeting_point(*upper, *lower);
        const Vector3<double> ratio = placement.at(limb.joints[i]);
        if (!meeting || (*meeting - ratio).norm() > 0.3 * (outer - inner)) continue;
        const double weight = options.bend_weight * smooth_step(options.bend_from, options.bend_full, angle);
        placement.put(limb.joints[i], ratio + weight * (*meeting - ratio));
    }
}

void place_girdle(Placement& placement, const Limb& limb, const RefinementOptions& options) {
    if (limb.joints.size() < 2) return;
    const int top = limb.joints[0], next = limb.joints[1];
    const JointRole role = placement.joint(top).role;
    if (role != shoulder && role != hip) return;
    const double inner = arc_of(limb, 0), outer = arc_of(limb, 1);
    const auto line = fit_bone(limb.line, std::max(limb.attachment, inner + 0.15 * (outer - inner)),
                               outer - 0.15 * (outer - inner), options.flatness);
    const double length = limb.from_tip[0] - limb.from_tip[1];
    const Vector3<double> start = placement.at(next);
    const auto towards = [&](const Vector3<double>& p) -> Vector3<double> {
        return start + length * (p - start).normalized();
    };
    std::vector<Vector3<double>> ways;
    if (line) ways.push_back(start - length * line->direction);
    if (limb.attachment < outer - 0.3 * (outer - inner)) ways.push_back(towards(on(limb, limb.attachment)));
    ways.push_back(towards(on(limb, inner)));
    placement.put(top, ways.front());

    const int anchor = role == shoulder ? placement.find(neck) : -1;
    if (anchor < 0) return;
    const double rest = placement.rest_distance(top, anchor);
    const auto misfit = [&](const Vector3<double>& p) { return std::abs((p - placement.at(anchor)).norm() - rest); };
    if (misfit(ways.front()) > options.girdle_tolerance * rest)
        placement.put(top, *std::min_element(ways.begin(), ways.end(),
                                             [&](const auto& p, const auto& q) { return misfit(p) < misfit(q); }));
}

} // namespace skelgen::detail
