#include <skelgen/curve/extract_curve.hpp>

#include <array>

#include <nanoflann.hpp>

#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/centring.hpp>
#include <skelgen/curve/leaf_extension.hpp>

namespace skelgen {
namespace {

/// The proxy vertex that stands for each mesh vertex. Each proxy vertex claims the mesh vertex nearest to it; claims spread
/// over the surface, not through space, so that a hand beside a thigh stays a hand.
std::vector<int> proxy_vertex_of(const TriangleMesh<double>& mesh, const CurveGraph<double>& surface,
                                 const TriangleMesh<double>& proxy) {
    constexpr std::size_t candidates = 6; // the nearest vertex whose normal agrees, lest a claim jumps to a touching limb
    const nanoflann::KDTreeEigenMatrixAdaptor<Points<double>, 3, nanoflann::metric_L2_Simple> tree(
        3, std::cref(mesh.vertices), 10);
    const Points<double> normals = vertex_normals(mesh), proxy_normals = vertex_normals(proxy);
    std::vector<int> seeds;
    for (Eigen::Index v = 0; v < proxy.vertices.rows(); ++v) {
        std::array<Eigen::Index, candidates> nearest{};
        std::array<double, candidates> squared_distance{};
        const Vector3<double> p = proxy.vertices.row(v);
        nanoflann::KNNResultSet<double, Eigen::Index> result(candidates);
        result.init(nearest.data(), squared_distance.data());
        tree.index->findNeighbors(result, p.data(), nanoflann::SearchParams());
        Eigen::Index chosen = nearest[0];
        for (std::size_t k = 0; k < result.size(); ++k)
            if (normals.row(nearest[k]).dot(proxy_normals.row(v)) > 0.5) {
                chosen = nearest[k];
                break;
            }
        seeds.push_back(static_cast<int>(chosen));
    }
    return nearest_source(surface, seeds);
}

/// The same curve with regions of mesh vertices in place of proxy vertices.
CurveSkeleton<double> with_mesh_regions(CurveSkeleton<double> curve, const TriangleMesh<double>& mesh,
                                        const CurveGraph<double>& surface, const TriangleMesh<double>& proxy) {
    const std::vector<int> node = detail::node_of_vertex(curve, proxy.vertices.rows());
    const std::vector<int> stand_in = proxy_vertex_of(mesh, surface, proxy);
    for (auto& region : curve.regions) region.clear();
    for (std::size_t v = 0; v < stand_in.size(); ++v)
        curve.regions[static_cast<std::size_t>(node[static_cast<std::size_t>(stand_in[v])])].push_back(
            static_cast<int>(v));
    return curve;
}

} // namespace

CurveSkeleton<double> extract_curve(const TriangleMesh<double>& mesh, const CurveGraph<double>& surface,
                                    const TriangleMesh<double>& proxy, const CurveOptions& options) {
    const Contraction contraction = contract(proxy, options.contraction);
    const CurveSkeleton<double> graph = connectivity_surgery(contraction.vertices, proxy.faces, options.surgery);
    const CurveSkeleton<double> centred = centre_nodes(graph, proxy, contraction.vertices);
    return prune(extend_leaves(with_mesh_regions(centred, mesh, surface, proxy), mesh, options.leaves), options.pruning);
}

} // namespace skelgen
