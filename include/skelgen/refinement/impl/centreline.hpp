#pragma once

#include <skelgen/refinement/centreline.hpp>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/polyline.hpp>

namespace skelgen::refinement {
namespace detail {

/// Samples to both sides from which a tangent is taken: about a wrist's width.
inline constexpr Eigen::Index tangent_reach = 3;

/// Steps from a point of the line to a contour that does not enclose it but may be its limb's all the same: about a
/// wrist's width, too.
inline constexpr int contour_reach = 4;

template <typename Scalar>
std::vector<std::optional<CrossSection<Scalar>>> cut_across(const Slicer<Scalar>& slicer, const Points<Scalar>& line,
                                                            Scalar reach) {
    std::vector<std::optional<CrossSection<Scalar>>> sections(static_cast<std::size_t>(line.rows()));
    for (Eigen::Index i = 1; i + 1 < line.rows(); ++i)
        sections[static_cast<std::size_t>(i)] =
            slicer.around(line.row(i).transpose(), core::tangent_at(line, i, tangent_reach), reach);
    return sections;
}

template <typename Scalar>
Points<Scalar> recentred(const Points<Scalar>& line, const std::vector<std::optional<CrossSection<Scalar>>>& sections,
                         Scalar largest_shift) {
    Points<Scalar> moved = line;
    for (Eigen::Index i = 1; i + 1 < line.rows(); ++i) {
        const auto& section = sections[static_cast<std::size_t>(i)];
        if (!section) continue;
        const Vector3<Scalar> shift = section->centroid - line.row(i).transpose();
        if (shift.norm() <= largest_shift * section->thickness) moved.row(i) = section->centroid.transpose();
    }
    Points<Scalar> smooth =
        moved; // sections of neighbouring points may cross at a bend: one pass of smoothing sorts them
    for (Eigen::Index i = 1; i + 1 < line.rows(); ++i)
        smooth.row(i) = Scalar(0.25) * moved.row(i - 1) + Scalar(0.5) * moved.row(i) + Scalar(0.25) * moved.row(i + 1);
    return smooth;
}

} // namespace detail

template <typename Scalar>
Centreline<Scalar> draw_centreline(const Slicer<Scalar>& slicer, const Points<Scalar>& line,
                                   const CentrelineOptions& options) {
    const auto step = static_cast<Scalar>(options.step), largest_shift = static_cast<Scalar>(options.largest_shift);
    const Scalar reach = detail::contour_reach * step;
    Points<Scalar> points = core::resample(line, step);
    for (int round = 0; round < options.rounds; ++round)
        points =
            core::resample(detail::recentred(points, detail::cut_across(slicer, points, reach), largest_shift), step);

    Centreline<Scalar> out;
    out.arc = core::arc_lengths(points);
    out.thickness = out.area = out.flatness = Eigen::VectorX<Scalar>::Zero(points.rows());
    const auto sections = detail::cut_across(slicer, points, reach);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const auto& section = sections[static_cast<std::size_t>(i)];
        if (!section) continue;
        out.thickness[i] = section->thickness;
        out.area[i] = section->area;
        out.flatness[i] = gauss_map_flatness(*section);
    }
    out.points = std::move(points);
    return out;
}

} // namespace skelgen::refinement
