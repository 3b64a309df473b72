#pragma once

#include <skelgen/applications/resting_surface.hpp>

#include <skelgen/applications/skinning.hpp>

namespace skelgen::applications {

template <typename Scalar>
Points<Scalar> at_rest(const RestingSurface<Scalar>& surface, const JointWeights& weights,
                       const std::vector<int>& rows) {
    const JointWeights own = weights(rows, Eigen::all);
    return skinned<Scalar>(surface.as_is(rows, Eigen::all), strongest_influences<Scalar>(own.cast<Scalar>()),
                           surface.motions);
}

template <typename Scalar>
Points<Scalar> at_rest(const RestingSurface<Scalar>& surface, const JointWeights& weights) {
    return skinned<Scalar>(surface.as_is, strongest_influences<Scalar>(weights.cast<Scalar>()), surface.motions);
}

} // namespace skelgen::applications
