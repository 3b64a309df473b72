#include "geodesic.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace skelgen::synth {
namespace {

struct Edge {
    int from;
    int to;
    double length;
};

/// The edges in both directions, by their first vertex, with the place where each vertex's edges begin.
struct EdgeGraph {
    std::vector<Edge> edges;
    std::vector<std::size_t> first;
};

EdgeGraph edge_graph(const TriangleMesh<double>& mesh) {
    EdgeGraph graph;
    graph.edges.reserve(static_cast<std::size_t>(mesh.faces.rows()) * 6);
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3);
            const double length = (mesh.vertices.row(a) - mesh.vertices.row(b)).norm();
            graph.edges.push_back({a, b, length});
            graph.edges.push_back({b, a, length});
        }
    std::sort(graph.edges.begin(), graph.edges.end(), [](const Edge& a, const Edge& b) { return a.from < b.from; });
    graph.first.assign(static_cast<std::size_t>(mesh.vertices.rows()) + 1, 0);
    for (const Edge& edge : graph.edges) ++graph.first[static_cast<std::size_t>(edge.from) + 1];
    for (std::size_t v = 1; v < graph.first.size(); ++v) graph.first[v] += graph.first[v - 1];
    return graph;
}

/// Dijkstra's farthest vertex and its distance.
std::pair<int, double> farthest_from(const EdgeGraph& graph, int start) {
    std::vector<double> distance(graph.first.size() - 1, std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    distance[static_cast<std::size_t>(start)] = 0;
    queue.emplace(0, start);
    std::pair<int, double> last{start, 0};
    while (!queue.empty()) {
        const auto [d, v] = queue.top();
        queue.pop();
        const auto vertex = static_cast<std::size_t>(v);
        if (d > distance[vertex]) continue;
        last = {v, d};
        for (std::size_t e = graph.first[vertex]; e < graph.first[vertex + 1]; ++e) {
            const Edge& edge = graph.edges[e];
            double& other = distance[static_cast<std::size_t>(edge.to)];
            if (d + edge.length < other) queue.emplace(other = d + edge.length, edge.to);
        }
    }
    return last;
}

} // namespace

double geodesic_diameter(const TriangleMesh<double>& mesh, const std::vector<int>& starts) {
    const EdgeGraph graph = edge_graph(mesh);
    std::pair<int, double> best{0, 0};
    for (const int start : starts)
        if (const auto found = farthest_from(graph, start); found.second > best.second) best = found;
    return std::max(best.second, farthest_from(graph, best.first).second);
}

} // namespace skelgen::synth
