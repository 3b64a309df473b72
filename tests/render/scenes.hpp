#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <skelgen/render/image.hpp>
#include <skelgen/render/scene.hpp>

namespace skelgen::test {

/// A sphere of `rings` x 2 `rings` quadrilaterals cut in two, corners exactly on the sphere.
inline TriangleMesh<double> sphere(int rings = 60) {
    const int segments = 2 * rings;
    TriangleMesh<double> mesh;
    mesh.vertices.resize((rings + 1) * segments, 3);
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < segments; ++j) {
            const double polar = std::numbers::pi * i / rings;
            const double turn = 2 * std::numbers::pi * j / segments;
            mesh.vertices.row(i * segments + j) << std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                std::cos(polar);
        }
    mesh.faces.resize(2 * rings * segments, 3);
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < segments; ++j) {
            const int next = (j + 1) % segments;
            const int a = i * segments + j;
            const int b = (i + 1) * segments + j;
            const int c = (i + 1) * segments + next;
            const int d = i * segments + next;
            mesh.faces.row(2 * a) << a, b, c;
            mesh.faces.row(2 * a + 1) << a, c, d;
        }
    return mesh;
}

/// A square of side 2 across z at that height, facing +z.
inline TriangleMesh<double> plate(double z) {
    TriangleMesh<double> mesh;
    mesh.vertices.resize(4, 3);
    mesh.vertices << -1, -1, z, 1, -1, z, 1, 1, z, -1, 1, z;
    mesh.faces.resize(2, 3);
    mesh.faces << 0, 1, 2, 0, 2, 3;
    return mesh;
}

inline TriangleMesh<double> joined(const TriangleMesh<double>& a, const TriangleMesh<double>& b) {
    TriangleMesh<double> mesh;
    mesh.vertices.resize(a.vertices.rows() + b.vertices.rows(), 3);
    mesh.vertices << a.vertices, b.vertices;
    mesh.faces.resize(a.faces.rows() + b.faces.rows(), 3);
    mesh.faces << a.faces, (b.faces.array() + static_cast<int>(a.vertices.rows())).matrix();
    return mesh;
}

/// Three joints in the plane z = 0, seen from +z: a root in the middle, the person's left on the viewer's right.
inline KinematicSkeleton<double> small_skeleton() {
    KinematicSkeleton<double> skeleton;
    skeleton.template_name = "small";
    skeleton.joints = {{"root", -1, {0, 0, 0}, 0.1},
                       {"left_hand", 0, {0.8, 0, 0}, 0.1},
                       {"right_hand", 0, {-0.8, 0, 0}, 0.1},
                       {"head", 0, {0, 0.8, 0}, 0.1}};
    skeleton.frame.left = Vector3<double>::UnitX();
    skeleton.frame.up = Vector3<double>::UnitY();
    skeleton.frame.forward = Vector3<double>::UnitZ();
    return skeleton;
}

inline bool is_blue(const render::Pixel& p) { return p[2] > p[0] + 40 && p[2] > p[1]; }
inline bool is_yellow(const render::Pixel& p) { return p[0] > p[2] + 40 && p[1] > p[2] + 20; }
inline bool is_red(const render::Pixel& p) { return p[0] > p[1] + 60 && p[0] > p[2] + 60; }

/// Pixels of which `property` is true, with the mean of their columns.
struct Found {
    int count = 0;
    double mean_x = 0;
};

template <typename Property>
Found find_pixels(const render::Image& image, const Property& property) {
    Found found;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (property(image.at(x, y))) {
                ++found.count;
                found.mean_x += x;
            }
    if (found.count > 0) found.mean_x /= found.count;
    return found;
}

} // namespace skelgen::test
