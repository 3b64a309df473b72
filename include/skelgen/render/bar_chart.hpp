#pragma once

#include <string>
#include <vector>

#include <skelgen/render/image.hpp>

namespace skelgen::render {

/// One bar of a chart.
struct Bar {
    double from = 0, to = 0; ///< where it stands on the axis to the right, 0 to 1
    double height = 0;       ///< 0 to 1
    std::string label;       ///< above it
};

/// Shares by shares: both axes go from 0 to 1.
struct BarChart {
    std::string title, across, upwards; ///< what the whole and the two axes show
    std::vector<Bar> bars;
    bool diagonal = false; ///< where both axes have the same value: what a calibrated confidence is
};

/// The chart on white, black and blue. O(pixels).
/// \throws Error usage when `width` or `height` are below 100.
[[nodiscard]] Image draw_bar_chart(const BarChart& chart, int width, int height);

} // namespace skelgen::render
