#pragma once

// What must not matter to a result: place, size, order. And how meshes hang together.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/manifold_parts.hpp>

namespace skelgen::test {

/// A rotation, then a scale, then a translation.
struct Motion {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    double scale = 1;
    Vector3<double> translation = Vector3<double>::Zero();

    [[nodiscard]] Vector3<double> apply(const Vector3<double>& p) const { return scale * (rotation * p) + translation; }
    [[nodiscard]] Vector3<double> undo(const Vector3<double>& p) const {
        return rotation.transpose() * (p - translation) / scale;
    }
};

/// A rotation drawn from `seed`, all equally likely.
inline Eigen::Matrix3d random_rotation(unsigned seed) {
    std::mt19937_64 random(seed);
    const auto uniform = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
    const double u = uniform(), a = 2 * std::numbers::pi * uniform(), b = 2 * std::numbers::pi * uniform();
    return Eigen::Quaterniond(std::sqrt(u) * std::cos(b), std::sqrt(1 - u) * std::sin(a),
                              std::sqrt(1 - u) * std::cos(a), std::sqrt(u) * std::sin(b))
        .normalized()
        .toRotationMatrix();
}

inline TriangleMesh<double> moved(TriangleMesh<double> mesh, const Motion& motion) {
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        mesh.vertices.row(v) = motion.apply(mesh.vertices.row(v).transpose()).transpose();
    return mesh;
}

inline TriangleMesh<double> moved_by(const TriangleMesh<double>& mesh, const Vector3<double>& way) {
    return moved(mesh, {Eigen::Matrix3d::Identity(), 1, way});
}

/// A permutation of 0 to n - 1, the same on every machine.
inline std::vector<int> random_permutation(int n, std::mt19937_64& random) {
    std::vector<int> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size(); i-- > 1;) std::swap(order[i], order[random() % (i + 1)]);
    return order;
}

/// The same surface with vertices, faces and first corners in another order.
inline TriangleMesh<double> shuffled(const TriangleMesh<double>& mesh, unsigned seed) {
    std::mt19937_64 random(seed);
    const std::vector<int> vertex = random_permutation(static_cast<int>(mesh.vertices.rows()), random);
    const std::vector<int> face = random_permutation(static_cast<int>(mesh.faces.rows()), random);
    TriangleMesh<double> out = mesh;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        out.vertices.row(vertex[static_cast<std::size_t>(v)]) = mesh.vertices.row(v);
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const auto turn = static_cast<int>(random() % 3);
        for (int k = 0; k < 3; ++k)
            out.faces(face[static_cast<std::size_t>(f)], (k + turn) % 3) =
                vertex[static_cast<std::size_t>(mesh.faces(f, k))];
    }
    return out;
}

using surface::side_by_side;

/// Without the faces `first`, `first` + 1, ... `first` + `count` - 1.
inline TriangleMesh<double> without_faces(const TriangleMesh<double>& mesh, Eigen::Index first, Eigen::Index count) {
    TriangleMesh<double> out = mesh;
    const Eigen::Index rest = mesh.faces.rows() - first - count;
    out.faces.resize(mesh.faces.rows() - count, 3);
    out.faces << mesh.faces.topRows(first), mesh.faces.bottomRows(rest);
    return out;
}

/// What of a mesh has x of 0 or more, cut there, and its mirror image beside it: the same vertex numbers on both sides,
/// those of the image after all others. The mesh is closed where the given one is.
inline TriangleMesh<double> with_mirrored_half(const TriangleMesh<double>& mesh) {
    std::vector<Eigen::RowVector3d> places;
    std::map<std::pair<int, int>, int> corner; // by the edge that it cuts, or twice its vertex
    std::vector<std::array<int, 3>> faces;
    const auto x = [&](int v) { return mesh.vertices(v, 0); };
    const auto at = [&](int a, int b) {
        const auto [entry, is_new] = corner.try_emplace(std::minmax(a, b), static_cast<int>(places.size()));
        if (is_new) {
            const auto [from, to] = entry->first;
            Eigen::RowVector3d place = mesh.vertices.row(from);
            if (from != to) {
                place += x(from) / (x(from) - x(to)) * (mesh.vertices.row(to) - mesh.vertices.row(from));
                place[0] = 0;
            }
            places.push_back(place);
        }
        return entry->second;
    };
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        std::vector<int> polygon;
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3);
            if (x(a) >= 0) polygon.push_back(at(a, a));
            if (x(a) * x(b) < 0) polygon.push_back(at(a, b));
        }
        for (std::size_t k = 2; k < polygon.size(); ++k) faces.push_back({polygon[0], polygon[k - 1], polygon[k]});
    }
    const std::size_t half = faces.size();
    std::vector<int> image;
    for (std::size_t v = 0, count = places.size(); v < count; ++v) {
        image.push_back(static_cast<int>(places[v][0] == 0 ? v : places.size()));
        if (places[v][0] != 0) places.emplace_back(-places[v][0], places[v][1], places[v][2]);
    }
    for (std::size_t f = 0; f < half; ++f) {
        const auto [a, b, c] = faces[f];
        faces.push_back({image[static_cast<std::size_t>(a)], image[static_cast<std::size_t>(c)],
                         image[static_cast<std::size_t>(b)]});
    }
    TriangleMesh<double> out{Points<double>(static_cast<Eigen::Index>(places.size()), 3),
                             Triangles(static_cast<Eigen::Index>(faces.size()), 3)};
    for (std::size_t v = 0; v < places.size(); ++v) out.vertices.row(static_cast<Eigen::Index>(v)) = places[v];
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (int k = 0; k < 3; ++k) out.faces(static_cast<Eigen::Index>(f), k) = faces[f][static_cast<std::size_t>(k)];
    return out;
}

/// Vertices - edges + faces; vertices that no face uses do not count.
inline int euler_characteristic(const Triangles& faces) {
    std::set<int> vertices;
    std::set<std::pair<int, int>> edges;
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            vertices.insert(faces(f, k));
            edges.insert(std::minmax({faces(f, k), faces(f, (k + 1) % 3)}));
        }
    return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + static_cast<int>(faces.rows());
}

/// Does every edge join two faces that run along it in opposite senses?
inline bool is_closed(const Triangles& faces) {
    std::map<std::pair<int, int>, int> count;
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) ++count[{faces(f, k), faces(f, (k + 1) % 3)}];
    return std::all_of(count.begin(), count.end(), [&](const auto& entry) {
        const auto back = count.find({entry.first.second, entry.first.first});
        return entry.second == 1 && back != count.end() && back->second == 1;
    });
}

} // namespace skelgen::test
