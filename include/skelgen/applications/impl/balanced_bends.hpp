#pragma once

#include <skelgen/applications/balanced_bends.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/bones.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::applications {
namespace detail {

/// A limb that bends by 90 degrees, seen from the joint.
template <typename Scalar>
class HingeBend {
    using Accumulator = core::Accumulator;
    using Vector = Vector3<Accumulator>;

public:
    HingeBend(const JointWeights& weights, const HeldSurface<Scalar>& at_rest, const Triangles& faces,
              const SkeletonTemplate& skeleton_template, int hinge)
        : is_below_(joints_below(skeleton_template, hinge)) {
        const Vector3<Scalar>& joint = at_rest.skeleton.joints[static_cast<std::size_t>(hinge)].position;
        const auto axes = rest_axes<Scalar>(skeleton_template)[static_cast<std::size_t>(hinge)];
        bend_ = Eigen::AngleAxis<Accumulator>(std::numbers::pi / 2,
                                              (axes * Vector3<Scalar>::UnitX()).template cast<Accumulator>());
        for (Eigen::Index v = 0; v < weights.rows(); ++v) {
            shares_.push_back(share_below(weights, v));
            places_.push_back((core::point(at_rest.vertices, v) - joint).template cast<Accumulator>());
        }
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

    /// What the odds of following the hinge have to be multiplied by, as a logarithm.
    [[nodiscard]] Accumulator balance() const {
        constexpr Accumulator farthest = 5; // half a radius away: heat falls by e for each, odds are its sixth power
        constexpr int halvings = 8;
        Accumulator low = -farthest, high = farthest;
        for (int i = 0; i < halvings; ++i) {
            const Accumulator middle = (low + high) / 2;
            (slope(middle) > 0 ? low : high) = middle;
        }
        return (low + high) / 2;
    }

    [[nodiscard]] JointWeights moved(JointWeights weights, Accumulator log_odds) const {
        for (Eigen::Index v = 0; v < weights.rows(); ++v) {
            const Accumulator was = shares_[static_cast<std::size_t>(v)], is = share_at(was, log_odds);
            if (!(was > 0 && was < 1)) continue;
            for (std::size_t j = 0; j < is_below_.size(); ++j)
                weights(v, static_cast<Eigen::Index>(j)) *= is_below_[j] ? is / was : (1 - is) / (1 - was);
        }
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

    [[nodiscard]] Accumulator share_below(const JointWeights& weights, Eigen::Index v) const {
        Accumulator below = 0;
        for (std::size_t j = 0; j < is_below_.size(); ++j)
            if (is_below_[j]) below += weights(v, static_cast<Eigen::Index>(j));
        return std::min(below, Accumulator(1));
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

    /// How much the sum of the squares falls where the border moves towards the trunk; it does so ever less.
    [[nodiscard]] Accumulator slope(Accumulator log_odds) const {
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
        if (rim_above == 0 || rim_below == 0) return 0;
        for (int i = 0; i < 2; ++i) {
            above.area[i] = -below.area[i] - between[i]; // of a closed surface it is nothing
            above.rim[i] /= rim_above;
            below.rim[i] /= rim_below;
        }
        return below.change() / (below_ * below_) - above.change() / (above_ * above_);
    }

    std::vector<bool> is_below_;
    Eigen::Matrix3<Accumulator> bend_;
    std::vector<Accumulator> shares_; ///< per vertex of what is below the joint
    std::vector<Vector> places_;
    std::vector<std::array<std::size_t, 3>> faces_; ///< all that do not move rigidly
    Vector rigid_ = Vector::Zero();                 ///< twice the area of those that follow the hinge rigidly
    Accumulator below_ = 0, above_ = 0;             ///< volumes of the parts at the bend
};

} // namespace detail

template <typename Scalar>
JointWeights with_balanced_bends(JointWeights weights, const HeldSurface<Scalar>& at_rest, const Triangles& faces,
                                 const SkeletonTemplate& skeleton_template) {
    for (int j = 0; j < static_cast<int>(skeleton_template.joints.size()); ++j) {
        const JointRole role = skeleton_template.joint(j).role;
        if (role != JointRole::elbow && role != JointRole::knee) continue;
        const detail::HingeBend<Scalar> bend(weights, at_rest, faces, skeleton_template, j);
        weights = bend.moved(std::move(weights), bend.balance());
    }
    return weights;
}

} // namespace skelgen::applications
