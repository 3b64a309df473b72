#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/heat_weights.hpp>
#include <skelgen/applications/impl/limb_volume.hpp>
#include <skelgen/applications/impl/resting_surface.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {

namespace detail {

/// What becomes of the logarithm of the odds of following a hinge.
struct OddsChange {
    core::Accumulator factor = 1;
    core::Accumulator shift = 0;
    core::Accumulator slant = 0; ///< per radius of the joint, along the way that a bend takes what lies straight on

    /// How much it changes: what makes the bend narrower least, for it keeps the border where it is.
    [[nodiscard]] core::Accumulator size() const {
        return std::pow(std::log2(factor), 2) + std::pow(shift, 2) + std::pow(slant, 2);
    }
};

/// Those to choose from, the least first. Odds grow by e to the sixth power along a radius: 4 is two thirds of it, or
/// turns the border by some 30 degrees.
inline std::vector<OddsChange> odds_changes() {
    constexpr int halves = 2;
    std::vector<OddsChange> out;
    for (int doublings = 0; doublings <= 2 * halves; ++doublings)
        for (int shift = -4 * halves; shift <= 4 * halves; ++shift)
            for (int slant = -4; slant <= 4; ++slant)
                out.push_back({std::exp2(static_cast<core::Accumulator>(doublings) / halves),
                               static_cast<core::Accumulator>(shift) / halves, static_cast<core::Accumulator>(slant)});
    std::stable_sort(out.begin(), out.end(),
                     [](const OddsChange& a, const OddsChange& b) { return a.size() < b.size(); });
    return out;
}

/// What a bend does to the parts below and above its hinge.
struct VolumeChanges {
    using Accumulator = core::Accumulator;
    struct Part {
        Accumulator volume = 0; ///< straight, without sign
        Accumulator change = 0; ///< as a share of it
    };
    Part below, above;

    /// Are both parts kept, the lower one but for the share `most`?
    [[nodiscard]] bool keeps(const VolumeChanges& before, Accumulator most) const {
        return below.change <= most && above.change <= std::max(most, before.above.change) &&
               2 * below.volume >= before.below.volume && 2 * above.volume >= before.above.volume;
    }
};

/// The surface around a hinge, straight and bent by 90 degrees.
template <typename Scalar>
class SurfaceAtHinge {
    using Accumulator = core::Accumulator;
    using Vector = Vector3<Accumulator>;

public:
    SurfaceAtHinge(const JointWeights& weights, const RestingSurface<Scalar>& surface, const Triangles& faces,
                   const SkeletonTemplate& skeleton_template, int hinge)
        : surface_(surface),
          is_below_(joints_below(skeleton_template, hinge)), joints_{hinge, skeleton_template.joint(hinge).parent} {
        for (std::size_t i = 0; i < 2; ++i) {
            from_[i] =
                surface.skeleton.joints[static_cast<std::size_t>(joints_[i])].position.template cast<Accumulator>();
            to_[i] = bone_end(surface.skeleton, skeleton_template, joints_[i]).template cast<Accumulator>();
        }
        const Vector axis =
            (surface.axes[static_cast<std::size_t>(hinge)] * Vector3<Scalar>::UnitX()).template cast<Accumulator>();
        bend_ = Eigen::AngleAxis<Accumulator>(std::numbers::pi_v<Accumulator> / 2, axis);
        take_faces_near(weights, faces);
        take_between(weights);
        const Vector way = axis.cross((to_[0] - from_[0]).normalized());
        const auto radius = static_cast<Accumulator>(surface.skeleton.joints[static_cast<std::size_t>(hinge)].radius);
        for (const int v : between_) // what lies beyond the limb, as wings do, follows the hinge no more by it
            along_way_.push_back(
                radius > 0 ? std::clamp<Accumulator>(way.dot(core::point(places_, v) - from_[0]) / radius, -1, 1) : 0);
    }

    /// With the weights as they are.
    [[nodiscard]] VolumeChanges changes() { return changes(weights_, std::numeric_limits<Accumulator>::infinity()); }

    /// With other odds; without what is above where what is below changes by more than `most`.
    [[nodiscard]] VolumeChanges changes(const OddsChange& odds, Accumulator most) {
        return changes(changed(odds), most);
    }

