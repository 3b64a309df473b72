#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <skelgen/applications/rig.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/weld.hpp>

namespace skelgen::applications {

/// Where the joints of a skeleton are that are there, and the ends of its limbs; one row each. O(joints).
template <typename Scalar>
[[nodiscard]] Points<Scalar> places_of(const KinematicSkeleton<Scalar>& skeleton) {
    Points<Scalar> out(static_cast<Eigen::Index>(skeleton.joints.size() + skeleton.end_points.size()), 3);
    Eigen::Index row = 0;
    for (const Joint<Scalar>& joint : skeleton.joints) // one that is missing has its parent's place
        out.row(row++) = joint.position.transpose();
    for (const auto& [name, place] : skeleton.end_points) out.row(row++) = place.transpose();
    return out;
}

/// The same of a rig: its joints, and the ends of their bones.
template <typename Scalar>
[[nodiscard]] Points<Scalar> places_of(const std::vector<RigJoint<Scalar>>& joints) {
    Points<Scalar> out(static_cast<Eigen::Index>(2 * joints.size()), 3);
    Eigen::Index row = 0;
    for (const RigJoint<Scalar>& joint : joints) {
        out.row(row++) = joint.position.transpose();
        out.row(row++) = joint.end.transpose();
    }
    return out;
}

/// How far along a direction the lowest place lies on which a body stands. Pieces of which all is farther below each of
/// the skeleton's places, `skeleton`, than a tenth of these's size are strays, as scans have them, and do not count;
/// the soles of shoes and what is between the body and the floor do. Faces whose corners are at the same place hang
/// together. Infinite without faces. O(faces), with strays O(n log n).
template <typename Scalar>
[[nodiscard]] Scalar lowest_place(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& up,
                                  const Points<Scalar>& skeleton) {
    const auto height = [&](const TriangleMesh<Scalar>& of, Eigen::Index corner) {
        return up.dot(core::point(of.vertices, of.faces.data()[corner]));
    };
    Scalar lowest = std::numeric_limits<Scalar>::infinity();
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) lowest = std::min(lowest, height(mesh, i));
    const Scalar deepest = (skeleton * up).minCoeff() - core::bounding_diagonal(skeleton) / 10;
    if (lowest >= deepest) return lowest;

    const TriangleMesh<Scalar> whole = surface::weld(mesh, Scalar(0)).mesh;
    core::DisjointSets pieces(static_cast<std::size_t>(whole.vertices.rows()));
    const auto vertex = [&](Eigen::Index corner) { return static_cast<std::size_t>(whole.faces.data()[corner]); };
    for (Eigen::Index i = 0; i < whole.faces.size(); ++i) pieces.unite(vertex(i / 3 * 3), vertex(i));
    std::vector<bool> counts(static_cast<std::size_t>(whole.vertices.rows()), false);
    for (Eigen::Index i = 0; i < whole.faces.size(); ++i)
        if (height(whole, i) >= deepest) counts[pieces.find(vertex(i))] = true;
    Scalar out = std::numeric_limits<Scalar>::infinity();
    for (Eigen::Index i = 0; i < whole.faces.size(); ++i)
        if (counts[pieces.find(vertex(i))]) out = std::min(out, height(whole, i));
    return out < std::numeric_limits<Scalar>::infinity() ? out : lowest;
}

} // namespace skelgen::applications
