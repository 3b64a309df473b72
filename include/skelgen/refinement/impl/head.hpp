#pragma once

#include <skelgen/refinement/head.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include <skelgen/core/geometry.hpp>

namespace skelgen::refinement {
namespace detail {

/// Where an adult's throat is below the top of the head, as a part of the distance from the neck joint to the top.
/// Calibrated on 50 registered bodies.
template <typename Scalar>
inline constexpr Scalar adult_throat = Scalar(0.82);

/// How long an adult's head is from front to back, as a part of the same. Calibrated on the same bodies.
template <typename Scalar>
inline constexpr Scalar adult_length = Scalar(0.92);

/// Depth below the top of the head, in the same unit, from which on slices are under the skull's widest part, so that a
/// smaller one may be the throat's. A working value, not a measured one, as are the next three.
template <typename Scalar>
inline constexpr Scalar under_skull = Scalar(0.4);

/// Depth from which on a slice with a turned axis may be that of the shoulders.
template <typename Scalar>
inline constexpr Scalar near_shoulders = Scalar(0.7);

/// Depth below which no throat is looked for.
template <typename Scalar>
inline constexpr Scalar deepest_slice = Scalar(2.5);

/// How far from the last slice's centre the next slice may be that does not enclose it, in the same unit.
template <typename Scalar>
inline constexpr Scalar slice_reach = Scalar(0.5);

/// Cosine of the angle from which on a slice's longer axis counts as turned. A working value: 60 of RB12's 90 degrees.
template <typename Scalar>
inline constexpr Scalar turned_cosine = Scalar(0.5);

/// Fewer slices than this are no head's: its front would be told from less than a quarter of it.
inline constexpr std::size_t least_slices = 5;

/// A head whose slices' variance along the longer diameter is not this many times that along the shorter one is round.
template <typename Scalar>
inline constexpr Scalar least_oval = Scalar(1.02);

/// What it weighs as a sign of the head's front how far its slices' centres move forward from top to bottom. A working
/// value.
template <typename Scalar>
inline constexpr Scalar jaw_weight = Scalar(0.25);

/// What it weighs how egg-shaped slices are, which is a far smaller length. A working value.
template <typename Scalar>
inline constexpr Scalar egg_weight = Scalar(4);

/// How many times thicker than the throat what is above and below it must be. A working value.
template <typename Scalar>
inline constexpr Scalar clearly_thicker = Scalar(1.15);

/// How far below the head's centroid the throat is looked for, in the distance from the neck joint to the top of the
/// head. A working value, as is the next one.
template <typename Scalar>
inline constexpr Scalar throat_search = Scalar(1.5);

/// How far below the head's centroid sections are still the head's, in the same unit.
template <typename Scalar>
inline constexpr Scalar head_below_centroid = Scalar(0.3);

/// One slice of a head: its contour and the axes of that, longer one first.
template <typename Scalar>
struct Slice {
    CrossSection<Scalar> section;
    Vector3<Scalar> centre; ///< of the contour
    Vector3<Scalar> major, minor;
    Scalar diameter = 0; ///< extent along `major`
};

/// Length-weighted mean and covariance of contours.
template <typename Scalar>
struct ContourMoments {
    Scalar weight = 0;
    Vector3<Scalar> first = Vector3<Scalar>::Zero();
    Eigen::Matrix3<Scalar> second = Eigen::Matrix3<Scalar>::Zero();

