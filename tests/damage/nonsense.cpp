#include "damages.hpp"

namespace skelgen::damage {

Mesh random_faces(const Subject& subject) {
    Mesh mesh = subject.mesh;
    Dice dice(subject.seed);
    const auto vertices = static_cast<std::size_t>(mesh.vertices.rows());
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) mesh.faces(f, k) = static_cast<int>(dice.index(vertices));
    return mesh;
}

Mesh scrambled(const Subject& subject) {
    Mesh mesh = subject.mesh;
    Dice dice(subject.seed);
    const std::vector<std::size_t> order = dice.sample(static_cast<std::size_t>(mesh.vertices.rows()), 1);
    for (std::size_t v = 0; v < order.size(); ++v)
        mesh.vertices.row(static_cast<Eigen::Index>(v)) =
            subject.mesh.vertices.row(static_cast<Eigen::Index>(order[v]));
    return mesh;
}

Mesh fan(const Subject& subject) {
    Mesh mesh = subject.mesh;
    mesh.faces.col(0).setZero();
    return mesh;
}

Mesh tiny(const Subject& subject) {
    Mesh mesh = subject.mesh;
    mesh.vertices *= 1e-160;
    return mesh;
}

Mesh huge(const Subject& subject) {
    Mesh mesh = subject.mesh;
    mesh.vertices *= 1e150;
    return mesh;
}

} // namespace skelgen::damage
