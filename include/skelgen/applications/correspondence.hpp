#pragma once

#include <array>
#include <string>
#include <vector>

#include <skelgen/applications/laplace_basis.hpp>
#include <skelgen/applications/segmentation.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

struct CorrespondenceOptions {
    int first_functions = 60; ///< of the functional map that the search begins with, 10 to 100 (MRR19)
    int functions = 100;      ///< of the one that it ends with, `first_functions` to 200
    int step = 8;             ///< by how many it grows, 1 to 50
    double posture = 0.6;     ///< how much places in the common pose count beside the functions, 0 to 2: calibrated
};

/// \throws Error usage when an option is out of its range.
void validate(const CorrespondenceOptions& options);

/// A body with what a correspondence is found by; made once for each body, whatever it is compared with.
template <typename Scalar = double>
struct ComparableBody {
    LaplaceBasis basis;
    Points<Scalar> common;  ///< n x 3, the vertices in the rest pose and size of human21, of an animal of quadruped: x
                            ///< to the left, y up, z forward
    Points<Scalar> normals; ///< n x 3 unit normals in that pose
    Eigen::VectorX<Scalar> sides; ///< n, from -1 on the right limbs to 1 on the left ones
    Triangles faces;
    Segmentation parts;     ///< of the set `bones`
    double rest_height = 0; ///< of the template at rest
};

/// Where the vertices of one body are on another one.
struct Correspondence {
    std::vector<int> map; ///< n vertices of the other body
    /// n, 0 to 1: how near the one body's surface comes to the other one's in the common pose, once bent to it. Half a
    /// hand's breadth apart is 0.6.
    std::vector<double> confidence;
    Points<double>
        bent; ///< n x 3: where the one body's vertices come to lie in the common pose, once bent to the other
};

/// A place on a triangle of a mesh: the mean of its corners, weighed.
struct TrianglePlace {
    int face = -1;
    std::array<double, 3> weights{}; ///< 0 or more, 1 in all
};

/// A place that stands out, on both bodies.
struct Landmark {
    std::string name; ///< of the part that it is on
    int from = 0, to = 0;
};

/// Brings a body into the common pose: each part is turned, and scaled along its bone, from where its bone is to where
/// its template has it. Where parts meet the places are blended. `skeleton` has the joints of human21 or quadruped and
/// is in the input's coordinates. \throws Error usage when a joint is missing, an option is out of its range, or the
/// body has too few vertices. O(n^1.5).
template <typename Scalar>
[[nodiscard]] ComparableBody<Scalar> comparable(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                                                const CorrespondenceOptions& options = {});

/// For each vertex of one body (`from`) the vertex of the other one in the same place. Places in the common pose come
/// first, then functional maps (OBS12) that grow from coarse to fine (MRR19). Together with these the one body is bent
/// smoothly to the other in the common pose (ELC20). Sides and fronts are those of the skeletons, whatever way the
/// bodies stand. O(n m functions). \throws Error usage when an option is out of its range, a body was made comparable
/// with fewer functions, or one is a person and one an animal.
template <typename Scalar>
[[nodiscard]] Correspondence correspond(const ComparableBody<Scalar>& from, const ComparableBody<Scalar>& to,
                                        const CorrespondenceOptions& options = {});

/// For each vertex of the body that was corresponded (`from`) its place on the other one's mesh (`to`), between
/// vertices, too. It is the place that is nearest in the common pose, of the triangles at the vertex that it
/// corresponds to, or else of all. `to_body` was made of that mesh. \throws Error usage as `standing_for`. O((n + m)
/// log m).
template <typename Scalar>
[[nodiscard]] std::vector<TrianglePlace> triangle_places(const TriangleMesh<Scalar>& to, const Body<Scalar>& to_body,
                                                         const ComparableBody<Scalar>& to_comparable,
                                                         const Correspondence& correspondence);

/// In each part of one body the vertex with the largest heat kernel signature (SOG09), as in LF20 section 5.4. With it
/// the vertex of the other body that it corresponds to. Parts without vertices have none. O(n functions).
template <typename Scalar>
[[nodiscard]] std::vector<Landmark> landmarks(const ComparableBody<Scalar>& from, const Correspondence& correspondence);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/correspondence.hpp>
#endif
