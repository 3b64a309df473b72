#pragma once

#include <optional>
#include <utility>

#include <Eigen/Core>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/body.hpp>
#include <skelgen/surface/contours.hpp>

namespace skelgen::refinement {

/// A closed contour in which a plane cuts a surface, in the surface's unit.
template <typename Scalar = double>
struct CrossSection {
    Points<Scalar> points;          ///< k x 3, in order around the contour
    Points<Scalar> normals;         ///< k x 3 unit face normals, entry i of the segment from point i to i + 1
    Eigen::VectorX<Scalar> lengths; ///< k lengths of those segments
    Vector3<Scalar> centroid;       ///< of the enclosed area
    Scalar area = 0;                ///< enclosed
    Scalar perimeter = 0;
    Scalar thickness = 0; ///< length-weighted mean distance from the centroid to the contour
};

/// Unit normals of the faces, m x 3; zero rows for faces without area. O(m).
template <typename Scalar>
[[nodiscard]] Points<Scalar> face_normals(const TriangleMesh<Scalar>& mesh) {
    Points<Scalar> normals(mesh.faces.rows(), 3);
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        core::set_point<Scalar>(normals, f, core::face_area_vector(mesh, f).normalized());
    return normals;
}

/// Cuts an edge-manifold surface by planes; `adjacency` as from core::face_adjacency, `tree` of the same mesh. Holds
/// references to the first two, which must outlive it: it cannot be made from temporaries.
template <typename Scalar = double>
class Slicer {
public:
    Slicer(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency, surface::FaceTree<Scalar> tree)
        : mesh_(mesh), adjacency_(adjacency), tree_(std::move(tree)), normals_(face_normals(mesh)) {}
    Slicer(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency)
        : Slicer(mesh, adjacency, surface::FaceTree<Scalar>(mesh)) {}
    explicit Slicer(const Body<Scalar>& body) : Slicer(body.mesh, body.adjacency, body.tree) {}
    explicit Slicer(const Body<Scalar>&&) = delete;
    Slicer(const TriangleMesh<Scalar>&&, const Triangles&) = delete;
    Slicer(const TriangleMesh<Scalar>&, const Triangles&&) = delete;
    Slicer(const TriangleMesh<Scalar>&&, const Triangles&&) = delete;

    /// The contour around `point` in the plane through it with that unit `normal`: the smallest one that encloses the
    /// point, else the one whose nearest contour point is closest, but no farther than `reach`; none when there is no
    /// such contour. Contours broken by holes are closed straight. O(log m) for each face that is cut.
    [[nodiscard]] std::optional<CrossSection<Scalar>> around(const Vector3<Scalar>& point,
                                                             const Vector3<Scalar>& normal, Scalar reach) const;

    /// The contours of a field given at the vertices (n entries, finite). O(m log m).
    [[nodiscard]] surface::LevelSets<Scalar> level_sets(Eigen::VectorX<Scalar> field) const {
        return {mesh_, adjacency_, std::move(field)};
    }

    [[nodiscard]] const TriangleMesh<Scalar>& mesh() const { return mesh_; }

private:
    const TriangleMesh<Scalar>& mesh_;
    const Triangles& adjacency_;
    surface::FaceTree<Scalar> tree_;
    Points<Scalar> normals_; ///< of the faces
};

/// Length-weighted centre of a contour on which a field has the value `level`: of those whose centre is no farther from
/// `near` than `reach` and their own mean radius, the longest; of all when there are none so near; none when there is
/// no contour. As LevelSets::contours.
template <typename Scalar>
[[nodiscard]] std::optional<Vector3<Scalar>> level_set_centre(const surface::LevelSets<Scalar>& sets, Scalar level,
                                                              const Vector3<Scalar>& near, Scalar reach);

/// Flatness of a section's Gauss map (LF20 section 3.2.1): l3 / (l1 + l2 + l3) of the covariance of its normals,
/// segments weighted by length, about the origin of the Gauss sphere. 0 for a cylinder cut across (normals on a great
/// circle), 1/3 where normals point everywhere. O(k).
template <typename Scalar>
[[nodiscard]] Scalar gauss_map_flatness(const CrossSection<Scalar>& section);

/// How egg-shaped a section is along a unit direction in its plane: how far the middle of its extent lies beyond the
/// centre of its area, in the section's unit. Positive where it is narrower towards `direction`. O(k).
template <typename Scalar>
[[nodiscard]] Scalar egg_shape(const CrossSection<Scalar>& section, const Vector3<Scalar>& direction);

/// Where a section is widest, by the second moments of its area: along the vector that is returned, of either sense;
/// its length is by how much of that the section is narrower the other way, 0 to 1. O(k).
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> widest_direction(const CrossSection<Scalar>& section);

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/cross_section.hpp>
#endif
