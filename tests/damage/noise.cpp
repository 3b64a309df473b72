#include <cmath>

#include <skelgen/core/geometry.hpp>

#include "damages.hpp"

namespace skelgen::damage {
namespace {

Mesh with_noise(const Subject& subject, double part) {
    Mesh mesh = subject.mesh;
    const double deviation = part * core::bounding_diagonal(mesh.vertices) / std::sqrt(3.0); // in each direction
    Dice dice(subject.seed);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        for (int k = 0; k < 3; ++k) mesh.vertices(v, k) += deviation * dice.normal();
    return mesh;
}

} // namespace

Mesh noise_1(const Subject& subject) { return with_noise(subject, 0.01); }
Mesh noise_2(const Subject& subject) { return with_noise(subject, 0.02); }

} // namespace skelgen::damage
