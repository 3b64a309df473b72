#include <skelgen/core/denoise.hpp>

#include <algorithm>
#include <array>
#include <vector>

#include <skelgen/core/geometry.hpp>

namespace skelgen {
namespace {

using Edges = std::vector<std::array<int, 2>>;

Edges edges_of(const Triangles& faces) {
    Edges edges;
    edges.reserve(static_cast<std::size_t>(faces.rows()) * 3);
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = faces(f, k), b = faces(f, (k + 1) % 3);
            edges.push_back({std::min(a, b), std::max(a, b)});
        }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// From each vertex to the mean of its neighbours; n x 3.
Points<double> to_neighbours(const Points<double>& vertices, const Edges& edges) {
    Points<double> sum = Points<double>::Zero(vertices.rows(), 3);
    Eigen::VectorXd count = Eigen::VectorXd::Zero(vertices.rows());
    for (const auto& [a, b] : edges) {
        sum.row(a) += vertices.row(b);
        sum.row(b) += vertices.row(a);
        count[a] += 1;
        count[b] += 1;
    }
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        sum.row(v) =
            count[v] > 0 ? Eigen::RowVector3d(sum.row(v) / count[v] - vertices.row(v)) : Eigen::RowVector3d::Zero();
    return sum;
}

double coherence(const TriangleMesh<double>& mesh, const Edges& edges) {
    const Eigen::VectorXd bulge =
        to_neighbours(mesh.vertices, edges).cwiseProduct(vertex_normals(mesh)).rowwise().sum();
    double alike = 0, all = 0;
    for (const auto& [a, b] : edges) {
        alike += bulge[a] * bulge[b];
        all += 0.5 * (bulge[a] * bulge[a] + bulge[b] * bulge[b]);
    }
    return all > 0 ? alike / all : 1;
}

} // namespace

double bulge_coherence(const TriangleMesh<double>& mesh) { return coherence(mesh, edges_of(mesh.faces)); }

int remove_noise(TriangleMesh<double>& mesh, const DenoiseOptions& options) {
    const Edges edges = edges_of(mesh.faces);
    if (coherence(mesh, edges) >= options.least_coherence) return 0;
    int passes = 0;
    for (; passes < options.most_passes && coherence(mesh, edges) < options.enough_coherence; ++passes)
        for (const double step : {options.shrinking, options.growing})
            mesh.vertices += step * to_neighbours(mesh.vertices, edges);
    return passes;
}

} // namespace skelgen
