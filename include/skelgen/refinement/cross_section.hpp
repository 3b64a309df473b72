#pragma once

#include <optional>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// A closed contour in which a plane cuts a surface.
struct CrossSection {
    Points<double> points;    ///< k x 3, in order around the contour
    Points<double> normals;   ///< k x 3 unit face normals, entry i of the segment from point i to i + 1
    Eigen::VectorXd lengths;  ///< k lengths of those segments
    Vector3<double> centroid; ///< of the enclosed area
    double area = 0;          ///< enclosed
    double perimeter = 0;
    double thickness = 0; ///< length-weighted mean distance from the centroid to the contour
};

/// Cuts an edge-manifold surface by planes; `adjacency` as from face_adjacency. Holds references to both.
class Slicer {
public:
    Slicer(const TriangleMesh<double>& mesh, const Triangles& adjacency) : mesh_(mesh), adjacency_(adjacency) {}

    /// The contour around `point` in the plane through it with that unit `normal`: the smallest one that encloses the
    /// point, else the one whose nearest contour point is closest, but no farther than `reach`; none when there is no
    /// such contour. Contours broken by holes are closed straight. O(n + m).
    [[nodiscard]] std::optional<CrossSection> around(const Vector3<double>& point, const Vector3<double>& normal,
                                                     double reach) const;

    [[nodiscard]] const TriangleMesh<double>& mesh() const { return mesh_; }

    /// Length-weighted centre of a contour on which a field given at the vertices has the value `level`: of those whose
    /// centre is no farther from `near` than `reach` and their own mean radius, the longest; of all when there are none
    /// so near; none when there is no contour. O(n + m).
    [[nodiscard]] std::optional<Vector3<double>> level_set_centre(const Eigen::VectorXd& field, double level,
                                                                  const Vector3<double>& near, double reach) const;

private:
    const TriangleMesh<double>& mesh_;
    const Triangles& adjacency_;
};

/// Flatness of a section's Gauss map (LF20 section 3.2.1): l3 / (l1 + l2 + l3) of the covariance of its normals,
/// segments weighted by length, about the origin of the Gauss sphere. 0 for a cylinder cut across (normals on a great
/// circle), 1/3 where normals point everywhere.
[[nodiscard]] double gauss_map_flatness(const CrossSection& section);

/// How egg-shaped a section is along a unit direction in its plane: how far the middle of its extent lies beyond the
/// centre of its area. Positive where it is narrower towards `direction`.
[[nodiscard]] double egg_shape(const CrossSection& section, const Vector3<double>& direction);

} // namespace skelgen
