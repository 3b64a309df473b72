#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/heat_weights.hpp>
#include <skelgen/applications/impl/resting_surface.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {

namespace detail {

/// A limb that bends by 90 degrees, seen from the joint.
template <typename Scalar>
class HingeBend {
    using Accumulator = core::Accumulator;
    using Vector = Vector3<Accumulator>;

public:
    HingeBend(const JointWeights& weights, const RestingSurface<Scalar>& surface, const Triangles& faces,
              const SkeletonTemplate& skeleton_template, int hinge)
        : surface_(surface), is_below_(joints_below(skeleton_template, hinge)),
          joint_(surface.skeleton.joints[static_cast<std::size_t>(hinge)].position) {
        const auto axes = surface.axes[static_cast<std::size_t>(hinge)];
        bend_ = Eigen::AngleAxis<Accumulator>(std::numbers::pi / 2,
                                              (axes * Vector3<Scalar>::UnitX()).template cast<Accumulator>());
        const Points<Scalar> rest = at_rest(surface, weights);
        for (int v = 0; v < weights.rows(); ++v) {
            shares_.push_back(std::min(shares_of(weights, v, is_below_).below, Accumulator(1)));
            places_.push_back(from_joint(rest, v));
            if (shares_.back() > none && shares_.back() < 1 - none) between_.push_back(v);
        }
        weights_ = weights(between_, Eigen::all);
        as_is_ = surface.as_is(between_, Eigen::all);
        for (Eigen::Index f = 0; f < faces.rows(); ++f) {
            const std::array<std::size_t, 3> face{static_cast<std::size_t>(faces(f, 0)),
                                                  static_cast<std::size_t>(faces(f, 1)),
                                                  static_cast<std::size_t>(faces(f, 2))};
            int above = 0, below = 0;
            for (const std::size_t v : face) {
                above += shares_[v] < none ? 1 : 0;
                below += shares_[v] > 1 - none ? 1 : 0;
            }
            if (below == 3)
                rigid_ += area({places_[face[0]], places_[face[1]], places_[face[2]]});
            else if (above < 3)
                faces_.push_back(face);
        }
        below_ = volume_following(weights, faces, hinge);
        above_ = volume_following(weights, faces, skeleton_template.joint(hinge).parent);
    }

    /// Is what bends of one piece? Others that lie on it, as a skirt on a knee, would come apart from it.
    [[nodiscard]] bool is_one_piece(core::DisjointSets& pieces) const {
        return std::all_of(between_.begin(), between_.end(), [&](int v) {
            return pieces.find(static_cast<std::size_t>(v)) == pieces.find(static_cast<std::size_t>(between_.front()));
        });
    }

    /// How much a bend changes the volumes of what is below and above together, as shares.
    [[nodiscard]] Accumulator change() { return changes(0).norm(); }

    /// The weights with the border where it changes the volumes least; as they are where it does so little enough.
    [[nodiscard]] JointWeights balanced(JointWeights weights, Accumulator tolerated) {
        constexpr Accumulator farthest = 5; // half a radius away: heat falls by e for each, odds are its sixth power
        constexpr int steps = 10;           // to either side
        if (change() < tolerated) return weights;
        const auto log_odds_at = [&](int step) { return farthest * (step - steps - 1) / steps; };
        std::vector<Eigen::Vector2<Accumulator>> found; // also one step beyond
        for (int i = 0; i <= 2 * steps + 2; ++i) found.push_back(changes(log_odds_at(i)));
        // Creases are of few and large faces once they are open: neighbours say together where the border is better.
        const auto cost = [&](int i) {
            const auto at = static_cast<std::size_t>(i);
            return (found[at - 1] + found[at] + found[at + 1]).squaredNorm();
        };
        int best = steps + 1;
        for (int i = 1; i <= 2 * steps + 1; ++i)
            if (cost(i) < cost(best)) best = i;
        weights(between_, Eigen::all) = moved(log_odds_at(best));
        return weights;
    }

private:
    static constexpr Accumulator none = 1e-6; ///< a share that moves nothing
    using Triangle = std::array<Vector, 3>;

