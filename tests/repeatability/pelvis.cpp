#include "pelvis.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <skelgen/applications/alignment.hpp>
#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::repeatability {
namespace {

Points<double> aligned(const RegisteredBody& body) {
    return applications::transformed<double>(body.mesh.vertices,
                                             applications::alignment(body.surface, body.skeleton, body.mesh.vertices));
}

std::vector<int> pelvis_vertices(const RegisteredBody& body) {
    const Points<double> places = aligned(body) / body.geodesic_diameter; // the crotch is at the origin
    std::vector<int> out;
    for (Eigen::Index v = 0; v < places.rows(); ++v) {
        const Vector3<double> p = core::point(places, v);
        if (p.norm() < 0.12 && p.y() > -0.01 && p.y() < 0.07 && std::abs(p.x()) < 0.09 && p.z() < 0.02)
            out.push_back(static_cast<int>(v));
    }
    return out;
}

/// Angle in degrees of the rotation that brings points best onto others (Kabsch).
double turn_between(const Eigen::MatrixX3d& from, const Eigen::MatrixX3d& to) {
    const Eigen::Matrix3d moments =
        (from.rowwise() - from.colwise().mean()).transpose() * (to.rowwise() - to.colwise().mean());
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moments, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d rotation = svd.matrixV() * svd.matrixU().transpose();
    if (rotation.determinant() < 0) {
        Eigen::Matrix3d v = svd.matrixV();
        v.col(2) *= -1;
        rotation = v * svd.matrixU().transpose();
    }
    return Eigen::AngleAxisd(rotation).angle() * 180 / std::numbers::pi;
}

} // namespace

std::vector<double> pelvis_turns(const RegisteredSet& set) {
    const std::vector<int> vertices = pelvis_vertices(set.bodies.front());
    std::vector<Eigen::MatrixX3d> patches;
    for (const RegisteredBody& body : set.bodies) {
        const Points<double> places = aligned(body);
        Eigen::MatrixX3d patch(static_cast<Eigen::Index>(vertices.size()), 3);
        for (std::size_t i = 0; i < vertices.size(); ++i)
            patch.row(static_cast<Eigen::Index>(i)) = places.row(vertices[i]);
        patches.push_back(patch);
    }
    std::vector<double> least;
    for (const Eigen::MatrixX3d& medoid : patches) {
        std::vector<double> turns;
        for (const Eigen::MatrixX3d& patch : patches) turns.push_back(turn_between(medoid, patch));
        const auto sum = [](const std::vector<double>& values) {
            return std::accumulate(values.begin(), values.end(), 0.0);
        };
        if (least.empty() || sum(turns) < sum(least)) least = turns;
    }
    return least;
}

} // namespace skelgen::repeatability
