#pragma once

#include <algorithm>
#include <utility>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/curve/branched_curve.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

namespace detail {

/// Nearer to each other than this part of the radius around them, two branches are one.
template <typename Scalar>
inline constexpr Scalar side_by_side = Scalar(0.5);

/// How many points from their first one on two lines run side by side; 0 when that is over less than the radius there.
template <typename Scalar>
Eigen::Index shared_points(const Points<Scalar>& a, const Points<Scalar>& b, const Body<Scalar>& body) {
    const Eigen::Index most = std::min(a.rows(), b.rows()) - 1;
    Eigen::Index shared = 0;
    Scalar length = 0;
    const auto middle = [&](Eigen::Index i) -> Vector3<Scalar> { return (core::point(a, i) + core::point(b, i)) / 2; };
    for (Eigen::Index i = 1; i < most; ++i) {
        const Vector3<Scalar> p = core::point(a, i), q = core::point(b, i);
        const Scalar apart = (p - q).norm(), least = apart / side_by_side<Scalar>;
        if (!(apart < side_by_side<Scalar> * body.tree.distance(body.mesh, middle(i), 2 * least))) break;
        length += (p - core::point(a, i - 1)).norm();
        shared = i;
    }
    return shared > 0 && length > body.tree.distance(body.mesh, middle(shared)) ? shared : 0;
}

/// One pair merged; whether there was one.
template <typename Scalar>
bool merge_one_pair(BranchedCurve<Scalar>& curve, const Body<Scalar>& body) {
    const std::vector<int> degrees = curve.degrees();
    for (std::size_t i = 0; i < curve.branches.size(); ++i)
        for (std::size_t j = i + 1; j < curve.branches.size(); ++j)
            for (int side = 0; side < 4; ++side) {
                const auto start = [&](std::size_t k, int bit) {
                    return side & bit ? curve.branches[k].to : curve.branches[k].from;
                };
                if (start(i, 1) != start(j, 2)) continue;
                Branch<Scalar> a = curve.branches[i], b = curve.branches[j];
                if (side & 1) a = turned(std::move(a));
                if (side & 2) b = turned(std::move(b));
                const int knot = a.from;
                if (a.to == knot || b.to == knot || a.to == b.to || degrees[static_cast<std::size_t>(knot)] < 3)
                    continue;
                const Eigen::Index shared = shared_points(a.line, b.line, body);
                if (shared == 0) continue;
                const int parting = static_cast<int>(curve.knots.size());
                Branch<Scalar> trunk{knot, parting, (a.line.topRows(shared + 1) + b.line.topRows(shared + 1)) / 2,
                                     united_origins(a.origins, b.origins)};
                curve.knots.push_back(core::point(trunk.line, shared));
                for (Branch<Scalar>* branch : {&a, &b}) {
                    branch->from = parting;
                    branch->line = branch->line.bottomRows(branch->line.rows() - shared).eval();
                    branch->line.row(0) = trunk.line.row(shared);
                }
                curve.branches[i] = std::move(a);
                curve.branches[j] = std::move(b);
                curve.branches.push_back(std::move(trunk));
                if (degrees[static_cast<std::size_t>(knot)] == 3) curve = without_knot(std::move(curve), knot);
                return true;
            }
    return false;
}

} // namespace detail

/// Branches that leave a junction side by side become one up to where they part, which is their junction then: as long
/// as they are nearer to each other than half the radius of the ball inside the surface there, and over more than that
/// radius. Lines must be evenly spaced. O(k) distances to the surface.
template <typename Scalar>
BranchedCurve<Scalar> merge_parallel_branches(BranchedCurve<Scalar> branched, const Body<Scalar>& body) {
    while (detail::merge_one_pair(branched, body)) {
    }
    return branched;
}

} // namespace skelgen::curve
