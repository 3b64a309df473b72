#include "canvas.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <skelgen/core/geometry.hpp>

#include "stroke_font.hpp"

namespace skelgen::render {
namespace {

/// How much of each pixel of a rectangle is covered, 0 to 1.
struct Mask {
    int left;
    int top;
    Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> coverage; ///< rows x columns
};

Mask empty_mask(const std::vector<Polyline>& strokes, double reach, const Image& image) {
    Eigen::AlignedBox2d box;
    for (const Polyline& stroke : strokes)
        for (const Eigen::Vector2d& p : stroke) box.extend(p);
    if (box.isEmpty()) return {0, 0, {}};
    const auto bound = [](double x, int limit) { return static_cast<int>(std::clamp(x, 0.0, double(limit))); };
    const int left = bound(std::floor(box.min().x() - reach), image.width);
    const int top = bound(std::floor(box.min().y() - reach), image.height);
    const int right = bound(std::ceil(box.max().x() + reach), image.width);
    const int bottom = bound(std::ceil(box.max().y() + reach), image.height);
    Mask mask{left, top, {}};
    mask.coverage.setZero(std::max(0, bottom - top), std::max(0, right - left));
    return mask;
}

void cover_segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius, Mask& mask) {
    const double reach = radius + 0.5;
    const auto first = [&](double x, int origin) {
        return std::max(0, static_cast<int>(std::floor(x - reach)) - origin);
    };
    const auto last = [&](double x, int origin, Eigen::Index size) {
        return std::min(static_cast<int>(size), static_cast<int>(std::ceil(x + reach)) - origin);
    };
    const int end_x = last(std::max(a.x(), b.x()), mask.left, mask.coverage.cols());
    const int end_y = last(std::max(a.y(), b.y()), mask.top, mask.coverage.rows());
    for (int y = first(std::min(a.y(), b.y()), mask.top); y < end_y; ++y)
        for (int x = first(std::min(a.x(), b.x()), mask.left); x < end_x; ++x) {
            const Eigen::Vector2d centre(mask.left + x + 0.5, mask.top + y + 0.5);
            const double covered = std::clamp(reach - core::nearest_on_segment(centre, a, b).distance, 0.0, 1.0);
            mask.coverage(y, x) = std::max(mask.coverage(y, x), static_cast<float>(covered));
        }
}

/// Paints over a pixel whose colour is not multiplied by its opacity.
void paint(const Colour& colour, float opacity, Pixel& pixel) {
    const float below = float(pixel[3]) / 255 * (1 - opacity);
    const float total = opacity + below;
    if (total <= 0) return;
    const float channels[3] = {colour.red, colour.green, colour.blue};
    for (std::size_t i = 0; i < 3; ++i)
        pixel[i] = to_byte((channels[i] * opacity + float(pixel[i]) / 255 * below) / total);
    pixel[3] = to_byte(total);
}

double text_start(const OverlayText& text) {
    const double width = text_width(text.text, text.cap_height);
    switch (text.anchor) {
    case Anchor::start:
        return text.baseline.x();
    case Anchor::middle:
        return text.baseline.x() - width / 2;
    case Anchor::end:
        return text.baseline.x() - width;
    }
    return text.baseline.x();
}

} // namespace

void draw_strokes(const std::vector<Polyline>& strokes, double width, const Colour& colour, Image& image) {
    // A line thinner than a pixel is drawn one pixel wide and fainter, or it would be dotted.
    const double radius = std::max(width, 1.0) / 2;
    const float opacity = static_cast<float>(std::min(width, 1.0));
    Mask mask = empty_mask(strokes, radius + 1, image);
    for (const Polyline& stroke : strokes)
        for (std::size_t i = 0; i < stroke.size(); ++i)
            if (i > 0 || stroke.size() == 1) cover_segment(stroke[i == 0 ? 0 : i - 1], stroke[i], radius, mask);
    for (Eigen::Index y = 0; y < mask.coverage.rows(); ++y)
        for (Eigen::Index x = 0; x < mask.coverage.cols(); ++x)
            if (mask.coverage(y, x) > 0)
                paint(colour, opacity * mask.coverage(y, x),
                      image.at(mask.left + static_cast<int>(x), mask.top + static_cast<int>(y)));
}

void draw_overlay(const Drawing& drawing, Image& image) {
    for (const OverlayLine& line : drawing.lines)
        if (line.halo) draw_strokes({line.points}, 2.2 * line.width + 1, palette::halo, image);
    for (const OverlayLine& line : drawing.lines) draw_strokes({line.points}, line.width, line.colour, image);
    for (const OverlayText& text : drawing.texts) {
        const auto strokes = text_strokes(text.text, {text_start(text), text.baseline.y()}, text.cap_height);
        draw_strokes(strokes, std::max(0.9, 0.14 * text.cap_height), text.colour, image);
    }
}

} // namespace skelgen::render
