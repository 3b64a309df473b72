#pragma once

#include <skelgen/refinement/limbs.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include <skelgen/core/parallel.hpp>
#include <skelgen/embedding/reduced_graph.hpp>

namespace skelgen::refinement {
namespace detail {

/// The geodesic diameter of a body (toe to fingertip over the surface) as a part of the longest path along the bones of
/// its skeleton. Calibrated: mean over 50 adults in 10 poses each.
inline constexpr double diameter_of_longest_path = 0.92;

/// A section this much larger than the limb's own is no longer the limb's: it has run into the trunk, or into the other
/// leg (a thigh or an upper arm widens by half at most from its middle to its top).
template <typename Scalar>
inline constexpr Scalar attachment_growth = Scalar(1.7);

/// A limb is drawn this much beyond its first joint, in its own length, so that there are sections at that joint even
/// where the limb is a little longer than the template says. A working value, not a measured one.
template <typename Scalar>
inline constexpr Scalar drawn_length = Scalar(1.05);

/// Arc length where the limb leaves the trunk, looking inwards from `own` away from the tip; the reference is the mean
/// section over the `stretch` before that.
template <typename Scalar>
Scalar find_attachment(const Centreline<Scalar>& line, Scalar own, Scalar stretch) {
    const Eigen::Index last = line.arc.size() - 1;
    Scalar sum = 0, count = 0;
    for (Eigen::Index i = last; i >= 1; --i) {
        const Scalar from_tip = line.arc[last] - line.arc[i];
        if (line.area[i] <= 0 || from_tip < own - stretch) continue;
        if (from_tip <= own) {
            sum += line.area[i];
            count += 1;
        } else if (count > 0 && line.area[i] > attachment_growth<Scalar> * sum / count) {
            return line.arc[i + 1];
        }
    }
    return line.arc[0];
}

/// The limb's first bone is surely the limb's own up to its middle; nearer its outer joint, a folded elbow or knee
/// widens the sections. Three tenths of the bone, ending in its middle, are the reference.
template <typename Scalar>
Scalar attachment_of(const Limb<Scalar>& limb) {
    const Scalar top = limb.from_tip.front(), next = limb.from_tip.size() > 1 ? limb.from_tip[1] : 0;
    return find_attachment(limb.line, next + Scalar(0.5) * (top - next), Scalar(0.3) * (top - next));
}

/// The centreline from no farther than `length` from its last point on.
template <typename Scalar>
Centreline<Scalar> outer_part(const Centreline<Scalar>& line, Scalar length) {
    const Eigen::Index size = line.arc.size();
    Eigen::Index first = 0;
    while (first + 2 < size && line.arc[size - 1] - line.arc[first] > length) ++first;
    const Eigen::Index kept = size - first;
    return {line.points.bottomRows(kept), line.arc.tail(kept).array() - line.arc[first], line.thickness.tail(kept),
            line.area.tail(kept), line.flatness.tail(kept)};
}

/// The joints of the limb that `end` ends, outwards, without the one it branches off from.
inline std::vector<int> joints_up_to(const SkeletonTemplate& skeleton_template, int end) {
    std::vector<int> children(skeleton_template.joints.size(), 0);
    for (const TemplateJoint& joint : skeleton_template.joints)
        if (joint.parent >= 0) ++children[static_cast<std::size_t>(joint.parent)];
    std::vector<int> joints;
    for (int j = end; j >= 0 && (j == end || children[static_cast<std::size_t>(j)] == 1);
         j = skeleton_template.joint(j).parent)
        joints.push_back(j);
    std::reverse(joints.begin(), joints.end());
    return joints;
}

} // namespace detail

template <typename Scalar>
Scalar template_scale(const SkeletonTemplate& skeleton_template, Scalar geodesic_diameter) {
    return geodesic_diameter /
           static_cast<Scalar>(detail::diameter_of_longest_path * embedding::longest_path(skeleton_template));
}

template <typename Scalar>
Points<Scalar> ring_centres(const Slicer<Scalar>& slicer, const EndPoint<Scalar>& end, Scalar length, Scalar step) {
    const surface::LevelSets<Scalar> sets =
        slicer.level_sets(end.distance.cwiseMin(2 * length)); // finite where no path leads
    std::vector<Vector3<Scalar>> centres{slicer.mesh().vertices.row(end.vertex).transpose()};
    const int rings = static_cast<int>(std::ceil(length / step - Scalar(0.5)));
    for (int ring = rings; ring-- > 0;)
        if (const auto centre =
                level_set_centre<Scalar>(sets, length - static_cast<Scalar>(ring) * step, centres.back(), 2 * step))
            centres.push_back(*centre);
    Points<Scalar> out(static_cast<Eigen::Index>(centres.size()), 3);
    for (std::size_t i = 0; i < centres.size(); ++i)
        out.row(out.rows() - 1 - static_cast<Eigen::Index>(i)) = centres[i].transpose();
    return out;
}

template <typename Scalar>
Limb<Scalar> draw_limb(Limb<Scalar> limb, const Slicer<Scalar>& slicer, const EndPoint<Scalar>& end,
                       const CentrelineOptions& options) {
    const Scalar length = detail::drawn_length<Scalar> * limb.from_tip.front();
    // A first line through fewer rings than sections is straighter, and sooner drawn; a neck with its head is too
    // short.
    const bool is_long = limb.joints.size() > 2;
    const Scalar spacing = static_cast<Scalar>(is_long ? 2 * options.step : options.step);
    limb.line = draw_centreline(slicer, ring_centres(slicer, end, length, spacing), options);
    limb.attachment = detail::attachment_of(limb);
    return limb;
}

template <typename Scalar>
Limb<Scalar> shorten_line(Limb<Scalar> limb) {
    limb.line = detail::outer_part(limb.line, detail::drawn_length<Scalar> * limb.from_tip.front());
    limb.attachment = detail::attachment_of(limb);
    return limb;
}

template <typename Scalar>
std::vector<Limb<Scalar>> trace_limbs(const Slicer<Scalar>& slicer, const std::vector<EndPoint<Scalar>>& ends,
                                      const SkeletonTemplate& skeleton_template, Scalar scale,
                                      const CentrelineOptions& options) {
    std::vector<Limb<Scalar>> limbs(ends.size());
    for (std::size_t i = 0; i < limbs.size(); ++i) {
        const TemplateJoint& end = skeleton_template.joint(ends[i].joint);
        Limb<Scalar>& limb = limbs[i];
        limb.joints = detail::joints_up_to(skeleton_template, ends[i].joint);
        limb.from_tip.resize(limb.joints.size());
        double distance = end.tip ? (*end.tip - end.position).norm() : 0;
        for (std::size_t j = limb.joints.size(); j-- > 0;) {
            limb.from_tip[j] = scale * static_cast<Scalar>(distance);
            distance += rest_length(skeleton_template, limb.joints[j], skeleton_template.joint(limb.joints[j]).parent);
        }
    }
    // Long ones first: a thread that is done sooner draws the short ones.
    std::vector<std::size_t> order(limbs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return limbs[a].from_tip.front() > limbs[b].from_tip.front();
    });
    core::parallel_for(order.size(), 1, [&](std::size_t i) {
        Limb<Scalar>& limb = limbs[order[i]];
        limb = draw_limb(std::move(limb), slicer, ends[order[i]], options);
    });
    return limbs;
}

} // namespace skelgen::refinement