    /// All weights with other odds.
    [[nodiscard]] JointWeights changed(JointWeights weights, const OddsChange& odds) const {
        weights(rows_between_, Eigen::all) = changed(odds);
        return weights;
    }

private:
    static constexpr Accumulator none = 1e-6; ///< a share that moves nothing

    static int strongest(const JointWeights& weights, Eigen::Index v) {
        int joint = 0;
        weights.row(v).maxCoeff(&joint);
        return joint;
    }

    [[nodiscard]] bool is_between(const JointWeights& weights, Eigen::Index v) const {
        const Accumulator share = shares_of(weights, v, is_below_).below;
        return share > none && share < 1 - none;
    }

    /// Numbers the vertices of the faces that may be of either part.
    void take_faces_near(const JointWeights& weights, const Triangles& faces) {
        std::vector<bool> is_near;
        for (Eigen::Index v = 0; v < weights.rows(); ++v) {
            const int joint = strongest(weights, v);
            is_near.push_back(joint == joints_[0] || joint == joints_[1] || is_between(weights, v));
        }
        std::vector<int> number(is_near.size(), -1);
        faces_.resize(faces.rows(), 3);
        Eigen::Index kept = 0;
        for (Eigen::Index f = 0; f < faces.rows(); ++f) {
            const auto is_in = [&](int k) -> bool { return is_near[static_cast<std::size_t>(faces(f, k))]; };
            if (!is_in(0) || !is_in(1) || !is_in(2)) continue;
            for (int k = 0; k < 3; ++k) {
                int& own = number[static_cast<std::size_t>(faces(f, k))];
                if (own < 0) {
                    own = static_cast<int>(rows_.size());
                    rows_.push_back(faces(f, k));
                }
                faces_(kept, k) = own;
            }
            ++kept;
        }
        faces_.conservativeResize(kept, 3);
    }

    void take_between(const JointWeights& weights) {
        places_ = at_rest(surface_, weights, rows_).template cast<Accumulator>();
        for (std::size_t v = 0; v < rows_.size(); ++v) {
            shares_.push_back(shares_of(weights, rows_[v], is_below_).below);
            strongest_.push_back(strongest(weights, rows_[v]));
            if (!is_between(weights, rows_[v])) continue;
            between_.push_back(static_cast<int>(v));
            rows_between_.push_back(rows_[v]);
        }
        weights_ = weights(rows_between_, Eigen::all);
        as_is_ = surface_.as_is(rows_between_, Eigen::all);
    }

    [[nodiscard]] JointWeights changed(const OddsChange& odds) const {
        JointWeights out = weights_;
        for (std::size_t i = 0; i < between_.size(); ++i) {
            const auto row = static_cast<Eigen::Index>(i);
            const auto [below, above] = shares_of(weights_, row, is_below_);
            const Accumulator log_odds =
                odds.factor * std::log(below / above) + odds.shift + odds.slant * along_way_[i];
            divide_shares(out, row, is_below_, 1 / (1 + std::exp(-log_odds)));
        }
        return out;
    }

    [[nodiscard]] VolumeChanges changes(const JointWeights& of_between, Accumulator most) {
        const Points<Scalar> rest =
            at_rest<Scalar>({as_is_, surface_.motions, surface_.skeleton, surface_.axes}, of_between);
        for (std::size_t i = 0; i < between_.size(); ++i) {
            const auto row = static_cast<Eigen::Index>(i);
            const auto v = static_cast<std::size_t>(between_[i]);
            places_.row(between_[i]) = rest.row(row).template cast<Accumulator>();
            shares_[v] = shares_of(of_between, row, is_below_).below;
            strongest_[v] = strongest(of_between, row);
        }
        Points<Accumulator> bent = places_;
        for (Eigen::Index v = 0; v < bent.rows(); ++v) {
            const Vector arm = core::point(places_, v) - from_[0];
            core::set_point<Accumulator>(bent, v,
                                         from_[0] + arm + shares_[static_cast<std::size_t>(v)] * (bend_ * arm - arm));
        }
        VolumeChanges out;
        out.below = part(0, bent);
        if (out.below.change <= most) out.above = part(1, bent);
        return out;
    }

    [[nodiscard]] VolumeChanges::Part part(std::size_t side, const Points<Accumulator>& bent) const {
        const Triangles of_joint = faces_following(faces_, strongest_, joints_[side]);
        const Triangles faces = around_bone(places_, of_joint, from_[side], to_[side]);
        if (faces.rows() == 0) return {};
        const Accumulator was = closed_volume(places_, faces), is = closed_volume(bent, faces);
        if (was == 0) return {0, std::numeric_limits<Accumulator>::infinity()};
        return {std::abs(was), std::abs(is / was - 1)};
    }

