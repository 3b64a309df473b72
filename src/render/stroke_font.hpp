#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace skelgen::render {

/// A polyline in pixels, y down.
using Polyline = std::vector<Eigen::Vector2d>;

/// Width in pixels of a line of text whose capital letters are `cap_height` high.
[[nodiscard]] double text_width(std::string_view text, double cap_height);

/// The strokes of a line of text that starts at `baseline`. UTF-8; letters outside ASCII become boxes.
[[nodiscard]] std::vector<Polyline> text_strokes(std::string_view text, const Eigen::Vector2d& baseline,
                                                 double cap_height);

} // namespace skelgen::render
