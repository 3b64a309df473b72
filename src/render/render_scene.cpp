#include <skelgen/render/render_scene.hpp>

#include <skelgen/core/error.hpp>

#include "body.hpp"
#include "canvas.hpp"
#include "check.hpp"
#include "drawing.hpp"

namespace skelgen::render {

Image render_scene(const Scene& scene, const RenderOptions& options) {
    check(options);
    check(scene);
    const Drawing drawing = lay_out(scene, options);
    Image image = draw_body(scene, drawing.projection, drawing.cones, options);
    draw_overlay(drawing, image);
    return image;
}

} // namespace skelgen::render
