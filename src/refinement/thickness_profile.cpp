#include <skelgen/refinement/thickness_profile.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace skelgen {
namespace {

/// Mean logarithm of a limb's thickness where its coordinate u runs from -0.6 to 1.6 in steps of 0.1: -1 at the tip, 0 at
/// wrist or ankle, 1 at elbow or knee, 2 at shoulder or hip. Up to a constant. Calibrated: the straight limbs of 50
/// registered bodies.
using Profile = std::array<double, 23>;
constexpr double first_u = -0.6, step_u = 0.1;
constexpr Profile leg_profile{-0.395, -0.357, -0.313, -0.248, -0.129, -0.044, -0.176, -0.328, -0.295, -0.186, -0.055, 0.077,
                              0.174,  0.201,  0.167,  0.125,  0.177,  0.238,  0.279,  0.340,  0.417,  0.485,  0.547};
constexpr Profile arm_profile{-1.001, -0.339, -0.150, -0.007, -0.063, -0.183, -0.269, -0.257, -0.207, -0.139, -0.058, 0.031,
                              0.101,  0.142,  0.161,  0.166,  0.162,  0.164,  0.191,  0.236,  0.279,  0.319,  0.357};
constexpr double end_weight = 0.3; // of samples on hand and foot, whose shape changes most

/// Value of the profile at u; none beyond its ends.
std::optional<double> value_at(const Profile& profile, double u) {
    const double x = (u - first_u) / step_u;
    if (!(x >= 0) || x >= static_cast<double>(profile.size() - 1)) return std::nullopt;
    const auto i = static_cast<std::size_t>(x);
    return profile[i] + (x - static_cast<double>(i)) * (profile[i + 1] - profile[i]);
}

/// Distances of a limb's joints from its tip.
struct Stretch {
    double outer = 0, middle = 0, inner = 0; ///< wrist, elbow, shoulder; or ankle, knee, hip

    [[nodiscard]] double u(double from_tip) const {
        if (from_tip < outer) return from_tip / outer - 1;
        if (from_tip < middle) return (from_tip - outer) / (middle - outer);
        return 1 + (from_tip - middle) / (inner - middle);
    }
};

struct Sample {
    double from_tip = 0, log_thickness = 0;
};

/// Thickness of the limb where its sections are its own.
std::vector<Sample> samples_of(const Limb& limb) {
    std::vector<Sample> samples;
    const double end = limb.line.arc[limb.line.arc.size() - 1];
    for (Eigen::Index i = 0; i < limb.line.arc.size(); ++i)
        if (limb.line.arc[i] > limb.attachment && limb.line.thickness[i] > 0)
            samples.push_back({end - limb.line.arc[i], std::log(limb.line.thickness[i])});
    return samples;
}

/// How well a stretched profile fits.
struct Fit {
    double misfit = std::numeric_limits<double>::infinity(); ///< mean squared difference, in squared deviations
    double stoutness = 0;                                    ///< mean difference of the logarithms
};

/// Compares the samples with the profile stretched over them. Robust: sections across a fold or a sleeve count for no more
/// than three deviations.
Fit fit(const std::vector<Sample>& samples, const Profile& profile, const Stretch& stretch, double deviation) {
    struct Residual {
        double value, weight;
    };
    std::vector<Residual> residuals;
    for (const Sample& sample : samples) {
        const double u = stretch.u(sample.from_tip);
        if (const auto expected = value_at(profile, u))
            residuals.push_back({sample.log_thickness - *expected, u < 0 ? end_weight : 1});
    }
    double offset = 0; // how stout the limb is
    for (int round = 0; round < 3; ++round) {
        double sum = 0, weights = 0;
        for (const Residual& r : residuals) {
            const double far = (r.value - offset) / (2.5 * deviation);
            const double weight = round == 0 ? r.weight : r.weight / (1 + far * far);
            sum += weight * r.value;
            weights += weight;
        }
        if (!(weights > 0)) return {};
        offset = sum / weights;
    }
    double sum = 0, weights = 0;
    for (const Residual& r : residuals) {
        const double far = (r.value - offset) / deviation;
        sum += r.weight * std::min(far * far, 9.0);
        weights += r.weight;
    }
    return {sum / weights, offset};
}

class Matcher {
public:
    Matcher(std::vector<Sample> samples, const Profile& profile, const Stretch& rest, const ThicknessProfileOptions& options)
        : samples_(std::move(samples)), profile_(profile), rest_(rest), options_(options) {}

    /// The best stretch, by search on a grid and on a finer one around its best.
    [[nodiscard]] Stretch best() const {
        constexpr double widest = 0.3, step = 0.03; // of logarithms: lengths from 3/4 to 4/3
        const auto coarse = search(0, 0, widest, step);
        const auto fine = search(coarse.log_outer, coarse.log_middle, step, step / 6);
        return stretch(fine.log_outer, fine.log_middle);
    }

private:
    struct Candidate {
        double log_outer = 0, log_middle = 0, cost = std::numeric_limits<double>::infinity();
    };

    [[nodiscard]] double bone_ratio(const Stretch& s) const { return (s.middle - s.outer) / (rest_.middle - rest_.outer); }

