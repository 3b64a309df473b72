#pragma once

// Shapes with closed forms, made by code. All are closed and look outwards.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::test {

using Mesh = TriangleMesh<double>;
using Vec3 = Vector3<double>;
inline constexpr double pi = std::numbers::pi;

inline Mesh make_mesh(const std::vector<Vec3>& vertices, const std::vector<std::array<int, 3>>& faces) {
    Mesh mesh;
    mesh.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 3);
    mesh.faces.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t v = 0; v < vertices.size(); ++v)
        mesh.vertices.row(static_cast<Eigen::Index>(v)) = vertices[v].transpose();
    for (std::size_t f = 0; f < faces.size(); ++f)
        mesh.faces.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
    return mesh;
}

/// Rings of `around` vertices one above the other, closed by a bottom and a top vertex.
/// \param profile (radius, height) of bottom, rings and top; the first and the last radius are 0
inline Mesh surface_of_revolution(const std::vector<std::array<double, 2>>& profile, int around) {
    std::vector<Vec3> vertices;
    for (std::size_t ring = 1; ring + 1 < profile.size(); ++ring)
        for (int k = 0; k < around; ++k) {
            const double angle = 2 * pi * k / around;
            vertices.emplace_back(profile[ring][0] * std::cos(angle), profile[ring][0] * std::sin(angle),
                                  profile[ring][1]);
        }
    const int rings = static_cast<int>(profile.size()) - 2, bottom = rings * around, top = bottom + 1;
    vertices.emplace_back(0, 0, profile.front()[1]);
    vertices.emplace_back(0, 0, profile.back()[1]);

    std::vector<std::array<int, 3>> faces;
    for (int k = 0; k < around; ++k) {
        const int next = (k + 1) % around, last = (rings - 1) * around;
        faces.push_back({bottom, next, k});
        for (int ring = 0; ring + 1 < rings; ++ring) {
            const int low = ring * around, high = low + around;
            faces.push_back({low + k, low + next, high + next});
            faces.push_back({low + k, high + next, high + k});
        }
        faces.push_back({top, last + k, last + next});
    }
    return make_mesh(vertices, faces);
}

/// A cylinder around the z axis from z = 0 to `length` with flat lids, `around` vertices a ring.
inline Mesh cylinder(double radius, double length, int around = 32, int along = 40) {
    std::vector<std::array<double, 2>> profile{{0, 0}};
    const int across = std::max(1, around / 6);
    for (int i = 1; i < across; ++i) profile.push_back({radius * i / across, 0});
    for (int i = 0; i <= along; ++i) profile.push_back({radius, length * i / along});
    for (int i = across - 1; i > 0; --i) profile.push_back({radius * i / across, length});
    profile.push_back({0, length});
    return surface_of_revolution(profile, around);
}

/// A cylinder around the z axis between two half spheres around (0, 0, 0) and (0, 0, length).
inline Mesh capsule(double radius, double length, int around = 32, int along = 40) {
    std::vector<std::array<double, 2>> profile;
    const int quarter = around / 4;
    for (int i = 0; i <= quarter; ++i) {
        const double angle = pi / 2 * i / quarter;
        profile.push_back({i == 0 ? 0 : radius * std::sin(angle), -radius * std::cos(angle)});
    }
    for (int i = 1; i <= along; ++i) profile.push_back({radius, length * i / along});
    for (int i = 1; i <= quarter; ++i) {
        const double angle = pi / 2 * i / quarter;
        profile.push_back({i == quarter ? 0 : radius * std::cos(angle), length + radius * std::sin(angle)});
    }
    return surface_of_revolution(profile, around);
}

/// A torus around the z axis: a circle of radius `large` with a tube of radius `small` around it.
inline Mesh torus(double large, double small, int around = 64, int tube = 24) {
    std::vector<Vec3> vertices;
    std::vector<std::array<int, 3>> faces;
    for (int i = 0; i < around; ++i)
        for (int k = 0; k < tube; ++k) {
            const double u = 2 * pi * i / around, v = 2 * pi * k / tube;
            const double distance = large + small * std::cos(v);
            vertices.emplace_back(distance * std::cos(u), distance * std::sin(u), small * std::sin(v));
            const int a = i * tube + k, b = i * tube + (k + 1) % tube;
            const int c = (i + 1) % around * tube + k, d = (i + 1) % around * tube + (k + 1) % tube;
            faces.push_back({a, c, d});
            faces.push_back({a, d, b});
        }
    return make_mesh(vertices, faces);
}

/// Each triangle into four, `times` over; new vertices in the middles of the edges.
inline Mesh subdivided(Mesh mesh, int times) {
    for (; times > 0; --times) {
        std::vector<Vec3> vertices;
        for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) vertices.emplace_back(mesh.vertices.row(v).transpose());
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b) {
            const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(vertices.size()));
            if (is_new)
                vertices.emplace_back(0.5 *
                                      (vertices[static_cast<std::size_t>(a)] + vertices[static_cast<std::size_t>(b)]));
            return place->second;
        };
        std::vector<std::array<int, 3>> faces;
        for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
            const int a = mesh.faces(f, 0), b = mesh.faces(f, 1), c = mesh.faces(f, 2);
            const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            faces.insert(faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        mesh = make_mesh(vertices, faces);
    }
    return mesh;
}

/// The box from the origin to `size`, each side two triangles subdivided `times` over.
inline Mesh box(const Vec3& size, int times = 0) {
    Mesh mesh;
    mesh.vertices.resize(8, 3);
    for (int i = 0; i < 8; ++i) mesh.vertices.row(i) << (i & 1) * size[0], (i >> 1 & 1) * size[1], (i >> 2) * size[2];
    mesh.faces.resize(12, 3);
    mesh.faces << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3,
        7, 5;
    return subdivided(std::move(mesh), times);
}