    void add(const CrossSection<Scalar>& section, const Vector3<Scalar>& origin) {
        const Eigen::Index n = section.points.rows();
        for (Eigen::Index i = 0; i < n; ++i) {
            const Vector3<Scalar> middle =
                (core::point(section.points, i) + core::point(section.points, (i + 1) % n)) / 2 - origin;
            weight += section.lengths[i];
            first += section.lengths[i] * middle;
            core::add_outer_product<Scalar>(second, section.lengths[i], middle);
        }
    }
    [[nodiscard]] Vector3<Scalar> mean() const { return first / weight; }
    [[nodiscard]] Eigen::Matrix3<Scalar> covariance() const {
        Eigen::Matrix3<Scalar> out = second / weight;
        core::add_outer_product<Scalar>(out, -1, mean());
        return out;
    }
};

template <typename Scalar>
Scalar extent_along(const CrossSection<Scalar>& section, const Vector3<Scalar>& direction) {
    const Eigen::VectorX<Scalar> along = section.points * direction;
    return along.maxCoeff() - along.minCoeff();
}

template <typename Scalar>
std::optional<Slice<Scalar>> cut_slice(const Slicer<Scalar>& slicer, const Vector3<Scalar>& point,
                                       const Vector3<Scalar>& up, Scalar reach) {
    auto section = slicer.around(point, up, reach);
    if (!section) return std::nullopt;
    Slice<Scalar> out{std::move(*section), {}, {}, {}, 0};
    ContourMoments<Scalar> moments;
    moments.add(out.section, point);
    out.centre = point + moments.mean();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3<Scalar>> axes(moments.covariance());
    out.major = axes.eigenvectors().col(2);
    out.minor = up.cross(out.major).normalized();
    out.diameter = extent_along(out.section, out.major);
    return out;
}

/// Slices from the top down to the throat; the last one is the throat's, the others are the head's.
template <typename Scalar>
std::vector<Slice<Scalar>> slices_of(const Slicer<Scalar>& slicer, const Vector3<Scalar>& top,
                                     const Vector3<Scalar>& neck, const Vector3<Scalar>& up,
                                     const HeadOptions& options) {
    const Scalar height = (top - neck).dot(up), step = static_cast<Scalar>(options.slice) * height;
    std::vector<Slice<Scalar>> slices;
    Scalar largest = 0;
    Vector3<Scalar> at = top - step * up;
    for (Scalar depth = step; depth < deepest_slice<Scalar> * height; depth += step, at -= step * up) {
        auto slice = cut_slice(slicer, at, up, Scalar(slice_reach<Scalar> * height));
        if (!slice) break;
        at = slice->section.centroid; // follow the head, not the plumb line
        // RB12's rules: shrunk markedly from the largest slice, or the longer axis turned from along the head to across
        // the shoulders. Both only below the skull's widest part.
        const bool throat =
            depth > under_skull<Scalar> * height && slice->diameter < static_cast<Scalar>(options.throat) * largest;
        const bool turned = depth > near_shoulders<Scalar> * height && !slices.empty() && slice->diameter > largest &&
                            std::abs(slice->major.dot(slices[slices.size() / 2].major)) < turned_cosine<Scalar>;
        largest = std::max(largest, slice->diameter);
        slices.push_back(std::move(*slice));
        if (throat || turned) break;
    }
    return slices;
}

/// How far slices reach from their centres, all around.
template <typename Scalar>
Scalar largest_radius(const std::vector<Slice<Scalar>>& slices) {
    Scalar squared = 0;
    for (std::size_t i = 0; i + 1 < slices.size(); ++i)
        squared = std::max(
            squared,
            (slices[i].section.points.rowwise() - slices[i].centre.transpose()).rowwise().squaredNorm().maxCoeff());
    return std::sqrt(squared);
}

/// How clearly the head faces `head.forward` (positive) or away (negative). Two signs: under the skull the jaw lies to
/// the front, so that slices' centres move forward from top to bottom; and slices are egg-shaped, narrower at the
/// front.
template <typename Scalar>
Scalar head_frontness(const std::vector<Slice<Scalar>>& slices, const HeadShape<Scalar>& head) {
    Scalar egg = 0, perimeter = 0, n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i + 1 < slices.size(); ++i) {
        const CrossSection<Scalar>& section = slices[i].section;
        egg += section.perimeter * egg_shape(section, head.forward);
        perimeter += section.perimeter;
        const Scalar depth = static_cast<Scalar>(i + 1) / static_cast<Scalar>(slices.size());
        const Scalar centre = slices[i].centre.dot(head.forward);
        n += 1;
        x += depth;
        y += centre;
        xx += depth * depth;
        xy += depth * centre;
    }
    const Scalar jaw = (n * xy - x * y) / (n * xx - x * x);
    return (jaw_weight<Scalar> * jaw + egg_weight<Scalar> * egg / perimeter) / head.length;
}

/// The thinnest section below the middle of the head and above shoulders or chest, found in steps of `step`.
template <typename Scalar>
std::optional<Vector3<Scalar>> find_throat(const Slicer<Scalar>& slicer, const HeadShape<Scalar>& head, Scalar height,
                                           Scalar step) {
    Scalar head_thickness = 0, thinnest = 0;
    std::optional<Vector3<Scalar>> throat;
    Vector3<Scalar> at = head.centroid;
    for (Scalar depth = 0; depth < throat_search<Scalar> * height; depth += step, at -= step * head.up) {
        const auto section = slicer.around(at, head.up, slice_reach<Scalar> * height);
        if (!section) break;
        at = section->centroid;
        if (depth < head_below_centroid<Scalar> * height) head_thickness = std::max(head_thickness, section->thickness);
        if (!throat || section->thickness < thinnest) {
            throat = at;
            thinnest = section->thickness;
        } else if (section->thickness > clearly_thicker<Scalar> * thinnest &&
                   head_thickness > clearly_thicker<Scalar> * thinnest) {
            return throat;
        }
    }
    return std::nullopt;
}

} // namespace detail