    [[nodiscard]] Stretch stretch(double log_outer, double log_middle) const {
        Stretch s{rest_.outer * std::exp(log_outer), rest_.middle * std::exp(log_middle), 0};
        s.inner = s.middle + std::max(bone_ratio(s), 0.1) * (rest_.inner - rest_.middle);
        return s;
    }

    [[nodiscard]] double cost(double log_outer, double log_middle) const {
        const Stretch s = stretch(log_outer, log_middle);
        const double bone = bone_ratio(s);
        if (bone < 0.5) return std::numeric_limits<double>::infinity();
        constexpr double far_misfit = 2; // beyond it, a limb is unlike the profile (in trousers, in armour) and tells less
        const auto square = [](double x) { return x * x; };
        return options_.independent_samples * far_misfit * std::log1p(fit(samples_, profile_, s, options_.thickness_deviation).misfit / far_misfit) +
               square(log_outer / options_.end_deviation) + square(log_middle / options_.limb_deviation) +
               square(std::log(bone) / options_.bone_deviation);
    }

    [[nodiscard]] Candidate search(double log_outer, double log_middle, double reach, double step) const {
        Candidate best{log_outer, log_middle, cost(log_outer, log_middle)};
        const int steps = static_cast<int>(std::lround(reach / step));
        for (int i = -steps; i <= steps; ++i)
            for (int j = -steps; j <= steps; ++j) {
                const Candidate next{log_outer + i * step, log_middle + j * step,
                                     cost(log_outer + i * step, log_middle + j * step)};
                if (next.cost < best.cost) best = next;
            }
        return best;
    }

    std::vector<Sample> samples_;
    const Profile& profile_;
    Stretch rest_;
    ThicknessProfileOptions options_;
};

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
};

std::optional<ProfiledLimb> profiled(Limb& limb, const SkeletonTemplate& skeleton_template) {
    using enum JointRole;
    const bool leg = find(limb, skeleton_template, knee).has_value();
    const auto inner = find(limb, skeleton_template, leg ? hip : shoulder);
    const auto middle = find(limb, skeleton_template, leg ? knee : elbow);
    const auto outer = find(limb, skeleton_template, leg ? ankle : wrist);
    if (!inner || !middle || !outer) return std::nullopt;
    return ProfiledLimb{&limb, leg, *inner, *middle, *outer,
                        {limb.from_tip[*outer], limb.from_tip[*middle], limb.from_tip[*inner]}};
}

/// Moves the limb's attachment outwards to where its sections become a third thicker than the profile has them: nearer the
/// trunk they are a coat's or a skirt's.
void move_attachment(Limb& limb, const Profile& profile, const Stretch& stretch, double stoutness) {
    const double too_thick = std::log(1.35), beyond_the_fold = 1.2; // of u: a bent knee is thick, too
    const double end = limb.line.arc[limb.line.arc.size() - 1];
    int in_a_row = 0;
    for (Eigen::Index i = limb.line.arc.size(); i-- > 0 && limb.line.arc[i] > limb.attachment;) {
        const double u = stretch.u(end - limb.line.arc[i]);
        if (u < beyond_the_fold || !(limb.line.thickness[i] > 0)) continue;
        const double expected = value_at(profile, u).value_or(profile.back());
        in_a_row = std::log(limb.line.thickness[i]) > expected + stoutness + too_thick ? in_a_row + 1 : 0;
        if (in_a_row < 3) continue;
        limb.attachment = limb.line.arc[i + 3];
        return;
    }
}

/// Puts the limb's joints from elbow or knee outwards where they fit best.
void move_outer_joints(ProfiledLimb& p, const ThicknessProfileOptions& options) {
    const Profile& profile = p.leg ? leg_profile : arm_profile;
    const std::vector<Sample> samples = samples_of(*p.limb);
    const Stretch found = Matcher(samples, profile, p.rest, options).best();
    move_attachment(*p.limb, profile, found, fit(samples, profile, found, options.thickness_deviation).stoutness);
    std::vector<double>& from_tip = p.limb->from_tip;
    for (std::size_t i = p.outer; i < from_tip.size(); ++i) from_tip[i] *= found.outer / p.rest.outer;
    from_tip[p.middle] = found.middle;
    p.bone_ratio = (found.middle - found.outer) / (p.rest.middle - p.rest.outer);
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

} // namespace

double match_thickness_profiles(std::vector<Limb>& limbs, const SkeletonTemplate& skeleton_template,
                                const ThicknessProfileOptions& options) {
    std::vector<ProfiledLimb> all;
    for (Limb& limb : limbs)
        if (const auto p = profiled(limb, skeleton_template)) all.push_back(*p);
    for (ProfiledLimb& p : all) move_outer_joints(p, options);
    for (const ProfiledLimb& p : all) {
        const double ratio = mean_ratio(all, [&](const ProfiledLimb& q) { return q.leg == p.leg; });
        p.limb->from_tip[p.inner] = p.limb->from_tip[p.middle] + ratio * (p.rest.inner - p.rest.middle);
    }
    return mean_ratio(all, [](const ProfiledLimb&) { return true; });
}

} // namespace skelgen
