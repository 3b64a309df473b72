#pragma once

#include <skelgen/curve/find_curve.hpp>

#include <utility>

#include <skelgen/core/header_only.hpp>
#include <skelgen/curve/centring.hpp>
#include <skelgen/curve/limb_ends.hpp>
#include <skelgen/curve/regions.hpp>

namespace skelgen::curve {

SKELGEN_INLINE void validate(const CurveOptions& options) {
    validate(options.proxy);
    validate(options.contraction);
    validate(options.surgery);
    validate(options.leaves);
    validate(options.pruning);
}

template <typename Scalar>
CurveResult<Scalar> find_curve(const Body<Scalar>& body, const CurveOptions& options) {
    validate(options); // all at once, before the first step takes its time

    const Proxy<Scalar> proxy = build_proxy(body.mesh, options.proxy);
    const Contraction<Scalar> thin = contract(proxy.mesh, options.contraction);

    CurveSkeleton<Scalar> curve = connectivity_surgery(thin.vertices, proxy.mesh.faces, options.surgery);
    curve = centre_nodes(curve, proxy.mesh, thin.vertices);
    curve = spread_regions(curve, proxy, body);
    curve = extend_leaves(curve, body, options.leaves);
    curve = prune(curve, options.pruning);
    curve = place_limb_ends(curve, body.mesh);
    return {std::move(curve), thin.converged, thin.iterations, thin.volume_ratio};
}

} // namespace skelgen::curve