    /// A part of the surface, straight and bent.
    struct Part {
        Accumulator growth = 0; ///< of the volume that the joint sees
        Vector area[2] = {Vector::Zero(), Vector::Zero()}, rim[2] = {Vector::Zero(), Vector::Zero()};

        /// Of the volume, closed by a fan around the middle of its rim.
        [[nodiscard]] Accumulator change() const { return growth - (rim[1].dot(area[1]) - rim[0].dot(area[0])) / 6; }
    };

    static Vector area(const Triangle& t) { return t[0].cross(t[1]) + t[1].cross(t[2]) + t[2].cross(t[0]); }
    static Accumulator volume(const Triangle& t) { return t[0].dot(t[1].cross(t[2])) / 6; }
    static Accumulator share_at(Accumulator share, Accumulator log_odds) {
        return share / (share + (1 - share) * std::exp(-log_odds));
    }

    /// Of the part that follows a joint most, as its middle sees it: the same share of any tube.
    [[nodiscard]] Accumulator volume_following(const JointWeights& weights, const Triangles& faces, int joint) const {
        std::vector<Triangle> part;
        Vector sum = Vector::Zero();
        for (Eigen::Index f = 0; f < faces.rows(); ++f) {
            const int v = faces(f, 0);
            if (!(weights(v, joint) > Accumulator(0.5))) continue;
            part.push_back({places_[static_cast<std::size_t>(v)], places_[static_cast<std::size_t>(faces(f, 1))],
                            places_[static_cast<std::size_t>(faces(f, 2))]});
            sum += part.back()[0];
        }
        const Vector middle = sum / static_cast<Accumulator>(std::max<std::size_t>(1, part.size()));
        Accumulator seen = 0;
        for (const Triangle& t : part) seen += volume({t[0] - middle, t[1] - middle, t[2] - middle});
        return seen;
    }

    [[nodiscard]] Vector from_joint(const Points<Scalar>& points, Eigen::Index v) const {
        return (core::point(points, v) - joint_).template cast<Accumulator>();
    }

    /// The weights of the vertices that follow both, the odds of following the hinge multiplied by that.
    [[nodiscard]] JointWeights moved(Accumulator log_odds) const {
        JointWeights weights = weights_;
        for (std::size_t i = 0; i < between_.size(); ++i) {
            const Accumulator was = shares_[static_cast<std::size_t>(between_[i])];
            divide_shares(weights, static_cast<Eigen::Index>(i), is_below_, share_at(was, log_odds));
        }
        return weights;
    }

    /// What a bend changes of what is below and above, as shares of their volumes.
    [[nodiscard]] Eigen::Vector2<Accumulator> changes(Accumulator log_odds) {
        const Points<Scalar> rest =
            at_rest<Scalar>({as_is_, surface_.motions, surface_.skeleton, surface_.axes}, moved(log_odds));
        for (std::size_t i = 0; i < between_.size(); ++i)
            places_[static_cast<std::size_t>(between_[i])] = from_joint(rest, static_cast<Eigen::Index>(i));
        Part above, below;
        Vector between[2] = {Vector::Zero(), Vector::Zero()};
        below.area[0] = rigid_;
        below.area[1] = bend_ * rigid_;
        int rim_above = 0, rim_below = 0;
        for (const auto& face : faces_) {
            Triangle straight, bent;
            int count = 0;
            bool is_in[3];
            for (std::size_t k = 0; k < 3; ++k) {
                straight[k] = places_[face[k]];
                const Accumulator share = share_at(shares_[face[k]], log_odds);
                bent[k] = (1 - share) * straight[k] + share * (bend_ * straight[k]);
                is_in[k] = share > Accumulator(0.5);
                count += is_in[k] ? 1 : 0;
            }
            if (count == 3 || count == 0) (count == 3 ? below : above).growth += volume(bent) - volume(straight);
            if (count == 0) continue;
            Vector* areas = count == 3 ? below.area : between;
            areas[0] += area(straight);
            areas[1] += area(bent);
            for (std::size_t k = 0; k < 3 && count < 3; ++k) {
                Part& part = is_in[k] ? below : above;
                part.rim[0] += straight[k];
                part.rim[1] += bent[k];
                ++(is_in[k] ? rim_below : rim_above);
            }
        }
        if (rim_above == 0 || rim_below == 0) return {0, 0};
        for (int i = 0; i < 2; ++i) {
            above.area[i] = -below.area[i] - between[i]; // of a closed surface it is nothing
            above.rim[i] /= rim_above;
            below.rim[i] /= rim_below;
        }
        return {below.change() / below_, above.change() / above_};
    }

