#pragma once

#include <skelgen/core/mesh.hpp>
#include <skelgen/render/image.hpp>

#include "drawing.hpp"

namespace skelgen::render {

/// Draws the translucent body with the drawing's cones inside it. Overlay lines and texts are left to `draw_overlay`.
[[nodiscard]] Image draw_body(const TriangleMesh<double>& mesh, const Projection& projection,
                              const std::vector<RoundCone>& cones, const RenderOptions& options);

} // namespace skelgen::render
