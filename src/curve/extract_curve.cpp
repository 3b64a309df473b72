#include <skelgen/curve/extract_curve.hpp>

#include <skelgen/curve/centring.hpp>
#include <skelgen/curve/leaf_extension.hpp>

namespace skelgen {
namespace {

/// The same curve with regions of mesh vertices in place of proxy vertices. The claims spread over the surface, not
/// through space, so that a hand on a thigh stays a hand.
CurveSkeleton<double> with_mesh_regions(CurveSkeleton<double> curve, const CurveGraph<double>& surface,
                                        const Proxy& proxy) {
    const std::vector<int> node = detail::node_of_vertex(curve, proxy.mesh.vertices.rows());
    std::vector<int> seeds, seed_node;
    for (std::size_t v = 0; v < proxy.source.size(); ++v) {
        if (proxy.source[v] < 0) continue;
        seeds.push_back(proxy.source[v]);
        seed_node.push_back(node[v]);
    }
    const std::vector<int> claim = nearest_source(surface, seeds);
    for (auto& region : curve.regions) region.clear();
    for (std::size_t v = 0; v < claim.size(); ++v)
        curve.regions[static_cast<std::size_t>(seed_node[static_cast<std::size_t>(claim[v])])].push_back(
            static_cast<int>(v));
    return curve;
}

} // namespace

CurveSkeleton<double> extract_curve(const TriangleMesh<double>& mesh, const CurveGraph<double>& surface,
                                    const Proxy& proxy, const CurveOptions& options) {
    const Contraction contraction = contract(proxy.mesh, options.contraction);
    const CurveSkeleton<double> graph = connectivity_surgery(contraction.vertices, proxy.mesh.faces, options.surgery);
    const CurveSkeleton<double> centred = centre_nodes(graph, proxy.mesh, contraction.vertices);
    const CurveSkeleton<double> whole =
        extend_leaves(with_mesh_regions(centred, surface, proxy), mesh, surface, options.leaves);
    return prune(whole, options.pruning);
}

} // namespace skelgen
