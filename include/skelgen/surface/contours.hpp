#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/face_tree.hpp>

namespace skelgen::surface {

/// A contour in which a plane cuts a surface, or on which a field has one value: points in order around it.
template <typename Scalar = double>
struct Contour {
    std::vector<Vector3<Scalar>> points;
    std::vector<int>
        faces; ///< faces[i] carries the segment from points[i] to points[i + 1], the last back to the first
};

/// The contours of a field on an edge-manifold surface; `adjacency` as from core::face_adjacency. Holds references to
/// mesh and adjacency, which must outlive it.
template <typename Scalar = double>
class LevelSets {
public:
    /// `field` is given at the vertices (n entries, finite), linear on each face. O(faces).
    LevelSets(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency, Eigen::VectorX<Scalar> field);

    /// The contours on which the field has the value `level`. Broken by holes they are closed straight. By
    /// ascending first face. O(1) for each face whose
    /// values are no farther from `level` than twice what the field changes on any face.
    [[nodiscard]] std::vector<Contour<Scalar>> contours(Scalar level) const;

private:
    [[nodiscard]] std::size_t bin_of(Scalar value) const {
        return static_cast<std::size_t>((value - lowest_) / steepest_);
    }

    const TriangleMesh<Scalar>& mesh_;
    const Triangles& adjacency_;
    Eigen::VectorX<Scalar> field_;
    std::vector<int> faces_;           ///< by bins of their lowest values; without those on which it is constant
    std::vector<std::size_t> begin_;   ///< of each bin, and at last the end
    Scalar lowest_ = 0, steepest_ = 0; ///< value of all, and difference of values on a face: as wide as a bin
};

/// How a contour lies to a point in its plane.
template <typename Scalar = double>
struct PlanarRelation {
    Scalar area = 0; ///< that the contour encloses, positive where it runs counter-clockwise around the normal
    Scalar distance =
        std::numeric_limits<Scalar>::infinity(); ///< from the point to the nearest of the contour's points
    bool encloses = false;
};

/// `normal` is the plane's, of length 1. O(points).
template <typename Scalar>
[[nodiscard]] PlanarRelation<Scalar> relate(const Contour<Scalar>& contour, const Vector3<Scalar>& point,
                                            const Vector3<Scalar>& normal);

/// A contour that was found around a point.
template <typename Scalar = double>
struct ContourAround : Contour<Scalar> {
    PlanarRelation<Scalar> relation; ///< to that point
};

/// The contour around a point in the plane through it with that unit `normal`: the smallest one that encloses the
/// point, else the one nearest to it, but no farther than `reach`; none when there is no such contour. `adjacency` and
/// `tree` as above. O(log faces) for each face of the contour where it encloses the point and is closed, else for each
/// of those that are in one direction from it or within reach.
template <typename Scalar>
[[nodiscard]] std::optional<ContourAround<Scalar>>
contour_around(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency, const FaceTree<Scalar>& tree,
               const Vector3<Scalar>& point, const Vector3<Scalar>& normal, Scalar reach);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/contours.hpp>
#endif
