#include <skelgen/refinement/centreline.hpp>

#include <optional>
#include <vector>

#include <skelgen/core/polyline.hpp>

namespace skelgen {
namespace {

constexpr Eigen::Index tangent_reach = 3; // samples: about a wrist's width to both sides

std::vector<std::optional<CrossSection>> cut_across(const Slicer& slicer, const Points<double>& line, double reach) {
    std::vector<std::optional<CrossSection>> sections(static_cast<std::size_t>(line.rows()));
    for (Eigen::Index i = 1; i + 1 < line.rows(); ++i)
        sections[static_cast<std::size_t>(i)] =
            slicer.around(line.row(i).transpose(), tangent_at(line, i, tangent_reach), reach);
    return sections;
}

Points<double> recentred(const Points<double>& line, const std::vector<std::optional<CrossSection>>& sections,
                         double largest_shift) {
    Points<double> moved = line;
    for (Eigen::Index i = 1; i + 1 < line.rows(); ++i) {
        const auto& section = sections[static_cast<std::size_t>(i)];
        if (!section) continue;
        const Vector3<double> shift = section->centroid - line.row(i).transpose();
        if (shift.norm() <= largest_shift * section->thickness) moved.row(i) = section->centroid.transpose();
    }
    Points<double> smooth =
        moved; // sections of neighbouring points may cross at a bend: one pass of smoothing sorts them
    for (Eigen::Index i = 1; i + 1 < line.rows(); ++i)
        smooth.row(i) = 0.25 * moved.row(i - 1) + 0.5 * moved.row(i) + 0.25 * moved.row(i + 1);
    return smooth;
}

} // namespace

Centreline draw_centreline(const Slicer& slicer, const Points<double>& line, const CentrelineOptions& options) {
    const double reach = 4 * options.step;
    Points<double> points = resample(line, options.step);
    for (int round = 0; round < options.rounds; ++round)
        points = resample(recentred(points, cut_across(slicer, points, reach), options.largest_shift), options.step);

    Centreline out;
    out.arc = arc_lengths(points);
    out.thickness = out.area = out.flatness = Eigen::VectorXd::Zero(points.rows());
    const auto sections = cut_across(slicer, points, reach);
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

} // namespace skelgen
