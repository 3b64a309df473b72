#include <skelgen/refinement/end_points.hpp>

#include <algorithm>
#include <cmath>

namespace skelgen {
namespace {

/// How far from the curve's leaf an end may lie, relative to the geodesic diameter: about a hand's length.
constexpr double reach = 0.08;

int nearest_vertex(const TriangleMesh<double>& mesh, const Vector3<double>& point) {
    Eigen::Index nearest = 0;
    (mesh.vertices.rowwise() - point.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    return static_cast<int>(nearest);
}

Eigen::VectorXd distances_from(const CurveGraph<double>& surface, int vertex) {
    const std::vector<double> distance = shortest_paths(surface, vertex).distance;
    return Eigen::Map<const Eigen::VectorXd>(distance.data(), static_cast<Eigen::Index>(distance.size()));
}

bool is_foot(const EndPoint& end, const SkeletonTemplate& skeleton_template) {
    return skeleton_template.joints[static_cast<std::size_t>(end.joint)].role == JointRole::foot;
}

/// Sum of the distances to the ends at the other end of the body.
Eigen::VectorXd remoteness(const EndPoint& end, const std::vector<EndPoint>& ends,
                           const SkeletonTemplate& skeleton_template) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(end.distance.size());
    for (const EndPoint& other : ends) {
        const bool head = skeleton_template.joints[static_cast<std::size_t>(other.joint)].role == JointRole::head;
        if (is_foot(end, skeleton_template) ? head : is_foot(other, skeleton_template)) sum += other.distance;
    }
    return sum;
}

} // namespace

std::vector<EndPoint> find_end_points(const TriangleMesh<double>& mesh, const CurveGraph<double>& surface,
                                      const CurveSkeleton<double>& curve, const Embedding& embedding,
                                      const SkeletonTemplate& skeleton_template) {
    std::vector<EndPoint> leaves;
    for (const Chain& chain : embedding.chains) {
        const JointRole role = skeleton_template.joints[static_cast<std::size_t>(chain.joints.back())].role;
        if (role != JointRole::head && role != JointRole::hand && role != JointRole::foot) continue;
        const int vertex = nearest_vertex(mesh, curve.nodes.row(chain.nodes.back()).transpose());
        leaves.push_back({chain.joints.back(), vertex, distances_from(surface, vertex)});
    }
    const double radius = reach * geodesic_diameter(leaves);
    std::vector<EndPoint> ends;
    for (const EndPoint& leaf : leaves) {
        const Eigen::VectorXd far = remoteness(leaf, leaves, skeleton_template);
        int best = leaf.vertex;
        for (Eigen::Index v = 0; v < far.size(); ++v)
            if (leaf.distance[v] <= radius && std::isfinite(far[v]) && far[v] > far[best]) best = static_cast<int>(v);
        ends.push_back({leaf.joint, best, best == leaf.vertex ? leaf.distance : distances_from(surface, best)});
    }
    return ends;
}

double geodesic_diameter(const std::vector<EndPoint>& ends) {
    double diameter = 0;
    for (const EndPoint& a : ends)
        for (const EndPoint& b : ends)
            if (std::isfinite(a.distance[b.vertex])) diameter = std::max(diameter, a.distance[b.vertex]);
    return diameter;
}

} // namespace skelgen