    const RestingSurface<Scalar>& surface_;
    std::vector<bool> is_below_;
    std::array<int, 2> joints_;       ///< the hinge and the one above it
    std::array<Vector, 2> from_, to_; ///< of their bones
    Eigen::Matrix3<Accumulator> bend_;
    std::vector<int> rows_; ///< per vertex here its row in the weights
    Triangles faces_;       ///< of vertices here
    Points<Accumulator> places_;
    std::vector<Accumulator> shares_; ///< of what is below
    std::vector<int> strongest_;
    std::vector<int> between_, rows_between_; ///< vertices here that follow both sides, and their rows
    std::vector<Accumulator> along_way_;      ///< of those: how far they lie along a bend's way, in radii, at most 1
    JointWeights weights_;                    ///< of those
    Points<Scalar> as_is_;                    ///< those
};

/// Keeps the volume below a hinge better. \returns whether the weights have been changed.
template <typename Scalar>
bool keep_volume(JointWeights& weights, const RestingSurface<Scalar>& surface, const Triangles& faces,
                 const SkeletonTemplate& skeleton_template, int hinge,
                 const std::function<JointWeights(JointWeights)>& restricted) {
    constexpr core::Accumulator noticed = 0.05, aim = 0.03; // with room for what comes later
    constexpr int most_tries = 20;
    using AtHinge = SurfaceAtHinge<Scalar>;
    AtHinge at_hinge(weights, surface, faces, skeleton_template, hinge);
    const VolumeChanges before = at_hinge.changes();
    if (before.below.change <= noticed) return false;
    core::Accumulator least = before.below.change;
    JointWeights best;
    int tries = 0;
    for (const OddsChange& odds : odds_changes()) {
        if (!at_hinge.changes(odds, aim).keeps(before, aim)) continue;
        JointWeights tried = restricted(at_hinge.changed(weights, odds));
        const VolumeChanges after = AtHinge(tried, surface, faces, skeleton_template, hinge).changes();
        if (after.below.change < least && after.keeps(before, least)) {
            least = after.below.change;
            best = std::move(tried);
        }
        if (least <= aim || ++tries == most_tries) break;
    }
    if (best.size() == 0) return false;
    weights = std::move(best);
    return true;
}

} // namespace detail

/// The weights with forearms and calves that keep their volume when elbows and knees bend by 90 degrees from rest, by
/// linear skinning: where what follows the hinge most and surrounds its bone would change by more than a twentieth, to
/// 3 %. Where few rings of vertices make a limb no place of the border does that alone: those beside it move too far or
/// not far enough, and a ring less or more is another part. So the logarithm of the odds of following the hinge may be
/// shifted, which moves the border along the limb, multiplied, which makes the bend narrower, and slanted, which turns
/// the border about the hinge's axis. All that bends is changed alike: pieces that lie on each other, as a sleeve on an
/// arm, stay together. Of the changes that serve the least is taken; where none does, that which leaves least, if it is
/// less than before. No part loses more than half of itself to the other one, and the part above changes by no more
/// than the one below may, or it did before. `restricted` is what weights have to keep to: those that are tried are
/// judged after it. `surface` at rest as `with_balanced_bends` has it; `faces` name the rows.
/// O(n joints) for what keeps its volume already, else O(changes faces around the hinge + tries (n joints +
/// restricted)), where of hundreds of changes at most some tens are tried.
template <typename Scalar>
JointWeights with_kept_volumes(JointWeights weights, const RestingSurface<Scalar>& surface, const Triangles& faces,
                               const SkeletonTemplate& skeleton_template,
                               const std::function<JointWeights(JointWeights)>& restricted) {
    constexpr int rounds = 3; // what has been restricted may start again
    for (int j = 0; j < static_cast<int>(skeleton_template.joints.size()); ++j) {
        const JointRole role = skeleton_template.joint(j).role;
        if (role != JointRole::elbow && role != JointRole::knee) continue;
        for (int round = 0; round < rounds; ++round)
            if (!detail::keep_volume(weights, surface, faces, skeleton_template, j, restricted)) break;
    }
    return weights;
}

} // namespace skelgen::applications
