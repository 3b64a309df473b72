// A user's program that links skelgen::render alone: a picture of a tetrahedron.

#include <cstdlib>

#include <skelgen/render/png.hpp>
#include <skelgen/render/render_scene.hpp>

int main() {
    skelgen::render::Scene scene;
    scene.mesh.vertices.resize(4, 3);
    scene.mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    scene.mesh.faces.resize(4, 3);
    scene.mesh.faces << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
    skelgen::render::RenderOptions options;
    options.width = options.height = 32;
    const auto png = skelgen::render::encode_png(skelgen::render::render_scene(scene, options));
    return png.find("PNG") == 1 ? EXIT_SUCCESS : EXIT_FAILURE;
}
