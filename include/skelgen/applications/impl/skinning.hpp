#pragma once

#include <skelgen/applications/skinning.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <skelgen/core/geometry.hpp>

namespace skelgen::applications {

template <typename Scalar>
Skin<Scalar> strongest_influences(const Eigen::MatrixX<Scalar>& weights) {
    constexpr int most = Skin<Scalar>::influences;
    Skin<Scalar> skin;
    skin.joints.setZero(weights.rows(), most);
    skin.weights.setZero(weights.rows(), most);
    std::vector<int> order(static_cast<std::size_t>(weights.cols()));
    for (Eigen::Index v = 0; v < weights.rows(); ++v) {
        for (std::size_t j = 0; j < order.size(); ++j) order[j] = static_cast<int>(j);
        const auto kept = std::min<std::size_t>(most + 1, order.size());
        std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end(),
                          [&](int a, int b) { return weights(v, a) > weights(v, b); });
        Scalar dropped = order.size() > most ? weights(v, order[most]) : Scalar(0);
        if (!(weights(v, order.front()) > dropped)) dropped = 0; // five alike: any four of them
        const auto rest = [&](int joint) {
            constexpr Scalar least = std::numeric_limits<float>::epsilon(); // of the strongest: files hold floats
            const Scalar weight = weights(v, joint) - dropped;
            return weight > least * weights(v, order.front()) ? weight : Scalar(0);
        };
        Scalar sum = 0;
        for (int k = 0; k < most && k < static_cast<int>(order.size()); ++k)
            sum += rest(order[static_cast<std::size_t>(k)]);
        for (int k = 0; k < most && k < static_cast<int>(order.size()); ++k) {
            const int joint = order[static_cast<std::size_t>(k)];
            const Scalar weight = rest(joint) / sum;
            skin.weights(v, k) = weight;
            skin.joints(v, k) = weight > 0 ? joint : 0;
        }
    }
    return skin;
}

namespace detail {

/// The motions of joints as dual quaternions, of which those of a vertex are mixed.
template <typename Scalar>
class DualQuaternionBlend {
public:
    using Rotation = Eigen::Quaternion<Scalar>;

    explicit DualQuaternionBlend(const std::vector<RigidMotion<Scalar>>& motions) {
        for (const RigidMotion<Scalar>& motion : motions) {
            const Vector3<Scalar>& t = motion.translation;
            turns_.push_back(motion.rotation.coeffs());
            shifts_.push_back(Scalar(0.5) * (Rotation(0, t[0], t[1], t[2]) * motion.rotation).coeffs());
        }
    }

    [[nodiscard]] RigidMotion<Scalar> operator()(const Skin<Scalar>& skin, Eigen::Index v) const {
        const Vector4& first = turns_[static_cast<std::size_t>(skin.joints(v, 0))];
        Vector4 turn = Vector4::Zero(), shift = Vector4::Zero();
        for (int k = 0; k < Skin<Scalar>::influences; ++k) {
            const auto joint = static_cast<std::size_t>(skin.joints(v, k));
            // Of the two quaternions of a rotation, that on the strongest one's side: the shorter way round.
            const Scalar weight = turns_[joint].dot(first) < 0 ? -skin.weights(v, k) : skin.weights(v, k);
            turn += weight * turns_[joint];
            shift += weight * shifts_[joint];
        }
        const Scalar length = turn.norm();
        const Rotation rotation(Vector4(turn / length)), dual(Vector4(shift / length));
        return {rotation, Scalar(2) * (dual * rotation.conjugate()).vec()};
    }

private:
    using Vector4 = Eigen::Matrix<Scalar, 4, 1>;
    std::vector<Vector4> turns_, shifts_; ///< real and dual parts
};

} // namespace detail

template <typename Scalar>
Points<Scalar> skinned(const Points<Scalar>& points, const Skin<Scalar>& skin,
                       const std::vector<RigidMotion<Scalar>>& motions) {
    const detail::DualQuaternionBlend<Scalar> blend(motions);
    Points<Scalar> out(points.rows(), 3);
    for (Eigen::Index v = 0; v < points.rows(); ++v)
        core::set_point<Scalar>(out, v, blend(skin, v)(core::point(points, v)));
    return out;
}

template <typename Scalar>
VertexTurns<Scalar> skin_turns(const Skin<Scalar>& skin, const std::vector<RigidMotion<Scalar>>& motions) {
    const detail::DualQuaternionBlend<Scalar> blend(motions);
    VertexTurns<Scalar> out;
    out.reserve(static_cast<std::size_t>(skin.weights.rows()));
    for (Eigen::Index v = 0; v < skin.weights.rows(); ++v) out.push_back(blend(skin, v).rotation);
    return out;
}

template <typename Scalar>
Points<Scalar> skinned_linearly(const Points<Scalar>& points, const Skin<Scalar>& skin,
                                const std::vector<RigidMotion<Scalar>>& motions) {
    Points<Scalar> out(points.rows(), 3);
    for (Eigen::Index v = 0; v < points.rows(); ++v) {
        Vector3<Scalar> sum = Vector3<Scalar>::Zero();
        for (int k = 0; k < Skin<Scalar>::influences; ++k)
            sum += skin.weights(v, k) * motions[static_cast<std::size_t>(skin.joints(v, k))](core::point(points, v));
        core::set_point<Scalar>(out, v, sum);
    }
    return out;
}

} // namespace skelgen::applications
