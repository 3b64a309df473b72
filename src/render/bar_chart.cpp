#include <skelgen/render/bar_chart.hpp>

#include <algorithm>
#include <cmath>

#include <skelgen/core/error.hpp>

#include "canvas.hpp"
#include "stroke_font.hpp"

namespace skelgen::render {
namespace {

/// The rectangle between the axes.
struct Plane {
    double left, right, top, bottom;

    [[nodiscard]] Eigen::Vector2d at(double x, double y) const {
        return {left + x * (right - left), bottom - y * (bottom - top)};
    }
};

void fill(const Plane& plane, const Bar& bar, Image& image) {
    const auto pixel = [](double x) { return static_cast<int>(std::lround(x)); };
    const double gap = 1.5;
    const Eigen::Vector2d low = plane.at(bar.from, 0), high = plane.at(bar.to, std::clamp(bar.height, 0.0, 1.0));
    const Colour& c = palette::left;
    for (int y = pixel(high.y()); y < pixel(low.y()); ++y)
        for (int x = pixel(low.x() + gap); x < pixel(high.x() - gap); ++x)
            image.at(x, y) = {to_byte(c.red), to_byte(c.green), to_byte(c.blue), 255};
}

/// The axes, their ticks at every fifth, and the diagonal.
void add_axes(const BarChart& chart, const Plane& plane, double size, Drawing& drawing) {
    drawing.lines.push_back({{plane.at(0, 1), plane.at(0, 0), plane.at(1, 0)}, 1.5, palette::text});
    constexpr int ticks = 5;
    for (int i = 0; i <= ticks; ++i) {
        const double at = static_cast<double>(i) / ticks;
        const std::string text = i == ticks ? "1" : i == 0 ? "0" : "0." + std::to_string(10 * i / ticks);
        const Eigen::Vector2d below = plane.at(at, 0), beside = plane.at(0, at);
        drawing.lines.push_back({{below, below + Eigen::Vector2d(0, size / 2)}, 1.5, palette::text});
        drawing.lines.push_back({{beside, beside - Eigen::Vector2d(size / 2, 0)}, 1.5, palette::text});
        drawing.texts.push_back({text, below + Eigen::Vector2d(0, 2 * size), Anchor::middle, size, palette::text});
        drawing.texts.push_back({text, beside + Eigen::Vector2d(-size, size / 2), Anchor::end, size, palette::text});
    }
    if (chart.diagonal) drawing.lines.push_back({{plane.at(0, 0), plane.at(1, 1)}, 1.5, palette::mark});
}

} // namespace

Image draw_bar_chart(const BarChart& chart, int width, int height) {
    constexpr int least = 100;
    if (width < least || height < least) throw Error(ErrorCode::usage, "a chart needs 100 pixels in either direction");
    Image image(width, height, Pixel{255, 255, 255, 255});
    const double size = std::min(width, height) / 36.0; // of capital letters
    const Plane plane{4.5 * size, width - 2 * size, 7 * size, height - 5.5 * size};
    Drawing drawing;
    for (const Bar& bar : chart.bars) {
        fill(plane, bar, image);
        const Eigen::Vector2d above = plane.at((bar.from + bar.to) / 2, std::clamp(bar.height, 0.0, 1.0));
        drawing.texts.push_back(
            {bar.label, above - Eigen::Vector2d(0, size / 2), Anchor::middle, 0.8 * size, palette::text});
    }
    add_axes(chart, plane, size, drawing);
    drawing.texts.push_back({chart.title, {width / 2.0, 2 * size}, Anchor::middle, 1.2 * size, palette::text});
    drawing.texts.push_back({chart.upwards, {size, 4.5 * size}, Anchor::start, size, palette::text});
    drawing.texts.push_back(
        {chart.across, {(plane.left + plane.right) / 2, height - size}, Anchor::middle, size, palette::text});
    draw_overlay(drawing, image);
    return image;
}

} // namespace skelgen::render