inline Mesh cube(int times = 0) { return box(Vec3::Ones(), times); }

/// A sphere around the origin: an octahedron, subdivided and blown up. 8 * 4^times faces.
inline Mesh sphere(double radius, int times = 4) {
    Mesh mesh = make_mesh({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitX(), -Vec3::UnitY(), -Vec3::UnitZ()},
                          {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}});
    for (; times > 0; --times) {
        mesh = subdivided(std::move(mesh), 1);
        mesh.vertices.rowwise().normalize();
    }
    mesh.vertices *= radius;
    return mesh;
}

/// The surface where `field` (negative inside) vanishes within the box from `low` to `high`, which it must not touch,
/// on a lattice of `step`: each cell in six tetrahedra, each cut straight. Closed and manifold; triangles may be thin.
inline Mesh level_set(const std::function<double(const Vec3&)>& field, const Vec3& low, const Vec3& high, double step) {
    using Cell = std::array<int, 3>;
    const Vec3 origin = low - 0.3571 * step * Vec3::Ones(); // hardly any lattice point falls on the surface
    const auto place = [&](const Cell& c) { return Vec3(origin + step * Vec3(c[0], c[1], c[2])); };
    const auto cells = [&](int k) { return static_cast<int>(std::ceil((high[k] - origin[k]) / step)); };

    std::vector<Vec3> vertices;
    std::vector<std::array<int, 3>> faces;
    std::map<std::pair<Cell, Cell>, int> vertex_on_edge;
    std::map<Cell, double> values;
    const auto value = [&](const Cell& c) {
        const auto [entry, is_new] = values.try_emplace(c, 0.0);
        if (is_new) entry->second = field(place(c));
        return entry->second;
    };
    const auto crossing = [&](const Cell& a, const Cell& b) {
        const auto [entry, is_new] = vertex_on_edge.try_emplace(std::minmax(a, b), static_cast<int>(vertices.size()));
        if (is_new) {
            const double t = value(a) / (value(a) - value(b));
            vertices.emplace_back((1 - t) * place(a) + t * place(b));
        }
        return entry->second;
    };
    const auto add_face = [&](int a, int b, int c, const Vec3& inside) {
        const auto at = [&](int v) { return vertices[static_cast<std::size_t>(v)]; };
        const bool outwards = (at(b) - at(a)).cross(at(c) - at(a)).dot(inside - at(a)) < 0;
        faces.push_back(outwards ? std::array<int, 3>{a, b, c} : std::array<int, 3>{a, c, b});
    };
    const auto cut_tetrahedron = [&](const std::array<Cell, 4>& corners) {
        std::vector<Cell> in, out;
        for (const Cell& c : corners) (value(c) < 0 ? in : out).push_back(c);
        if (in.empty() || out.empty()) return;
        if (in.size() == 2) {
            const int a = crossing(in[0], out[0]), b = crossing(in[0], out[1]), c = crossing(in[1], out[1]),
                      d = crossing(in[1], out[0]);
            add_face(a, b, c, place(in[0]));
            add_face(a, c, d, place(in[1]));
            return;
        }
        const Cell& single = in.size() == 1 ? in[0] : out[0];
        const std::vector<Cell>& others = in.size() == 1 ? out : in;
        add_face(crossing(single, others[0]), crossing(single, others[1]), crossing(single, others[2]), place(in[0]));
    };
    for (int i = 0; i < cells(0); ++i)
        for (int j = 0; j < cells(1); ++j)
            for (int k = 0; k < cells(2); ++k) {
                std::array<int, 3> axes{0, 1, 2}; // one tetrahedron per way from the cell's low corner to its high one
                do {
                    std::array<Cell, 4> corners;
                    corners[0] = {i, j, k};
                    for (std::size_t s = 0; s < 3; ++s) {
                        corners[s + 1] = corners[s];
                        ++corners[s + 1][static_cast<std::size_t>(axes[s])];
                    }
                    cut_tetrahedron(corners);
                } while (std::next_permutation(axes.begin(), axes.end()));
            }
    return make_mesh(vertices, faces);
}

/// Distance to the segment from `a` to `b`.
inline double segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - a - t * (b - a)).norm();
}

/// Tubes of one radius around segments, grown together where they meet.
inline Mesh tubes(const std::vector<std::array<Vec3, 2>>& segments, double radius, double step) {
    Vec3 low = segments[0][0], high = low;
    for (const auto& segment : segments)
        for (const Vec3& end : segment) {
            low = low.cwiseMin(end);
            high = high.cwiseMax(end);
        }
    const Vec3 margin = Vec3::Constant(radius + step);
    const auto field = [&](const Vec3& p) {
        double distance = (p - segments[0][0]).norm();
        for (const auto& [a, b] : segments) distance = std::min(distance, segment_distance(p, a, b));
        return distance - radius;
    };
    return level_set(field, low - margin, high + margin, step);
}

/// The ends of the arms of `three_tubes`, which leave the origin.
inline std::array<Vec3, 3> three_tube_ends() { return {Vec3(0, 0, -1), Vec3(0.75, 0.1, 0.7), Vec3(-0.65, -0.1, 0.6)}; }

/// A Y of three tubes of radius 0.12.
inline Mesh three_tubes() {
    std::vector<std::array<Vec3, 2>> segments;
    for (const Vec3& end : three_tube_ends()) segments.push_back({Vec3::Zero(), end});
    return tubes(segments, 0.12, 0.04);
}

} // namespace skelgen::test
