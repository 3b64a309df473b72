#pragma once

#include <skelgen/curve/find_curve.hpp>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/curve/impl/centring.hpp>
#include <skelgen/curve/impl/regions.hpp>
#include <skelgen/curve/impl/section_regions.hpp>

namespace skelgen::curve {

SKELGEN_INLINE void validate(const CurveOptions& options) {
    validate(options.proxy);
    validate(options.contraction);
    validate(options.surgery);
    validate(options.leaves);
    validate(options.pruning);
    validate(options.centring);
}

namespace detail {

/// The numbers of a level of detail. Fingers are resolved by edges of a centimetre on an adult, 20 thousand vertices;
/// their lengths are a twentieth of the longest way along the curve.
inline CurveOptions at_detail(CurveOptions options) {
    if (options.detail == Detail::limbs) return options;
    const bool all = options.detail == Detail::all;
    options.proxy.vertices = 20'000;
    options.pruning = all ? PruningOptions{0, 0} : pruning_for_digits;
    options.centring.least_relief = all ? 0.25 : 0.5;
    return options;
}

/// A contraction that does not come to its end draws limbs in: it begins again, held more firmly to the balls inside.
template <typename Scalar>
Contraction<Scalar> contract_to_the_end(const TriangleMesh<Scalar>& proxy, ContractionOptions options) {
    constexpr int starts = 3;
    constexpr double firmer = 5;
    const MedialBalls<Scalar> balls = contraction_balls(proxy, options);
    Contraction<Scalar> thin = contract(proxy, balls, options);
    for (int start = 1; start < starts && !thin.converged && options.iterations > 1; ++start) {
        options.medial_weight = std::max(options.medial_weight, 1.0) * firmer;
        thin = contract(proxy, balls, options);
    }
    return thin;
}

/// How much longer than the ball in it is thick a thing is at least that has a curve: up to an egg, it has a centre.
template <typename Scalar>
inline constexpr Scalar least_elongation = Scalar(1.3);

/// The curve of what is too compact for one: its centre of volume, or of the surface where it encloses nothing.
template <typename Scalar>
CurveSkeleton<Scalar> centre_point(const Body<Scalar>& body) {
    using core::Accumulator;
    Vector3<Accumulator> by_volume = Vector3<Accumulator>::Zero();
    Accumulator volume = 0;
    for (Eigen::Index f = 0; f < body.mesh.faces.rows(); ++f) {
        Vector3<Accumulator> sum = Vector3<Accumulator>::Zero();
        for (int k = 0; k < 3; ++k)
            sum += core::point(body.mesh.vertices, body.mesh.faces(f, k)).template cast<Accumulator>();
        const Vector3<Scalar> area = core::face_area_vector(body.mesh, f);
        const auto part =
            static_cast<Accumulator>(area.dot(core::point(body.mesh.vertices, body.mesh.faces(f, 0)))) / 3;
        by_volume += part / 4 * sum; // the centre of the tetrahedron over the face, whose fourth corner is the origin
        volume += part;
    }
    CurveSkeleton<Scalar> out;
    const Vector3<Accumulator> centre =
        volume > 0 ? Vector3<Accumulator>(by_volume / volume) : Vector3<Accumulator>::Zero();
    out.nodes = centre.template cast<Scalar>().transpose();
    out.radii = {body.tree.distance(body.mesh, core::point(out.nodes, 0))};
    out.regions.resize(1);
    for (int v = 0; v < static_cast<int>(body.mesh.vertices.rows()); ++v) out.regions[0].push_back(v);
    return out;
}

/// Is the curve no longer than the thing is thick?
template <typename Scalar>
bool is_compact(const CurveSkeleton<Scalar>& curve) {
    if (curve.nodes.rows() < 2) return true;
    if (core::cycle_count(curve) > 0) return false;
    const Scalar length = core::curve_diameter(core::curve_graph(curve));
    return length < 2 * least_elongation<Scalar> * *std::max_element(curve.radii.begin(), curve.radii.end());
}

/// What is too compact for a curve as a point.
template <typename Scalar>
CurveResult<Scalar> or_point(CurveResult<Scalar> found, const Body<Scalar>& body) {
    found.is_point = is_compact(found.curve);
    if (found.is_point) found.curve = centre_point(body);
    return found;
}

/// The last two steps, roughly.
template <typename Scalar>
CurveResult<Scalar> drafted(CurveResult<Scalar> found, const Body<Scalar>& body) {
    const auto& [branched, origin, centring] = *found.contracted;
    found.curve = join_branches(centre_roughly(branched, body, centring)).curve;
    found.curve.radii = ball_radii(found.curve.nodes, body);
    return or_point(std::move(found), body);
}

} // namespace detail

template <typename Scalar>
CurveResult<Scalar> find_curve(const Body<Scalar>& body, const CurveOptions& wanted) {
    validate(wanted); // all at once, before the first step takes its time
    const CurveOptions options = detail::at_detail(wanted);

    const Proxy<Scalar> proxy = build_proxy(body.mesh, options.proxy);
    Contraction<Scalar> thin;
    CurveSkeleton<Scalar> curve;
    const auto contract_proxy = [&] {
        thin = detail::contract_to_the_end(proxy.mesh, options.contraction);
        curve = connectivity_surgery(thin.vertices, proxy.mesh.faces, options.surgery);
        curve = centre_nodes(curve, proxy.mesh, thin.vertices);
    };
    std::vector<int> nearest;
    core::in_parallel(contract_proxy, [&] { nearest = nearest_of_proxy(proxy, body); });
    curve = spread_regions(std::move(curve), nearest, proxy);
    curve = extend_leaves(curve, body, options.leaves);
    curve = prune(curve, options.pruning);

    SplitCurve<Scalar> split = split_branches(curve);
    std::vector<int> origin = node_of_vertex(curve, body.mesh.vertices.rows());
    for (int& node : origin) node = split.origin_of_node[static_cast<std::size_t>(node)];
    CurveResult<Scalar> found;
    found.converged = thin.converged;
    found.iterations = thin.iterations;
    found.volume_ratio = thin.volume_ratio;
    found.contracted = std::make_shared<const ContractedCurve<Scalar>>(
        ContractedCurve<Scalar>{std::move(split.branched), std::move(origin), options.centring});
    found.is_draft = true; // until it is finished
    return options.is_draft ? detail::drafted(std::move(found), body) : finished(std::move(found), body);
}

template <typename Scalar>
CurveResult<Scalar> finished(CurveResult<Scalar> found, const Body<Scalar>& body) {
    if (!found.is_draft) return found;
    const auto& [branched, origin, centring] = *found.contracted;
    found.curve = curve_with_regions(centre_branches(branched, body, centring), body, origin);
    found.is_draft = false;
    return detail::or_point(std::move(found), body);
}

} // namespace skelgen::curve
