#include <skelgen/render/render_scene.hpp>

#include <skelgen/core/error.hpp>

#include "body.hpp"
#include "canvas.hpp"
#include "check.hpp"
#include "drawing.hpp"

namespace skelgen {

Image render_scene(const Scene& scene, const RenderOptions& options) {
    render::check(options);
    render::check(scene);
    const render::Drawing drawing = render::lay_out(scene, options);
    Image image = render::draw_body(scene.mesh, drawing.projection, drawing.cones, options);
    render::draw_overlay(drawing, image);
    return image;
}

} // namespace skelgen
