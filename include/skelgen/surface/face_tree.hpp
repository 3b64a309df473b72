#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// The faces of a mesh in a tree of bounding boxes, so that a question about a place or a plane is answered from the
/// faces near it. Holds indices and boxes alone: every question is given the mesh that the tree was made of.
template <typename Scalar = double>
class FaceTree {
public:
    FaceTree() = default;

    /// O(faces log faces).
    explicit FaceTree(const TriangleMesh<Scalar>& mesh);

    /// The faces with one or two corners on or above the plane of points p with normal . p = offset and the others
    /// below, in ascending order: all that have a point within `reach` of a place, and perhaps others near it. O(log
    /// faces) for each of them.
    [[nodiscard]] std::vector<int> faces_across(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& normal,
                                                Scalar offset, const Vector3<Scalar>& place = Vector3<Scalar>::Zero(),
                                                Scalar reach = std::numeric_limits<Scalar>::infinity()) const;

    /// Distance from a place to the surface, or `most` where it is no nearer; infinite when there is no face. O(log
    /// faces) where faces are no longer than the distance.
    [[nodiscard]] Scalar distance(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place,
                                  Scalar most = std::numeric_limits<Scalar>::infinity()) const;

    /// The vertex of a face that is nearest to a place, the lowest of equals; -1 when there is no face. As above.
    [[nodiscard]] int nearest_vertex(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place) const;

    /// The corner, nearest to a place, of the face that is nearest to it; -1 when there is no face. Of a place on a
    /// surface one beside it on that surface: the nearest vertex of all may be of a part that lies against it. Any
    /// one where the place is not finite. As above.
    [[nodiscard]] int nearest_corner(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place) const;

    /// The first face that a ray from a place in a direction of length 1 meets within `reach`, and how far that is; -1
    /// and infinity when it meets none. O(log faces) for each face that the ray comes near.
    struct Hit {
        int face = -1;
        Scalar distance = std::numeric_limits<Scalar>::infinity();
    };
    [[nodiscard]] Hit first_along(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place,
                                  const Vector3<Scalar>& direction,
                                  Scalar reach = std::numeric_limits<Scalar>::infinity()) const;

    /// All faces that such a ray meets, in ascending order. As above.
    [[nodiscard]] std::vector<int> faces_along(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place,
                                               const Vector3<Scalar>& direction) const;

    /// How often a closed surface winds around a place: how many more faces a ray from there, in a direction of length
    /// 1, leaves through than it comes in by. None where it passes an edge or the place so nearly that rounding decides
    /// which faces it meets. As above.
    [[nodiscard]] std::optional<int> windings_along(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place,
                                                    const Vector3<Scalar>& direction) const;

private:
    /// Faces in the order of a curve that fills space (Mor66), and boxes around runs of them: each box is followed by
    /// those around its first part, and knows where that around the rest is.
    struct Node {
        Eigen::AlignedBox<Scalar, 3> box;
        int rest;  ///< -1 where the run is no longer parted
        int first; ///< face of such a run
        int count;
    };
    struct Boxes {
        std::vector<int> faces;
        std::vector<Node> nodes;
    };

    /// Asks a query about boxes, from the one around all down, and about the faces in those that it wants.
    template <typename Query>
    void ask(Query& query) const;
    template <typename Query>
    bool ask_below(Query& query, int node) const;
    template <typename Query>
    void ask_nearest_first(Query& query) const;
    template <typename Query>
    void ask_nearest_first(Query& query, int node) const;

    std::shared_ptr<const Boxes> boxes_;
};

/// Squared distance from a place to a box, 0 inside; without a branch, as most questions to a tree are of this kind.
template <typename Scalar>
[[nodiscard]] Scalar squared_distance_to_box(const Vector3<Scalar>& place, const Eigen::AlignedBox<Scalar, 3>& box) {
    Scalar squared = 0;
    for (int k = 0; k < 3; ++k) {
        const Scalar beyond = std::max(std::max(box.min()[k] - place[k], place[k] - box.max()[k]), Scalar(0));
        squared += beyond * beyond;
    }
    return squared;
}

/// Distance from a place to a triangle, which may be degenerate.
template <typename Scalar>
[[nodiscard]] Scalar distance_to_triangle(const Vector3<Scalar>& place, const Vector3<Scalar>& a,
                                          const Vector3<Scalar>& b, const Vector3<Scalar>& c);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/face_tree.hpp>
#endif
