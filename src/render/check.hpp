#pragma once

#include <skelgen/render/render_scene.hpp>

namespace skelgen::render {

/// \throws Error usage when an option is out of its range.
void check(const RenderOptions& options);

/// \throws Error bad_input when the scene cannot be drawn: an index without its point, a coordinate that is no number.
void check(const Scene& scene);

} // namespace skelgen::render
