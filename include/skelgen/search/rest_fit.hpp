#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/refinement/refine.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::search {

/// A plane in which a surface mirrors itself, in the body's coordinates: points p with normal . p = offset.
struct MirrorPlane {
    Vector3<double> normal = Vector3<double>::UnitX(); ///< unit, either way
    double offset = 0;
    double share = 0; ///< of the surface that has another part of it, to 2 % of its extent, where the plane mirrors it
};

/// The planes in which a body's surface mirrors itself, at least a third of it: those of its principal axes, and of
/// pairs of places, each brought to where most of the surface mirrors itself by iterative closest points. The best
/// first, at most three. O(n log n).
template <typename Scalar>
[[nodiscard]] std::vector<MirrorPlane> mirror_planes(const Body<Scalar>& body);

/// A joint of a template whose place is known; which, the caller says in which coordinates.
struct KnownPlace {
    int joint = 0;
    Vector3<double> place = Vector3<double>::Zero();
};

/// A body at rest, laid into a surface.
template <typename Scalar = double>
struct RestFit {
    SkeletonTemplate skeleton_template;       ///< the given one with the proportions that were found
    refinement::RefinedJoints<Scalar> joints; ///< in the body's coordinates; left is on the side of the plane's normal
    CurveSkeleton<Scalar> lines;              ///< the model's axes as a curve without regions: what limbs are traced by
    embedding::Embedding embedding;           ///< of the template in them
    std::vector<int> known; ///< joints whose places were known, on both sides: no cross-section tells better
    double cost = 0;        ///< how badly the surface is explained: mean over its places, robust; 0 best
    double mirror = 0;      ///< the plane's share
};

/// Lays a jointed model, mirrored in a plane, into a surface: a person who stands at rest, arms anywhere between level
/// and hanging, legs apart or together, of any proportions. Head, trunk, arms, legs and feet are cones with round ends
/// whose ends and radii (23 numbers) are brought by Levenberg and Marquardt's method to where the surface's places lie
/// on them and their axes in its middle, both robust against what the body wears and holds, with a broad prior; from
/// several proportions and directions of the arms, either way up. This finds what a curve skeleton does not show: arms
/// that are drawn into a flank, legs under a robe, necks between large heads and shoulders. \returns the best fit, or
/// none where the surface mirrors itself in no plane or `wanted` lacks a limb. `known`: places in the body's
/// coordinates that the model's joints have to have, on whichever side. O(n log n), and some ten thousand distances to
/// the surface.
template <typename Scalar>
[[nodiscard]] std::optional<RestFit<Scalar>> fit_at_rest(const Body<Scalar>& body, const SkeletonTemplate& wanted,
                                                         const std::vector<KnownPlace>& known = {});

} // namespace skelgen::search

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/search/impl/rest_fit.hpp>
#endif
