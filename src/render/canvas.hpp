#pragma once

#include <vector>

#include <skelgen/render/image.hpp>

#include "drawing.hpp"

namespace skelgen::render {

/// Draws anti-aliased round strokes on top of a picture. Strokes of one call never darken where they overlap.
void draw_strokes(const std::vector<std::vector<Eigen::Vector2d>>& strokes, double width, const Colour& colour,
                  Image& image);

/// Draws the lines and the texts of a drawing, in that order.
void draw_overlay(const Drawing& drawing, Image& image);

} // namespace skelgen::render
