#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <skelgen/render/render_scene.hpp>

#include "palette.hpp"

namespace skelgen::render {

/// A point of the picture in pixels: x to the right, y DOWN from the top left corner, z towards the viewer.
using PixelPoint = Eigen::Vector3d;

/// Maps the scene's coordinates to the picture's: a rotation, one scale and a shift, so spheres stay round.
struct Projection {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(); ///< rows: right, down, toward
    double scale = 1;                                   ///< pixels per unit of length
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();    ///< pixels

    [[nodiscard]] PixelPoint operator()(const Vector3<double>& point) const { return scale * (turn * point) + shift; }
};

/// A solid between two spheres: a bone when their radii differ, a stretch of curve when not, a ball when they coincide.
struct RoundCone {
    PixelPoint start;
    PixelPoint end;
    double start_radius = 1;
    double end_radius = 1;
    Colour colour = palette::middle;
};

/// A line on top of the picture.
struct OverlayLine {
    std::vector<Eigen::Vector2d> points;
    double width = 1;
    Colour colour = palette::text;
    bool halo = false; ///< a light rim, for lines that cross the body
};

enum class Anchor { start, middle, end };

/// A line of text on top of the picture.
struct OverlayText {
    std::string text;
    Eigen::Vector2d baseline = Eigen::Vector2d::Zero(); ///< where the anchor sits
    Anchor anchor = Anchor::start;
    double cap_height = 10; ///< height of a capital letter in pixels
    Colour colour = palette::text;
};

/// A scene laid out on the picture's plane: all that both the PNG and the SVG have to draw besides the body.
struct Drawing {
    Projection projection;
    std::vector<RoundCone> cones;
    std::vector<OverlayLine> lines;
    std::vector<OverlayText> texts;
};

[[nodiscard]] Drawing lay_out(const Scene& scene, const RenderOptions& options);

} // namespace skelgen::render
