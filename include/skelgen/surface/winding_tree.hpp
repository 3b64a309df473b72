#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// The faces of a mesh in a tree whose nodes know what their faces together look like from afar, so that a winding
/// number takes a few hundred terms whatever the size of the mesh (BDSLJ18). Holds moments and indices alone: every
/// question is given the mesh that the tree was made of.
template <typename Scalar = double>
class WindingTree {
public:
    /// O(faces log faces).
    explicit WindingTree(const TriangleMesh<Scalar>& mesh);

    /// The generalized winding number around a place, to a few hundredths: nodes seen from farther than twice their
    /// radius are expanded to first order. 0 without faces. About O(log faces).
    [[nodiscard]] Scalar winding_number(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place) const;

private:
    struct Node {
        // In the order in which they are asked for: most nodes are opened, or are leaves.
        Vector3<Scalar> centre = Vector3<Scalar>::Zero(); ///< mean of the faces' centres by area
        Scalar radius = 0;                                ///< of the ball around it that holds the faces
        int left = -1, right = -1;                        ///< children, -1 in a leaf
        int first = 0, last = 0;                          ///< its faces: from `first` to before `last` in order_
        Vector3<Scalar> area = Vector3<Scalar>::Zero();   ///< sum of the area vectors
        Eigen::Matrix<Scalar, 3, 3> moment =
            Eigen::Matrix<Scalar, 3, 3>::Zero(); ///< sum of (centre of face - centre) area^T
    };
    int build(const TriangleMesh<Scalar>& mesh, const std::vector<Vector3<Scalar>>& centres, int first, int last);

    std::vector<Node> nodes_;
    std::vector<int> order_;
};

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/winding_tree.hpp>
#endif
