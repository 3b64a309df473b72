#include "surface_light.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <skelgen/core/shortest_turn.hpp>

#include "rasterize.hpp"

namespace skelgen::render {
namespace {

constexpr int map_size = 160; // of a shadow map, in samples

/// `count` directions spread evenly over the sphere, on a golden-angle spiral.
std::vector<Vector3<double>> even_directions(int count) {
    std::vector<Vector3<double>> directions;
    const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2 * i + 1.0) / count;
        const double r = std::sqrt(1 - z * z);
        directions.emplace_back(r * std::cos(golden_angle * i), r * std::sin(golden_angle * i), z);
    }
    return directions;
}

/// Fewer for large meshes: their shadows are averaged over more vertices anyway.
int direction_count(Eigen::Index faces) {
    return static_cast<int>(std::clamp<Eigen::Index>(2'000'000 / std::max<Eigen::Index>(faces, 1), 12, 48));
}

/// The mesh turned so that `direction` is z, fitted into the shadow map; z in map samples too.
Points<double> seen_from(const Vector3<double>& direction, const Points<double>& vertices) {
    const Eigen::Matrix3d turn = core::shortest_turn<double>(direction, Vector3<double>::UnitZ()).toRotationMatrix();
    Points<double> turned = vertices * turn.transpose();
    const Eigen::RowVector3d low = turned.colwise().minCoeff();
    const Eigen::RowVector3d high = turned.colwise().maxCoeff();
    const double extent = std::max((high - low).head<2>().maxCoeff(), std::numeric_limits<double>::min());
    turned.rowwise() -= low;
    return turned * ((map_size - 2) / extent);
}

using ShadowMap = Eigen::ArrayXXd; // map_size x map_size

ShadowMap nearest_depths(const Points<double>& seen, const Triangles& faces) {
    ShadowMap depths = ShadowMap::Constant(map_size, map_size, -std::numeric_limits<double>::infinity());
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        const auto corner = [&](int i) { return seen.row(faces(f, i)).transpose(); };
        const Eigen::Array3d z(corner(0).z(), corner(1).z(), corner(2).z());
        rasterize_triangle(corner(0).head<2>(), corner(1).head<2>(), corner(2).head<2>(), {map_size, 0, map_size},
                           [&](int x, int y, const Eigen::Array3d& weights) {
                               depths(y, x) = std::max(depths(y, x), (weights * z).sum());
                           });
    }
    return depths;
}

bool is_lit(const ShadowMap& depths, const Eigen::RowVector3d& point) {
    constexpr double bias = 2.5; // samples; keeps a surface from shadowing itself
    const auto cell = [](double x) { return std::clamp(static_cast<int>(x), 0, map_size - 1); };
    return point.z() + bias >= depths(cell(point.y()), cell(point.x()));
}

/// One pass of averaging over neighbours: takes the noise of finitely many directions away.
std::vector<double> smoothed(const std::vector<double>& values, const Triangles& faces) {
    std::vector<double> sums(values);
    std::vector<double> weights(values.size(), 1.0);
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int i = 0; i < 3; ++i) {
            const auto from = static_cast<std::size_t>(faces(f, i));
            const auto to = static_cast<std::size_t>(faces(f, (i + 1) % 3));
            sums[to] += values[from];
            weights[to] += 1;
        }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= weights[i];
    return sums;
}

} // namespace

Points<double> outward_normals(const TriangleMesh<double>& mesh) {
    Points<double> normals = Points<double>::Zero(mesh.vertices.rows(), 3);
    if (mesh.vertices.rows() == 0) return normals;
    const Eigen::RowVector3d centre = mesh.vertices.colwise().mean();
    double volume = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const auto corner = [&](int i) -> Eigen::RowVector3d { return mesh.vertices.row(mesh.faces(f, i)) - centre; };
        const Eigen::RowVector3d area = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        volume += corner(0).dot(area);
        for (int i = 0; i < 3; ++i) normals.row(mesh.faces(f, i)) += area;
    }
    normals.rowwise().normalize();
    return volume < 0 ? Points<double>(-normals) : normals;
}

std::vector<double> ambient_light(const TriangleMesh<double>& mesh, const Points<double>& normals) {
    const auto count = static_cast<std::size_t>(mesh.vertices.rows());
    std::vector<double> light(count, 0.0);
    std::vector<double> most(count, 0.0);
    if (mesh.faces.rows() == 0) return std::vector<double>(count, 1.0);
    for (const Vector3<double>& direction : even_directions(direction_count(mesh.faces.rows()))) {
        const Points<double> seen = seen_from(direction, mesh.vertices);
        const ShadowMap depths = nearest_depths(seen, mesh.faces);
        for (std::size_t v = 0; v < count; ++v) {
            const auto row = static_cast<Eigen::Index>(v);
            const double cosine = normals.row(row).dot(direction);
            if (cosine <= 0.05) continue; // grazing light says more about the bias than about the shape
            most[v] += cosine;
            if (is_lit(depths, seen.row(row))) light[v] += cosine;
        }
    }
    for (std::size_t v = 0; v < count; ++v) light[v] = most[v] > 0 ? light[v] / most[v] : 1.0;
    return smoothed(smoothed(light, mesh.faces), mesh.faces);
}

} // namespace skelgen::render
