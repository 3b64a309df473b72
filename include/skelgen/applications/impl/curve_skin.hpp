#pragma once

#include <skelgen/applications/curve_skin.hpp>

#include <cstddef>
#include <limits>
#include <vector>

#include <skelgen/core/error.hpp>

namespace skelgen::applications {
namespace detail {

/// The mean weights of a region's vertices, one for each joint.
template <typename Scalar>
Eigen::RowVectorX<Scalar> mean_weights(const std::vector<int>& region, const Skin<Scalar>& skin, int joints) {
    Eigen::RowVectorX<Scalar> mean = Eigen::RowVectorX<Scalar>::Zero(joints);
    for (const int vertex : region) {
        if (vertex < 0 || vertex >= skin.weights.rows())
            throw Error(ErrorCode::usage, "the skin is not of the mesh that the curve skeleton was found in");
        for (int k = 0; k < Skin<Scalar>::influences; ++k) {
            if (skin.joints(vertex, k) < 0 || skin.joints(vertex, k) >= joints)
                throw Error(ErrorCode::usage, "the skin names a joint that the rig does not have");
            mean[skin.joints(vertex, k)] += skin.weights(vertex, k) / static_cast<Scalar>(region.size());
        }
    }
    return mean;
}

} // namespace detail

template <typename Scalar>
Skin<Scalar> curve_skin(const CurveSkeleton<Scalar>& curve, const Skin<Scalar>& skin, int joints) {
    if (curve.regions.size() != static_cast<std::size_t>(curve.nodes.rows()))
        throw Error(ErrorCode::usage, "the curve skeleton does not say which part of the surface its nodes stand for");
    const auto has_region = [&](Eigen::Index node) { return !curve.regions[static_cast<std::size_t>(node)].empty(); };
    Eigen::MatrixX<Scalar> weights(curve.nodes.rows(), joints);
    for (Eigen::Index i = 0; i < curve.nodes.rows(); ++i)
        weights.row(i) = detail::mean_weights(curve.regions[static_cast<std::size_t>(i)], skin, joints);
    for (Eigen::Index i = 0; i < curve.nodes.rows(); ++i) {
        if (has_region(i)) continue;
        Scalar least = std::numeric_limits<Scalar>::infinity();
        for (Eigen::Index other = 0; other < curve.nodes.rows(); ++other) {
            const Scalar distance = (curve.nodes.row(other) - curve.nodes.row(i)).squaredNorm();
            if (!has_region(other) || !(distance < least)) continue;
            least = distance;
            weights.row(i) = weights.row(other);
        }
        if (least == std::numeric_limits<Scalar>::infinity())
            throw Error(ErrorCode::usage, "no node of the curve skeleton has a region of the surface");
    }
    return strongest_influences(weights);
}

} // namespace skelgen::applications
