#include "hip_anchor.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <skelgen/refinement/fork.hpp>

#include "bone_line.hpp"
#include "placement.hpp"

namespace skelgen::detail {
namespace {

/// Height of the hips above the fork of the legs, as a part of the rest-pose thigh. Calibrated: mean over 50 registered
/// bodies, its standard deviation between and within people a seventh of it.
constexpr double hips_above_fork = 0.16;

/// Standard deviations, as parts of the thigh: of a thigh that prolongs the trunk, and how much more for one at right
/// angles to it, whose skin takes the fork along. Calibrated on the same bodies.
constexpr double least_deviation = 0.03, flexed_deviation = 0.15;

/// Ends that make legs more unlike the template's or each other than this (logarithms of length) are those of clothes.
constexpr double unlike_template = 0.22, unlike_other = 0.15;

/// Finds where the limb's first bone, as a straight line, comes nearest to `place`.
void set_top(Limb& limb, const Vector3<double>& place, const Vector3<double>& up, double flatness) {
    const double inner = arc_of(limb, 0), outer = arc_of(limb, 1);
    const auto line = fit_bone(limb.line, std::max(limb.attachment, inner + 0.15 * (outer - inner)),
                               outer - 0.15 * (outer - inner), flatness);
    if (!line) return;
    Eigen::Index nearest = 0;
    (limb.line.points.rowwise() - line->point.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    const double outwards = (place - limb.line.points.row(nearest).transpose()).dot(line->direction);
    const double from_tip = limb.line.arc[limb.line.arc.size() - 1] - limb.line.arc[nearest] - outwards;
    if (!(from_tip > 0) || std::abs(std::log(from_tip / limb.from_tip.front())) > unlike_template) return;
    limb.top_by_trunk = from_tip;
    limb.top_deviation = (least_deviation + flexed_deviation * (1 + line->direction.dot(up))) * (outer - inner);
}

} // namespace

void anchor_hips(std::vector<Limb>& limbs, const TriangleMesh<double>& mesh, const std::vector<EndPoint>& ends,
                 const SkeletonTemplate& skeleton_template, double scale, double flatness) {
    std::vector<std::size_t> legs;
    std::optional<Vector3<double>> neck;
    double thigh = 0;
    for (std::size_t i = 0; i < limbs.size(); ++i) {
        const auto joint = [&](std::size_t k) -> const TemplateJoint& {
            return skeleton_template.joints[static_cast<std::size_t>(limbs[i].joints[k])];
        };
        const JointRole end = joint(limbs[i].joints.size() - 1).role;
        if (end == JointRole::head) neck = on(limbs[i], arc_of(limbs[i], 0));
        if (end != JointRole::foot || joint(0).role != JointRole::hip || limbs[i].joints.size() < 2) continue;
        legs.push_back(i);
        thigh = scale * (joint(0).position - joint(1).position).norm();
    }
    if (legs.size() != 2 || !neck) return;
    const auto fork = fork_between(mesh, ends[legs[0]], ends[legs[1]]);
    if (!fork) return;
    const Vector3<double> up = (*neck - *fork).normalized();
    for (const std::size_t leg : legs) set_top(limbs[leg], *fork + hips_above_fork * thigh * up, up, flatness);
    std::optional<double>&one = limbs[legs[0]].top_by_trunk, &other = limbs[legs[1]].top_by_trunk;
    if (one && other && std::abs(std::log(*one / *other)) > unlike_other) one = other = std::nullopt;
}

} // namespace skelgen::detail
