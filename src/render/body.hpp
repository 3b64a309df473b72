#pragma once

#include <skelgen/render/image.hpp>
#include <skelgen/render/scene.hpp>

#include "drawing.hpp"

namespace skelgen::render {

/// Draws the scene's body, translucent with the drawing's cones inside it, or opaque where it has colours. Overlay
/// lines and texts are left to `draw_overlay`.
[[nodiscard]] Image draw_body(const Scene& scene, const Projection& projection, const std::vector<RoundCone>& cones,
                              const RenderOptions& options);

} // namespace skelgen::render