    const RestingSurface<Scalar>& surface_;
    std::vector<bool> is_below_;
    Vector3<Scalar> joint_;
    Eigen::Matrix3<Accumulator> bend_;
    std::vector<int> between_;        ///< vertices that follow both sides
    JointWeights weights_;            ///< of those
    Points<Scalar> as_is_;            ///< those
    std::vector<Accumulator> shares_; ///< per vertex of what is below the joint
    std::vector<Vector> places_;
    std::vector<std::array<std::size_t, 3>> faces_; ///< all that do not move rigidly
    Vector rigid_ = Vector::Zero();                 ///< twice the area of those that follow the hinge rigidly
    Accumulator below_ = 0, above_ = 0;             ///< volumes of the parts at the bend
};

} // namespace detail

/// The weights with the borders at elbows and knees moved along the limb, by at most some half of its radius, to where
/// a bend by 90 degrees from rest changes the volumes of what is above and below least, by linear skinning and as
/// squares of their shares. In a bent tube of section A whose border is the length c below the joint, whose middle line
/// is y inside of it, and which follows the hinge by w, the part below gains A (c / 4 - y / 2 - integral of w (1 - w))
/// beyond the border, and the part above A (-c / 4 - y / 2 - integral) on its side: what the one gains by moving the
/// border the other loses, and the smaller part feels it more. A limb that comes bent is another one at rest wherever
/// its border is, so each of the borders that are tried is seen on the surface that it leads to. Where several
/// pieces bend, as a skirt and the knee below it, borders stay, so that these stay together; and where a bend changes
/// both volumes together, as shares, by less than `tolerated`. `surface` closed, or open where the bend moves it little
/// or as a whole, its skeleton the template's rest pose but for lengths; `faces` name the rows. O(n joints).
template <typename Scalar>
JointWeights with_balanced_bends(JointWeights weights, const RestingSurface<Scalar>& surface, const Triangles& faces,
                                 const SkeletonTemplate& skeleton_template, core::Accumulator tolerated = 0) {
    core::DisjointSets pieces(static_cast<std::size_t>(weights.rows()));
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 2; ++k)
            pieces.unite(static_cast<std::size_t>(faces(f, k)), static_cast<std::size_t>(faces(f, k + 1)));
    for (int j = 0; j < static_cast<int>(skeleton_template.joints.size()); ++j) {
        const JointRole role = skeleton_template.joint(j).role;
        if (role != JointRole::elbow && role != JointRole::knee) continue;
        detail::HingeBend<Scalar> bend(weights, surface, faces, skeleton_template, j);
        if (bend.is_one_piece(pieces)) weights = bend.balanced(std::move(weights), tolerated);
    }
    return weights;
}

/// How much a bend by 90 degrees from rest changes the volumes of what is above and below an elbow or a knee together,
/// as shares, at the one where it is most. As `with_balanced_bends`. O(n joints).
template <typename Scalar>
core::Accumulator largest_bend_change(const JointWeights& weights, const RestingSurface<Scalar>& surface,
                                      const Triangles& faces, const SkeletonTemplate& skeleton_template) {
    core::Accumulator largest = 0;
    for (int j = 0; j < static_cast<int>(skeleton_template.joints.size()); ++j) {
        const JointRole role = skeleton_template.joint(j).role;
        if (role != JointRole::elbow && role != JointRole::knee) continue;
        const auto change = detail::HingeBend<Scalar>(weights, surface, faces, skeleton_template, j).change();
        if (change > largest) largest = change; // none where nothing is below
    }
    return largest;
}

} // namespace skelgen::applications
