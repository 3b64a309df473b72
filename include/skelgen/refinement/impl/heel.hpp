#pragma once

#include <cstddef>
#include <iterator>
#include <optional>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/refinement/bend.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/profile_matcher.hpp>

namespace skelgen::refinement {

namespace detail {

/// Points on either side of a heel's corner, with the corner itself: fewer show no line.
inline constexpr std::size_t least_points_of_line = 3;

/// A line through points, and the squares of their distances from it.
template <typename Scalar>
struct FittedLine {
    Vector3<Scalar> direction;
    Scalar misfit = 0;
};

template <typename Scalar>
FittedLine<Scalar> fit_line(const std::vector<Vector3<Scalar>>& points) {
    const Line<Scalar> line = core::principal_line(points);
    // The direction of the way along the points, not against it.
    const bool is_along = line.direction.dot(points.back() - points.front()) >= 0;
    FittedLine<Scalar> out{is_along ? line.direction : Vector3<Scalar>(-line.direction)};
    for (const Vector3<Scalar>& p : points) out.misfit += squared_distance_to(line, p);
    return out;
}

} // namespace detail

/// Where the centreline of a leg turns from the calf to the foot, whatever both look like and however long they are: at
/// the end of the first of the two lines, one after the other, that its points from the tip to the knee are nearest to.
/// Joints are where `rest` has them, roughly: most of the calf suffices. None where there are too few points, or
/// where it is straight, as on a body that stands on its toes. O(k^2) for k sections.
template <typename Scalar>
std::optional<Heel<Scalar>> find_heel(const Limb<Scalar>& limb, const Stretch<Scalar>& rest,
                                      const BendOptions& options = {}) {
    using Place = typename std::vector<Vector3<Scalar>>::difference_type;
    const Eigen::Index last = limb.line.arc.size() - 1;
    const Scalar end = limb.line.arc[last],
                 farthest = rest.middle - detail::folded_part<Scalar> * (rest.middle - rest.outer);
    std::vector<Vector3<Scalar>> points; // from the tip
    for (Eigen::Index i = last; i >= 0 && end - limb.line.arc[i] < farthest; --i)
        points.push_back(core::point(limb.line.points, i));
    if (points.size() + 1 < 2 * detail::least_points_of_line) return std::nullopt;

    const auto foot = [&](std::size_t i) {
        return detail::fit_line<Scalar>({points.begin(), std::next(points.begin(), static_cast<Place>(i + 1))});
    };
    const auto calf = [&](std::size_t i) {
        return detail::fit_line<Scalar>({std::next(points.begin(), static_cast<Place>(i)), points.end()});
    };
    constexpr std::size_t first = detail::least_points_of_line - 1;
    const std::size_t past = points.size() - first;
    std::vector<Scalar> misfits;
    std::size_t best = first;
    for (std::size_t i = first; i < past; ++i) {
        misfits.push_back(foot(i).misfit + calf(i).misfit);
        if (misfits.back() < misfits[best - first]) best = i;
    }
    Scalar corner = end - limb.line.arc[last - static_cast<Eigen::Index>(best)];
    const std::size_t at = best - first;
    if (at > 0 && at + 1 < misfits.size())
        corner += core::least_of_parabola(misfits[at - 1], misfits[at], misfits[at + 1]) *
                  (limb.line.arc[last] - limb.line.arc[last - 1]);
    const Scalar turned = detail::degrees_between(foot(best).direction, calf(best).direction);
    const Scalar bent =
        detail::smooth_step(static_cast<Scalar>(options.from), static_cast<Scalar>(options.full), turned);
    if (!(bent > 0)) return std::nullopt;
    return Heel<Scalar>{corner, bent};
}

} // namespace skelgen::refinement
