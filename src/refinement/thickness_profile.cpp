#include <skelgen/refinement/thickness_profile.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "profile_matcher.hpp"

namespace skelgen {
namespace {

using detail::ProfileFit, detail::Profile, detail::Sample, detail::Stretch, detail::Top, detail::value_at;

/// Thickness of the limb where its sections are its own.
std::vector<Sample> samples_of(const Limb& limb) {
    std::vector<Sample> samples;
    const double end = limb.line.arc[limb.line.arc.size() - 1];
    for (Eigen::Index i = 0; i < limb.line.arc.size(); ++i)
        if (limb.line.arc[i] > limb.attachment && limb.line.thickness[i] > 0)
            samples.push_back({end - limb.line.arc[i], std::log(limb.line.thickness[i])});
    return samples;
}

/// Index in `limb` of its joint of that role; none when it has none.
std::optional<std::size_t> find(const Limb& limb, const SkeletonTemplate& skeleton_template, JointRole role) {
    for (std::size_t i = 0; i < limb.joints.size(); ++i)
        if (skeleton_template.joints[static_cast<std::size_t>(limb.joints[i])].role == role) return i;
    return std::nullopt;
}

/// A limb with the joints of an arm or of a leg: their indices in the limb, and where the template has them.
struct ProfiledLimb {
    Limb* limb;
    bool leg;
    std::size_t inner, middle, outer;
    Stretch rest;
    double bone_ratio = 1;
    ProfileFit fit = {};
};

std::optional<ProfiledLimb> profiled(Limb& limb, const SkeletonTemplate& skeleton_template) {
    using enum JointRole;
    const bool leg = find(limb, skeleton_template, knee).has_value();
    const auto inner = find(limb, skeleton_template, leg ? hip : shoulder);
    const auto middle = find(limb, skeleton_template, leg ? knee : elbow);
    const auto outer = find(limb, skeleton_template, leg ? ankle : wrist);
    if (!inner || !middle || !outer) return std::nullopt;
    return ProfiledLimb{&limb,   leg,    *inner,
                        *middle, *outer, {limb.from_tip[*outer], limb.from_tip[*middle], limb.from_tip[*inner]}};
}

/// Moves the limb's attachment outwards to where, seen from the trunk, its sections cease to be a third thicker than
/// the profile has them: nearer the trunk they are a coat's or a skirt's. A fold is thick, too, but not all the way to
/// the trunk.
void move_attachment(Limb& limb, const Profile& profile, const Stretch& stretch, double stoutness) {
    const double too_thick = std::log(1.35), knee_or_elbow = 1.2; // of u
    const double end = limb.line.arc[limb.line.arc.size() - 1];
    int more_too_thick = 0, most = 2; // sections, counted from the trunk
    double attachment = limb.attachment;
    for (Eigen::Index i = 0; i + 1 < limb.line.arc.size(); ++i) {
        if (limb.line.arc[i] <= limb.attachment || !(limb.line.thickness[i] > 0)) continue;
        const double u = stretch.u(end - limb.line.arc[i]);
        if (u < knee_or_elbow) break;
        const double expected = value_at(profile, u).value_or(profile.back());
        more_too_thick += std::log(limb.line.thickness[i]) > expected + stoutness + too_thick ? 1 : -1;
        if (more_too_thick <= most) continue;
        most = more_too_thick;
        attachment = limb.line.arc[i + 1];
    }
    limb.attachment = attachment;
}

std::optional<Top> top_of(const ProfiledLimb& p) {
    if (!p.limb->top_by_trunk) return std::nullopt;
    return Top{*p.limb->top_by_trunk, p.limb->top_deviation / (p.rest.inner - p.rest.middle)};
}

/// Puts the joints of both arms or both legs, from elbow or knee outwards, where they fit best.
void move_outer_joints(std::vector<ProfiledLimb>& limbs, bool leg, const ThicknessProfileOptions& options) {
    const Profile& profile = leg ? detail::leg_profile : detail::arm_profile;
    std::vector<ProfiledLimb*> pair;
    std::vector<detail::MatchedLimb> matched;
    for (ProfiledLimb& p : limbs)
        if (p.leg == leg) {
            pair.push_back(&p);
            matched.push_back({samples_of(*p.limb), p.rest, top_of(p)});
        }
    if (pair.empty()) return;
    const std::vector<Stretch> found = detail::best_stretches(matched, profile, options);
    for (std::size_t k = 0; k < pair.size(); ++k) {
        ProfiledLimb& p = *pair[k];
        p.fit = detail::fit(matched[k].samples, profile, found[k], options.thickness_deviation);
        move_attachment(*p.limb, profile, found[k], p.fit.stoutness);
        std::vector<double>& from_tip = p.limb->from_tip;
        for (std::size_t i = p.outer; i < from_tip.size(); ++i) from_tip[i] *= found[k].outer / p.rest.outer;
        from_tip[p.middle] = found[k].middle;
        p.bone_ratio = (found[k].middle - found[k].outer) / (p.rest.middle - p.rest.outer);
    }
}

/// Geometric mean of the ratios that `use` selects; 1 for none.
template <typename Use>
double mean_ratio(const std::vector<ProfiledLimb>& limbs, Use&& use) {
    double sum = 0, count = 0;
    for (const ProfiledLimb& p : limbs)
        if (use(p)) {
            sum += std::log(p.bone_ratio);
            count += 1;
        }
    return count > 0 ? std::exp(sum / count) : 1;
}

/// How much longer than the template's an upper bone is where the lower one is `lower` times as long: half as much in
/// people's usual variety (on a logarithmic scale), as much where a limb is plainly of another length.
double upper_ratio(double lower) {
    constexpr double usual = 0.1;
    const double x = std::log(lower), shared = (x * x + 0.5 * usual * usual) / (x * x + usual * usual);
    return std::exp(shared * x);
}

/// Length of the upper bones of arms or legs: as the lower ones' length makes them likely, and as the trunk tells it,
/// of both sides together, as they are equally long.
double upper_bone(const std::vector<ProfiledLimb>& limbs, bool leg, double by_ratio,
                  const ThicknessProfileOptions& options) {
    double sum = 0, weights = 0, count = 0;
    for (const ProfiledLimb& p : limbs) {
        const std::optional<Top> top = top_of(p);
        if (p.leg != leg || !top) continue;
        const double middle = p.limb->from_tip[p.middle];
        const double deviation = detail::deviation_of(*top, p.fit.stoutness, {p.limb->from_tip[p.outer], middle, 0});
        const double weight = 1 / (deviation * deviation);
        sum += weight * std::log(std::max(top->from_tip - middle, 0.1 * by_ratio) / by_ratio);
        weights += weight;
        count += 1;
    }
    if (!(count > 0)) return by_ratio;
    const double difference = sum / weights, trunk_variance = count / weights;
    const double ratio_variance = options.proportion_deviation * options.proportion_deviation;
    const double doubt = 1 + difference * difference / (detail::far_off * (ratio_variance + trunk_variance));
    return by_ratio * std::exp(difference * ratio_variance / (ratio_variance + doubt * doubt * trunk_variance));
}

} // namespace

double match_thickness_profiles(std::vector<Limb>& limbs, const SkeletonTemplate& skeleton_template,
                                const ThicknessProfileOptions& options) {
    std::vector<ProfiledLimb> all;
    for (Limb& limb : limbs)
        if (const auto p = profiled(limb, skeleton_template)) all.push_back(*p);
    for (const bool leg : {false, true}) move_outer_joints(all, leg, options);
    for (const ProfiledLimb& p : all) {
        const double ratio = mean_ratio(all, [&](const ProfiledLimb& q) { return q.leg == p.leg; });
        const double by_ratio = upper_ratio(ratio) * (p.rest.inner - p.rest.middle);
        p.limb->from_tip[p.inner] = p.limb->from_tip[p.middle] + upper_bone(all, p.leg, by_ratio, options);
    }
    return mean_ratio(all, [](const ProfiledLimb&) { return true; });
}

} // namespace skelgen
