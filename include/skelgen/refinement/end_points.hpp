#pragma once

#include <vector>

#include <Eigen/Core>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/embed.hpp>

namespace skelgen {

/// Where a limb ends on the surface.
struct EndPoint {
    int joint = -1;           ///< template joint that ends the limb
    int vertex = -1;          ///< mesh vertex
    Eigen::VectorXd distance; ///< per mesh vertex the geodesic distance to it
};

/// The ends of all limbs: near the curve's leaves, the vertices farthest over the surface from the feet (for hands and
/// head) or from the head (for feet). Defined by the surface alone, they do not depend on how the curve was found.
/// `surface` as from surface_graph(mesh). O(limbs n log n).
[[nodiscard]] std::vector<EndPoint> find_end_points(const TriangleMesh<double>& mesh, const CurveGraph<double>& surface,
                                                    const CurveSkeleton<double>& curve, const Embedding& embedding,
                                                    const SkeletonTemplate& skeleton_template);

/// Largest geodesic distance between two ends: the geodesic diameter of a body.
[[nodiscard]] double geodesic_diameter(const std::vector<EndPoint>& ends);

} // namespace skelgen
