#pragma once

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::curve {

/// A piece of a curve between two knots.
template <typename Scalar = double>
struct Branch {
    int from = 0, to = 0;     ///< knots; the same on a ring
    Points<Scalar> line;      ///< k x 3, k >= 2, both knots included
    std::vector<int> origins; ///< the branches and knots that it comes from, see split_branches; ascending
};

/// A curve as branches between its ends and junctions: what moves a curve's nodes or their number works on this.
template <typename Scalar = double>
struct BranchedCurve {
    std::vector<Vector3<Scalar>> knots; ///< ends and junctions, one node of each ring that has none; some may be unused
    std::vector<Branch<Scalar>> branches;

    /// Per knot how many branches end there.
    [[nodiscard]] std::vector<int> degrees() const {
        std::vector<int> out(knots.size(), 0);
        for (const Branch<Scalar>& branch : branches) {
            ++out[static_cast<std::size_t>(branch.from)];
            ++out[static_cast<std::size_t>(branch.to)];
        }
        return out;
    }
};

/// Per knot of a curve a place, for those that have one.
template <typename Scalar = double>
using PlacesOfKnots = std::vector<std::optional<Vector3<Scalar>>>;

/// A curve taken apart, and what becomes of its nodes: the number of their knot, or that of their branch and the number
/// of knots added. A branch's origins are these numbers of its inner nodes and its knots.
template <typename Scalar = double>
struct SplitCurve {
    BranchedCurve<Scalar> branched;
    std::vector<int> origin_of_node;
};

/// O(k).
template <typename Scalar>
[[nodiscard]] SplitCurve<Scalar> split_branches(const CurveSkeleton<Scalar>& curve);

/// The same branches with points evenly spaced by about `spacing`; a ring keeps three edges, any other branch two, so
/// that branches between the same knots stay apart. O(k).
template <typename Scalar>
[[nodiscard]] BranchedCurve<Scalar> resampled(BranchedCurve<Scalar> curve, std::type_identity_t<Scalar> spacing);

/// The same branch the other way round. O(k).
template <typename Scalar>
[[nodiscard]] Branch<Scalar> turned(Branch<Scalar> branch);

/// The same curve with the two branches of a knot joined into one; as it is where the knot has another number of
/// branches, or they end at the same knot as they begin. O(branches + k).
template <typename Scalar>
[[nodiscard]] BranchedCurve<Scalar> without_knot(BranchedCurve<Scalar> curve, int knot);

/// What either branch comes from, ascending.
[[nodiscard]] inline std::vector<int> united_origins(std::vector<int> a, const std::vector<int>& b) {
    a.insert(a.end(), b.begin(), b.end());
    std::sort(a.begin(), a.end());
    a.erase(std::unique(a.begin(), a.end()), a.end());
    return a;
}

/// Nodes and edges; the nodes of each branch's line, in order, and those of the knots that are used. Regions are empty,
/// radii missing.
template <typename Scalar = double>
struct JoinedCurve {
    CurveSkeleton<Scalar> curve;
    std::vector<std::vector<int>> nodes_of_branch; ///< as many as its line has points
};

/// O(k log k).
template <typename Scalar>
[[nodiscard]] JoinedCurve<Scalar> join_branches(const BranchedCurve<Scalar>& branched);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/branched_curve.hpp>
#endif
