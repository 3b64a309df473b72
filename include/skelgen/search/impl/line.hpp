#pragma once

#include <skelgen/search/line.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <skelgen/anatomy/complete.hpp>
#include <skelgen/core/geodesics.hpp>
#include <skelgen/core/stopwatch.hpp>
#include <skelgen/core/template_rules.hpp>
#include <skelgen/refinement/end_points.hpp>
#include <skelgen/refinement/refine.hpp>
#include <skelgen/search/trust.hpp>
#include <skelgen/symmetry/sides.hpp>

namespace skelgen::search {

template <typename Scalar>
PlacedJoints<Scalar>
place_joints(const Body<Scalar>& body, const curve::CurveResult<Scalar>& found, const embedding::LaidTemplate& laid,
             const std::vector<refinement::EndPoint<Scalar>>& ends, const ExtractOptions& options) {
    const SkeletonTemplate& wanted = laid.skeleton_template;
    return {wanted,
            refinement::refine(body, ends, found.curve, laid.embedding, wanted, options.refinement),
            &laid.embedding,
            refinement::geodesic_diameter(ends),
            {}};
}

template <typename Scalar>
PlacedJoints<Scalar> place_joints(const Body<Scalar>& body, const RestFit<Scalar>& fit, const ExtractOptions& options) {
    using enum JointRole;
    const SkeletonTemplate& wanted = fit.skeleton_template;
    const auto ends = refinement::find_end_points(body, fit.lines, fit.embedding, wanted);
    refinement::RefinedJoints<Scalar> joints =
        refinement::refine(body, ends, fit.lines, fit.embedding, wanted, options.refinement);
    for (std::size_t j = 0; j < wanted.joints.size(); ++j) {
        const JointRole role = wanted.joints[j].role;
        const bool is_known = std::find(fit.known.begin(), fit.known.end(), static_cast<int>(j)) != fit.known.end();
        if (!is_known && joints.is_present[j] && (role == wrist || role == hand || role == ankle || role == foot))
            continue;
        joints.positions.row(static_cast<Eigen::Index>(j)) = fit.joints.positions.row(static_cast<Eigen::Index>(j));
    }
    const double cost = std::log(std::max(fit.cost, 1e-3));
    return {wanted,
            std::move(joints),
            nullptr,
            core::geodesic_diameter(body.graph),
            {{Witness::fitted, 1}, {Witness::fit_cost, cost}}};
}

template <typename Scalar>
PlacedJoints<Scalar> place_joints(const Body<Scalar>& body, const PosedFit& fit, Scalar diameter) {
    refinement::RefinedJoints<Scalar> joints;
    joints.positions = fit.joints.template cast<Scalar>();
    joints.is_present.assign(fit.skeleton_template.joints.size(), true);
    for (const auto& [joint, tip] : fit.tips) {
        const int vertex = body.tree.nearest_corner(body.mesh, Vector3<Scalar>(tip.template cast<Scalar>()));
        joints.tips.emplace_back(joint, core::point(body.mesh.vertices, vertex));
    }
    return {fit.skeleton_template,
            std::move(joints),
            nullptr,
            diameter,
            {{Witness::fitted, 1}, {Witness::fit_cost, std::log(std::max(fit.cost, 1e-3))}, {Witness::posed, 1}}};
}

template <typename Scalar>
Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>& body, const curve::CurveResult<Scalar>& found,
                                       const PlacedJoints<Scalar>& placed) {
    core::Stopwatch stage;
    const SkeletonTemplate& wanted = placed.skeleton_template;
    const auto sides = symmetry::decide_sides(placed.joints, wanted,
                                              symmetry::front_of_surface(body, placed.joints, wanted, placed.vertices));
    if (!sides) return sides.failure();
    auto completed =
        anatomy::complete_skeleton(symmetry::assemble(placed.joints, wanted, *sides), body, found.curve, wanted);
    Candidate<Scalar> out;
    out.geodesic_diameter = placed.geodesic_diameter;
    out.evidence = evidence_of(body, found.curve, placed.embedding, completed, wanted, placed.geodesic_diameter);
    for (const auto& [witness, value] : placed.evidence) out.evidence[witness] = value;
    out.probability = probability_right(out.evidence);
    out.skeleton = std::move(completed.skeleton);
    out.doubt = std::move(completed.doubt);
    out.sides = sides->evidence;
    out.timings.sides = stage.lap();
    if (!placed.embedding) return out;
    out.skeleton.quality.matched_nodes = placed.embedding->matched_nodes;
    if (!placed.embedding->is_least)
        out.skeleton.quality.warnings.push_back(
            "the curve skeleton has too many branches to try all matches: limbs may be mistaken");
    return out;
}

template <typename Scalar>
Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>& body, const curve::CurveResult<Scalar>& found,
                                       const embedding::LaidTemplate& laid, const ExtractOptions& options) {
    if (found.is_point) return too_compact();
    core::Stopwatch stage;
    const auto ends = refinement::find_end_points(body, found.curve, laid.embedding, laid.skeleton_template);
    const auto placed = place_joints(body, found, laid, ends, options);
    const double refine_time = stage.lap();
    auto out = skeleton_of(body, found, placed);
    if (out) out->timings.refine = refine_time;
    return out;
}

template <typename Scalar>
Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>& body, const curve::CurveResult<Scalar>& found,
                                       const SkeletonTemplate& skeleton_template, const ExtractOptions& options) {
    validate(options);
    validate_template(skeleton_template);
    core::Stopwatch stage;
    if (found.is_point) return too_compact();
    const auto embedding = embedding::embed(found.curve, skeleton_template, options.matching);
    if (!embedding) return embedding.failure();
    const double embedding_time = stage.lap();
    auto out = skeleton_of(body, found, embedding::LaidTemplate{skeleton_template, *embedding}, options);
    if (out) out->timings.embed = embedding_time;
    return out;
}

} // namespace skelgen::search
