#include <skelgen/embedding/reduced_graph.hpp>

#include <algorithm>

namespace skelgen {
namespace {

ReducedGraph reduce_graph(const CurveGraph<double>& graph) {
    ReducedGraph out;
    for (int v = 0; v < graph.size(); ++v)
        if (graph.degree(v) != 2) {
            out.origin.push_back(v);
            out.degree.push_back(graph.degree(v));
        }
    const auto n = static_cast<Eigen::Index>(out.origin.size());
    out.distances.resize(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const ShortestPaths<double> paths = shortest_paths(graph, out.origin[static_cast<std::size_t>(i)]);
        for (Eigen::Index k = 0; k < n; ++k)
            out.distances(i, k) = paths.distance[static_cast<std::size_t>(out.origin[static_cast<std::size_t>(k)])];
    }
    out.radius.assign(out.origin.size(), 0);
    return out;
}

/// Largest radius of the curve within this part of its diameter from an end: past the fingers and toes, short of the
/// chest.
constexpr double end_reach = 0.1;

double end_thickness(const CurveSkeleton<double>& curve, const CurveGraph<double>& graph, int end) {
    const double reach = end_reach * curve_diameter(graph);
    const std::vector<double> distance = shortest_paths(graph, end).distance;
    double thickness = 0;
    for (std::size_t v = 0; v < curve.radii.size(); ++v)
        if (distance[v] <= reach) thickness = std::max(thickness, curve.radii[v]);
    return thickness;
}

/// Lengths relative to the largest distance.
ReducedGraph normalised(ReducedGraph graph) {
    const double largest = graph.distances.size() > 0 ? graph.distances.maxCoeff() : 0;
    if (!(largest > 0)) return graph;
    graph.distances /= largest;
    for (double& radius : graph.radius) radius /= largest;
    return graph;
}

/// The template's bones as a curve, each end joint followed by its tip.
CurveSkeleton<double> bones(const SkeletonTemplate& skeleton_template) {
    const auto joints = static_cast<int>(skeleton_template.joints.size());
    CurveSkeleton<double> out;
    out.nodes.resize(joints, 3);
    for (int j = 0; j < joints; ++j) {
        const TemplateJoint& joint = skeleton_template.joints[static_cast<std::size_t>(j)];
        out.nodes.row(j) = joint.position.transpose();
        if (joint.parent >= 0) out.edges.push_back({joint.parent, j});
    }
    for (int j = 0; j < joints; ++j) {
        const TemplateJoint& joint = skeleton_template.joints[static_cast<std::size_t>(j)];
        if (!joint.tip) continue;
        out.edges.push_back({j, static_cast<int>(out.nodes.rows())});
        out.nodes.conservativeResize(out.nodes.rows() + 1, 3);
        out.nodes.bottomRows<1>() = joint.tip->transpose();
    }
    return out;
}

} // namespace

ReducedGraph reduce(const CurveSkeleton<double>& curve) {
    const CurveGraph<double> graph = curve_graph(curve);
    ReducedGraph out = reduce_graph(graph);
    for (std::size_t i = 0; i < out.origin.size(); ++i)
        if (out.degree[i] == 1) out.radius[i] = end_thickness(curve, graph, out.origin[i]);
    return normalised(std::move(out));
}

ReducedGraph reduce(const SkeletonTemplate& skeleton_template) {
    ReducedGraph out = reduce_graph(curve_graph(bones(skeleton_template)));
    int tip = static_cast<int>(skeleton_template.joints.size()); // tips stand for the joints they belong to
    for (std::size_t j = 0; j < skeleton_template.joints.size(); ++j)
        if (skeleton_template.joints[j].tip)
            std::replace(out.origin.begin(), out.origin.end(), tip++, static_cast<int>(j));
    for (std::size_t i = 0; i < out.origin.size(); ++i)
        if (out.degree[i] == 1)
            out.radius[i] = skeleton_template.joints[static_cast<std::size_t>(out.origin[i])].radius;
    return normalised(std::move(out));
}

double longest_path(const SkeletonTemplate& skeleton_template) {
    return curve_diameter(curve_graph(bones(skeleton_template)));
}

} // namespace skelgen
