#include "find_curve.hpp"

#include <skelgen/core/canonical_form.hpp>
#include <skelgen/curve/extract_curve.hpp>
#include <skelgen/curve/manifold_parts.hpp>

namespace skelgen::cli {

CurveSkeleton<double> find_curve(const TriangleMesh<double>& mesh) {
    const CanonicalMesh canonical = canonical_form(mesh);
    const ManifoldParts<double> part = largest_manifold_part(canonical.mesh);
    CurveSkeleton<double> curve = extract_curve(part.mesh);
    for (Eigen::Index i = 0; i < curve.nodes.rows(); ++i)
        curve.nodes.row(i) = canonical.similarity.to_input(curve.nodes.row(i).transpose()).transpose();
    for (double& radius : curve.radii) radius *= canonical.similarity.scale;
    for (auto& region : curve.regions)
        for (int& vertex : region) {
            const int canonical_vertex = part.source[static_cast<std::size_t>(vertex)];
            vertex = canonical.input_vertex[static_cast<std::size_t>(canonical_vertex)];
        }
    return curve;
}

} // namespace skelgen::cli
