#pragma once

#include <string>
#include <vector>

#include <skelgen/render/image.hpp>
#include <skelgen/render/scene.hpp>
#include <skelgen/render/view.hpp>

namespace skelgen::render {

enum class Background { white, transparent };

struct RenderOptions {
    int width = 800;              ///< pixels, 16 to 16384
    int height = 1000;            ///< pixels, 16 to 16384
    View view = NamedView::front; ///< where from
    Background background = Background::white;
    bool names = false;    ///< write the joints' names beside the body
    int supersampling = 3; ///< samples per pixel and direction, 1 to 8
};

/// Draws a scene: the translucent body, the curve skeleton thin, bones blue on the person's left, yellow on the right
/// and grey in the middle. Joints are dots, marks red crosses. Orthographic, no display and no GPU needed; the same
/// scene gives the same pixels. Bones are veiled by the surface in front of them, so one that has left the body shows.
/// O(faces + pixels x supersampling^2) time; the memory besides the picture grows with its width only.
/// \throws Error usage when the options are out of range, bad_input when the mesh has indices without a vertex or
/// coordinates that are not finite.
[[nodiscard]] Image render_scene(const Scene& scene, const RenderOptions& options = {});

/// The same picture as an SVG document: bones, joints, lines and text are vectors, on top of the body as an embedded
/// PNG.
/// \throws Error as `render_scene`.
[[nodiscard]] std::string render_svg(const Scene& scene, const RenderOptions& options = {});

} // namespace skelgen::render
