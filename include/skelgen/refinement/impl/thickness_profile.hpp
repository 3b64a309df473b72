#pragma once

#include <skelgen/refinement/thickness_profile.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include <skelgen/core/parallel.hpp>
#include <skelgen/refinement/impl/flat_end.hpp>
#include <skelgen/refinement/impl/heel.hpp>

namespace skelgen::refinement {
namespace detail {

/// Sections this many times thicker than the profile has them are a coat's or a skirt's. A working value, as are the
/// next three.
template <typename Scalar>
inline constexpr Scalar clothed_growth = Scalar(1.35);

/// They are looked for from the trunk to this u, just above elbow or knee.
template <typename Scalar>
inline constexpr Scalar above_middle_joint = Scalar(1.2);

/// There must be so many more of them than of others: one or two are noise.
inline constexpr int least_clothed_sections = 3;

/// Logarithm of the ratio of lower bones that people's usual variety reaches: within it the upper bones' ratio goes
/// with it by half, beyond it more and more.
template <typename Scalar>
inline constexpr Scalar usual_ratio = Scalar(0.1);

/// Thickness of the limb where its sections are its own; along its bones where the fold is given.
template <typename Scalar>
std::vector<Sample<Scalar>> thickness_samples(const Limb<Scalar>& limb, const Fold<Scalar>& fold = {}) {
    std::vector<Sample<Scalar>> samples;
    const Scalar end = limb.line.arc[limb.line.arc.size() - 1];
    for (Eigen::Index i = 0; i < limb.line.arc.size(); ++i) {
        if (!(limb.line.arc[i] > limb.attachment) || !(limb.line.thickness[i] > 0)) continue;
        const Scalar from_tip = end - limb.line.arc[i];
        samples.push_back({fold.along_bones(from_tip), std::log(limb.line.thickness[i]),
                           fold.holds(from_tip) ? 1 - fold.bent : Scalar(1)});
    }
    return samples;
}

/// A limb with the joints of an arm or of a leg: their indices in the limb, and where the template has them.
template <typename Scalar>
struct ProfiledLimb {
    Limb<Scalar>* limb;
    BodyPart part;
    std::size_t inner, middle, outer;
    Stretch<Scalar> rest;
    bool is_adapted;  ///< whose proportions are its own
    Scalar scale = 1; ///< `rest` is the template's, times that
    Scalar bone_ratio = 1;
    ProfileFit<Scalar> fit = {};
};

template <typename Scalar>
std::optional<ProfiledLimb<Scalar>> as_profiled(Limb<Scalar>& limb, const SkeletonTemplate& skeleton_template) {
    using enum JointRole;
    const bool leg = find_in_limb(limb, skeleton_template, knee).has_value();
    const auto inner = find_in_limb(limb, skeleton_template, leg ? hip : shoulder);
    const auto middle = find_in_limb(limb, skeleton_template, leg ? knee : elbow);
    const auto outer = find_in_limb(limb, skeleton_template, leg ? ankle : wrist);
    if (!inner || !middle || !outer) return std::nullopt;
    return ProfiledLimb<Scalar>{&limb,
                                leg ? BodyPart::leg : BodyPart::arm,
                                *inner,
                                *middle,
                                *outer,
                                {limb.from_tip[*outer], limb.from_tip[*middle], limb.from_tip[*inner]},
                                skeleton_template.is_adapted};
}

/// Arc length of the limb's attachment moved outwards to where, seen from the trunk, its sections cease to be a third
/// thicker than the profile has them: nearer the trunk they are a coat's or a skirt's. A fold is thick, too, but not
/// all the way to the trunk.
template <typename Scalar>
Scalar clothed_attachment(const Limb<Scalar>& limb, const Profile& profile, const Stretch<Scalar>& stretch,
                          Scalar stoutness) {
    const Scalar too_thick = std::log(clothed_growth<Scalar>);
    const Scalar end = limb.line.arc[limb.line.arc.size() - 1];
    int more_too_thick = 0, most = least_clothed_sections - 1; // sections, counted from the trunk
    Scalar attachment = limb.attachment;
    for (Eigen::Index i = 0; i + 1 < limb.line.arc.size(); ++i) {
        if (limb.line.arc[i] <= limb.attachment || !(limb.line.thickness[i] > 0)) continue;
        const Scalar u = stretch.u(end - limb.line.arc[i]);
        if (u < above_middle_joint<Scalar>) break;
        const Scalar expected = value_at(profile, u).value_or(static_cast<Scalar>(profile.back()));
        more_too_thick += std::log(limb.line.thickness[i]) > expected + stoutness + too_thick ? 1 : -1;
        if (more_too_thick <= most) continue;
        most = more_too_thick;
        attachment = limb.line.arc[i + 1];
    }
    return attachment;
}

template <typename Scalar>
std::optional<Top<Scalar>> top_of(const ProfiledLimb<Scalar>& p, const Fold<Scalar>& fold = {}) {
    if (!p.limb->top_by_trunk) return std::nullopt;
    return Top<Scalar>{fold.along_bones(*p.limb->top_by_trunk), p.limb->top_deviation / (p.rest.inner - p.rest.middle),
                       p.part};
}

/// The heel of a figure, whose foot may be of any size; a person's own lengths know the ankle as well.
template <typename Scalar>
std::optional<Heel<Scalar>> heel_of(const ProfiledLimb<Scalar>& p, const BendOptions& bend) {
    if (p.part != BodyPart::leg || !p.is_adapted || p.limb->missing > 0) return std::nullopt;
    return find_heel(*p.limb, p.rest, bend);
}

/// The stretches along the bones where the `found` ones, along centrelines, show a limb to be bent; those where none
/// is. A centreline cuts the corner, and the fold there has flesh of both bones: bent limbs would seem short.
template <typename Scalar>
std::vector<Stretch<Scalar>> stretches_along_bones(std::vector<MatchedLimb<Scalar>> matched,
                                                   const std::vector<ProfiledLimb<Scalar>*>& limbs,
                                                   const std::vector<Stretch<Scalar>>& found, const Profile& profile,
                                                   const ThicknessProfileOptions& options, const BendOptions& bend,
                                                   const BoneLineOptions& bone_line) {
    bool any_bent = false;
    for (std::size_t k = 0; k < limbs.size(); ++k) {
        const Fold<Scalar> fold = find_fold(*limbs[k]->limb, found[k], bend, bone_line);
        if (!(fold.bent > 0)) continue;
        any_bent = true;
        matched[k].samples = thickness_samples(*limbs[k]->limb, fold);
        matched[k].top = top_of(*limbs[k], fold);
    }
    return any_bent ? best_stretches(matched, profile, options) : found;
}

/// The limbs with the joints of both arms or both legs, from elbow or knee outwards, where they fit best: elbow and
/// knee along the centreline, where a fold shows them, what lies beyond along the bones.
template <typename Scalar>
std::vector<ProfiledLimb<Scalar>> with_outer_joints(std::vector<ProfiledLimb<Scalar>> limbs, BodyPart part,
                                                    const ThicknessProfileOptions& options, const BendOptions& bend,
                                                    const BoneLineOptions& bone_line) {
    const Profile& profile = part == BodyPart::leg ? leg_profile : arm_profile;
    std::vector<ProfiledLimb<Scalar>*> pair;
    std::vector<MatchedLimb<Scalar>> matched;
    for (ProfiledLimb<Scalar>& p : limbs)
        if (p.part == part) {
            pair.push_back(&p);
            matched.push_back({thickness_samples(*p.limb), p.rest, top_of(p), heel_of(p, bend), p.is_adapted});
        }
    if (pair.empty()) return limbs;
    const std::vector<Stretch<Scalar>> found = best_stretches(matched, profile, options);
    const std::vector<Stretch<Scalar>> along_bones =
        stretches_along_bones(matched, pair, found, profile, options, bend, bone_line);
    for (std::size_t k = 0; k < pair.size(); ++k) {
        ProfiledLimb<Scalar>& p = *pair[k];
        p.fit = fit_profile(matched[k].samples, profile, found[k], static_cast<Scalar>(options.thickness_deviation));
        p.limb->attachment = clothed_attachment(*p.limb, profile, found[k], p.fit.stoutness);
        std::vector<Scalar>& from_tip = p.limb->from_tip;
        for (std::size_t i = p.outer; i < from_tip.size(); ++i) from_tip[i] *= along_bones[k].outer / p.rest.outer;
        from_tip[p.middle] = found[k].middle;
        p.bone_ratio = (along_bones[k].middle - along_bones[k].outer) / (p.rest.middle - p.rest.outer);
    }
    return limbs;
}

/// Geometric mean of the ratios of the lower bones, to the template's, that `use` selects; 1 for none.
template <typename Scalar, typename Use>
Scalar mean_bone_ratio(const std::vector<ProfiledLimb<Scalar>>& limbs, Use&& use) {
    Scalar sum = 0, count = 0;
    for (const ProfiledLimb<Scalar>& p : limbs)
        if (use(p)) {
            sum += std::log(p.scale * p.bone_ratio);
            count += 1;
        }
    return count > 0 ? std::exp(sum / count) : 1;
}

/// A person's arms are looked for as the legs' length makes them likely, by half (on a logarithmic scale): the geodesic
/// diameter, by which all are scaled at first, differs by a fifth between poses of one body, most by how its arms are
/// held.
template <typename Scalar>
std::vector<ProfiledLimb<Scalar>> with_arms_by_legs(std::vector<ProfiledLimb<Scalar>> limbs) {
    const Scalar scale = std::sqrt(mean_bone_ratio(limbs, [](const auto& p) { return p.part == BodyPart::leg; }));
    for (ProfiledLimb<Scalar>& p : limbs) {
        if (p.part != BodyPart::arm) continue;
        for (Scalar& from_tip : p.limb->from_tip) from_tip *= scale;
        p.rest = {scale * p.rest.outer, scale * p.rest.middle, scale * p.rest.inner};
        p.scale = scale;
    }
    return limbs;
}

/// How much longer than the template's an upper bone is where the lower one is `lower` times as long: half as much in
/// people's usual variety (on a logarithmic scale), as much where a limb is plainly of another length.
template <typename Scalar>
Scalar upper_bone_ratio(Scalar lower) {
    constexpr Scalar usual = usual_ratio<Scalar>;
    const Scalar x = std::log(lower), shared = (x * x + Scalar(0.5) * usual * usual) / (x * x + usual * usual);
    return std::exp(shared * x);
}

/// Length of the upper bones of arms or legs: as the lower ones' length makes them likely, and as the trunk tells it,
/// of both sides together, as they are equally long.
template <typename Scalar>
Scalar upper_bone_length(const std::vector<ProfiledLimb<Scalar>>& limbs, BodyPart part, Scalar by_ratio,
                         const ThicknessProfileOptions& options) {
    Scalar sum = 0, weights = 0, count = 0;
    for (const ProfiledLimb<Scalar>& p : limbs) {
        const std::optional<Top<Scalar>> top = top_of(p);
        if (p.part != part || !top) continue;
        const Scalar middle = p.limb->from_tip[p.middle];
        const Scalar deviation =
            deviation_of(*top, p.fit.stoutness, Stretch<Scalar>{p.limb->from_tip[p.outer], middle, 0});
        const Scalar weight = 1 / (deviation * deviation);
        sum += weight * std::log(std::max(top->from_tip - middle, shortest_upper_bone<Scalar> * by_ratio) / by_ratio);
        weights += weight;
        count += 1;
    }
    if (!(count > 0)) return by_ratio;
    const Scalar difference = sum / weights, trunk_variance = count / weights;
    const auto proportion_deviation = static_cast<Scalar>(options.proportion_deviation);
    const Scalar ratio_variance = proportion_deviation * proportion_deviation;
    const Scalar doubt =
        1 + difference * difference / (static_cast<Scalar>(far_off) * (ratio_variance + trunk_variance));
    return by_ratio * std::exp(difference * ratio_variance / (ratio_variance + doubt * doubt * trunk_variance));
}

} // namespace detail

template <typename Scalar>
ThicknessMatch<Scalar> match_thickness_profiles(std::vector<Limb<Scalar>> limbs,
                                                const SkeletonTemplate& skeleton_template,
                                                const ThicknessProfileOptions& options, const BendOptions& bend,
                                                const BoneLineOptions& bone_line) {
    std::vector<detail::ProfiledLimb<Scalar>> all;
    for (Limb<Scalar>& limb : limbs)
        if (const auto p = detail::as_profiled(limb, skeleton_template)) all.push_back(*p);
    all = detail::with_outer_joints(std::move(all), BodyPart::leg, options, bend, bone_line);
    if (!skeleton_template.is_adapted) all = detail::with_arms_by_legs(std::move(all));
    all = detail::with_outer_joints(std::move(all), BodyPart::arm, options, bend, bone_line);
    for (const detail::ProfiledLimb<Scalar>& p : all) {
        const Scalar ratio = detail::mean_bone_ratio(all, [&](const auto& q) { return q.part == p.part; });
        const Scalar by_ratio = detail::upper_bone_ratio(ratio / p.scale) * (p.rest.inner - p.rest.middle);
        p.limb->from_tip[p.inner] =
            p.limb->from_tip[p.middle] + detail::upper_bone_length(all, p.part, by_ratio, options);
    }
    const Scalar ratio = detail::mean_bone_ratio(all, [](const auto&) { return true; });
    return {std::move(limbs), ratio};
}

namespace detail {

/// Of a hand or foot that is cut off, this part is taken to be there still: bodies are cut beside the joint, not in it.
template <typename Scalar>
inline constexpr Scalar left_of_end = Scalar(0.15);

/// What is less like a forearm or calf than this (squared deviations), or not twice as like one as it is like a whole
/// limb, is no limb that was cut off, but one in clothes, or none of a person, unless its end tells. Calibrated on
/// registered and generated bodies: cut arms cost 8 at most, and whole ones then 12 and more; boots 14 and more.
template <typename Scalar>
inline constexpr Scalar worst_cut_cost = Scalar(10);
template <typename Scalar>
inline constexpr Scalar least_gain = Scalar(2);

/// The end of a limb that was cut off and closed is flat (flat_end), and its thickness may then be this unlike a
/// forearm's or calf's, which a cut beside the joint changes. Calibrated on registered bodies, 96 whole and 24 cut, as
/// the next two are: a plane lid is about 1 flat, whole hands and feet as a rule far less, boots up to 0.45.
template <typename Scalar>
inline constexpr Scalar flat_lid = Scalar(0.6);
template <typename Scalar>
inline constexpr Scalar worst_lidded_cost = Scalar(20);

/// An end that was open shows at least so much of the section of a limb that was cut off (open_end).
template <typename Scalar>
inline constexpr Scalar open_lid = Scalar(0.45);

/// With so flat an end the thickness decides alone, by what costs less; each half as much again outvotes costs that
/// differ by a factor of e: in the midst between fists and feet that are whole and calves that were cut.
template <typename Scalar>
inline constexpr Scalar balanced = Scalar(0.6);

/// The limbs of block figures are more four-sided than this: in the midst between boxes and flat wrists.
template <typename Scalar>
inline constexpr Scalar box = Scalar(0.6);

/// What a limb's end looks like: see flat_end and open_end.
template <typename Scalar>
struct EndShape {
    Scalar flat, open;
};

/// Does a limb end at wrist or ankle? By what its thickness costs as a whole limb's and as a cut one's, and by what its
/// end looks like: of these two witnesses each may outvote the other. Of an end that was open, however its hole was
/// closed, the thickness need not be a forearm's or calf's to the last: it is a limb's that lacks something. The
/// whole limb's cost and the end's shape are functions: not all ends need them.
template <typename WholeCost, typename Scalar, typename End>
bool is_cut(const WholeCost& whole_cost, Scalar cut_cost, const End& end_shape) {
    if (cut_cost < worst_cut_cost<Scalar> && least_gain<Scalar> * cut_cost < whole_cost()) return true;
    const EndShape<Scalar> end = end_shape();
    const bool is_flat = end.flat > flat_lid<Scalar> && cut_cost < worst_lidded_cost<Scalar>;
    if (!is_flat && !(end.open > open_lid<Scalar>)) return false;
    const Scalar lid = std::max(end.flat, end.open);
    return std::log(whole_cost() / cut_cost) + 2 * (lid - balanced<Scalar>) > 0;
}

/// The limb as it were if it ended at wrist or ankle, on the line that it has.
template <typename Scalar>
Limb<Scalar> ending_at(Limb<Scalar> limb, std::size_t outer) {
    const Scalar off = (1 - left_of_end<Scalar>)*limb.from_tip[outer];
    for (Scalar& from_tip : limb.from_tip) from_tip = std::max(from_tip - off, Scalar(0));
    limb.missing = limb.joints.size() - 1 - outer;
    return shorten_line(std::move(limb));
}

template <typename Scalar>
Scalar cost_of(Limb<Scalar> limb, const SkeletonTemplate& skeleton_template, const ThicknessProfileOptions& options) {
    const auto p = as_profiled(limb, skeleton_template);
    return least_cost<Scalar>({thickness_samples(limb), p->rest, std::nullopt},
                              p->part == BodyPart::leg ? leg_profile : arm_profile, options);
}

} // namespace detail

template <typename Scalar>
std::vector<Limb<Scalar>>
shorten_cut_limbs(std::vector<Limb<Scalar>> limbs, const Slicer<Scalar>& slicer,
                  const std::vector<EndPoint<Scalar>>& ends, const SkeletonTemplate& skeleton_template,
                  const ThicknessProfileOptions& options, const CentrelineOptions& centreline) {
    core::parallel_for(limbs.size(), 1, [&](std::size_t i) {
        const auto profiled = detail::as_profiled(limbs[i], skeleton_template);
        if (!profiled || profiled->outer + 1 >= limbs[i].joints.size()) return;
        if (four_sidedness(slicer.mesh(), limbs[i], ends[i], limbs[i].from_tip[profiled->outer]) > detail::box<Scalar>)
            return;
        Limb<Scalar> cut = detail::ending_at(limbs[i], profiled->outer);
        const Scalar cut_cost = detail::cost_of(cut, skeleton_template, options);
        const auto whole_cost = [&] { return detail::cost_of(limbs[i], skeleton_template, options); };
        const auto end_shape = [&]() -> detail::EndShape<Scalar> {
            const Scalar beyond = limbs[i].from_tip[profiled->outer];
            return {flat_end(slicer.mesh(), limbs[i], ends[i], beyond),
                    open_end(slicer.mesh(), limbs[i], ends[i], beyond)};
        };
        if (!detail::is_cut(whole_cost, cut_cost, end_shape)) return;
        limbs[i] = draw_limb(std::move(cut), slicer, ends[i], centreline);
    });
    return limbs;
}

} // namespace skelgen::refinement