template <typename Scalar>
std::optional<HeadShape<Scalar>> measure_head(const Slicer<Scalar>& slicer, const Vector3<Scalar>& top,
                                              const Vector3<Scalar>& neck, const HeadOptions& options) {
    HeadShape<Scalar> out;
    out.up = (top - neck).normalized();
    std::vector<detail::Slice<Scalar>> slices;
    for (int round = 0; round < 2;
         ++round) { // the top of the head says roughly where up is, its centroid says it better
        slices = detail::slices_of(slicer, top, neck, out.up, options);
        if (slices.size() < detail::least_slices) return std::nullopt;
        Vector3<Scalar> sum = Vector3<Scalar>::Zero();
        Scalar weight = 0;
        for (std::size_t i = 0; i + 1 < slices.size(); ++i) {
            sum += slices[i].section.perimeter * slices[i].centre;
            weight += slices[i].section.perimeter;
        }
        out.centroid = sum / weight;
        if (round == 0) out.up = (out.centroid - neck).normalized();
    }

    detail::ContourMoments<Scalar> moments;
    for (std::size_t i = 0; i + 1 < slices.size(); ++i) moments.add(slices[i].section, slices[i].centre);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3<Scalar>> axes(moments.covariance());
    const Scalar longer = axes.eigenvalues()[2], shorter = axes.eigenvalues()[1];
    const bool is_round = !(longer > detail::least_oval<Scalar> * shorter);
    out.forward = axes.eigenvectors().col(2);
    out.forward = (out.forward - out.forward.dot(out.up) * out.up).normalized();
    const Vector3<Scalar> side = out.up.cross(out.forward);
    for (std::size_t i = 0; i + 1 < slices.size(); ++i) {
        out.length = std::max(out.length, detail::extent_along(slices[i].section, out.forward));
        out.breadth = std::max(out.breadth, detail::extent_along(slices[i].section, side));
    }
    out.frontness = detail::head_frontness(slices, out);
    if (out.frontness < 0) {
        out.forward = -out.forward;
        out.frontness = -out.frontness;
    }
    if (is_round) { // its axes may point anywhere
        out.length = out.breadth = 2 * detail::largest_radius(slices);
        out.frontness = 0;
    }

    const Scalar height = (top - neck).norm();
    if (out.length > static_cast<Scalar>(options.longest) * height) return std::nullopt;
    const Scalar throat = (top - slices.back().centre).dot(out.up) / height;
    out.size = std::min(throat / detail::adult_throat<Scalar>, out.length / (detail::adult_length<Scalar> * height));
    out.throat = detail::find_throat(slicer, out, height, Scalar(static_cast<Scalar>(options.slice) / 2 * height));
    out.joint = out.centroid;
    if (is_round) return out;
    std::size_t nose = 0;
    Scalar farthest = 0;
    for (std::size_t i = 0; i + 1 < slices.size(); ++i) {
        const Scalar reach = (slices[i].section.points * out.forward).maxCoeff() - out.centroid.dot(out.forward);
        if (reach > farthest) {
            farthest = reach;
            nose = i;
        }
    }
    const Scalar nose_height = (slices[nose].section.points.row(0).transpose() - out.centroid).dot(out.up);
    out.joint += nose_height * out.up - static_cast<Scalar>(options.joint_back) * out.length * out.forward;
    return out;
}

} // namespace skelgen::refinement
