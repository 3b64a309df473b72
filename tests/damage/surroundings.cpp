#include <map>

#include <skelgen/core/geometry.hpp>

#include "damages.hpp"
#include "patch.hpp"
#include "plate.hpp"

namespace skelgen::damage {
namespace {

Mesh joined(const Mesh& a, const Mesh& b) {
    Mesh mesh;
    mesh.vertices.resize(a.vertices.rows() + b.vertices.rows(), 3);
    mesh.vertices << a.vertices, b.vertices;
    mesh.faces.resize(a.faces.rows() + b.faces.rows(), 3);
    mesh.faces << a.faces, (b.faces.array() + static_cast<int>(a.vertices.rows())).matrix();
    return mesh;
}

/// The largest extent of the bounding box: a person's height or reach.
double body_length(const Mesh& mesh) {
    return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).maxCoeff();
}

/// One face has a corner of its own, that many body lengths away; its neighbours are as they were.
Mesh with_far_corner(const Subject& subject, double lengths) {
    Soup soup = to_soup(subject.mesh);
    Dice dice(subject.seed);
    Face& face = soup.faces[dice.index(soup.faces.size())];
    face[0] = soup.add(soup.at(face[0]) + lengths * body_length(subject.mesh) * dice.direction());
    return to_mesh(soup);
}

void add_copy(Soup& soup, const std::vector<std::size_t>& faces, const Vec3& away) {
    std::map<int, int> copy;
    for (const std::size_t f : faces) {
        Face face = soup.faces[f];
        for (int& v : face) {
            const auto [place, is_new] = copy.try_emplace(v, 0);
            if (is_new) place->second = soup.add(soup.at(v) + away);
            v = place->second;
        }
        soup.faces.push_back(face);
    }
}

} // namespace

Mesh far_unused(const Subject& subject) {
    constexpr int count = 10;
    constexpr double lengths = 100;
    Soup soup = to_soup(subject.mesh);
    Dice dice(subject.seed);
    for (int i = 0; i < count; ++i) soup.add(soup.at(0) + lengths * body_length(subject.mesh) * dice.direction());
    return to_mesh(soup);
}

Mesh far_100(const Subject& subject) { return with_far_corner(subject, 100); }
Mesh far_1000(const Subject& subject) { return with_far_corner(subject, 1000); }

Mesh floating(const Subject& subject) {
    constexpr int count = 10;
    constexpr double part = 0.005, away = 0.15; // of the area, of the body's length
    Soup soup = to_soup(subject.mesh);
    const std::vector<Face> beyond = neighbours(soup.faces);
    const std::size_t faces = soup.faces.size();
    Dice dice(subject.seed);
    for (int i = 0; i < count; ++i) {
        const auto patch = patch_around(to_soup(subject.mesh), beyond, dice.index(faces), part);
        // Outwards along the patch's normal, so that it does not end up within the body's trunk.
        const Vec3 out = normal(soup, soup.faces[patch.front()]).normalized();
        add_copy(soup, patch, away * (1 + dice.uniform()) * body_length(subject.mesh) * out);
    }
    return to_mesh(soup);
}

Mesh plate_apart(const Subject& subject) {
    constexpr double gap = 0.02;
    return joined(subject.mesh, plate_below(subject.mesh, *subject.skeleton, gap));
}

Mesh two_bodies(const Subject& subject) {
    constexpr double apart = 1.2; // body lengths between their middles
    Mesh other = subject.mesh;
    const Vec3 extent = other.vertices.colwise().maxCoeff() - other.vertices.colwise().minCoeff();
    int thinnest = 0; // one stands behind the other
    extent.minCoeff(&thinnest);
    other.vertices.col(thinnest).array() += apart * extent.maxCoeff();
    return joined(subject.mesh, other);
}

} // namespace skelgen::damage
