#include <utility>

#include "damages.hpp"

namespace skelgen::damage {

Mesh inside_out(const Subject& subject) {
    Mesh mesh = subject.mesh;
    mesh.faces.col(1).swap(mesh.faces.col(2));
    return mesh;
}

Mesh flipped(const Subject& subject) {
    constexpr double part = 0.3;
    Soup soup = to_soup(subject.mesh);
    Dice dice(subject.seed);
    for (const std::size_t f : dice.sample(soup.faces.size(), part)) std::swap(soup.faces[f][1], soup.faces[f][2]);
    return to_mesh(soup);
}

Mesh mirrored(const Subject& subject) {
    Mesh mesh = inside_out(subject); // which the mirror turns outwards again
    mesh.vertices.col(0) *= -1;
    return mesh;
}

} // namespace skelgen::damage
