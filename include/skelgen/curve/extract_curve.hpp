#pragma once

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/curve/contraction.hpp>
#include <skelgen/curve/leaf_extension.hpp>
#include <skelgen/curve/proxy.hpp>
#include <skelgen/curve/pruning.hpp>
#include <skelgen/curve/surgery.hpp>

namespace skelgen {

/// Constants of every step from proxy to curve skeleton.
struct CurveOptions {
    ContractionOptions contraction;
    SurgeryOptions surgery;
    LeafExtensionOptions leaves;
    PruningOptions pruning;
};

/// The curve skeleton of a manifold surface of unit area: contraction, surgery, centring, leaf extension, pruning.
/// `proxy` stands in for `mesh` (see build_proxy) in all but the regions, which index the vertices of `mesh`, and the
/// leaves, which end on it; `surface` as from surface_graph(mesh). \throws Error as its steps do.
[[nodiscard]] CurveSkeleton<double> extract_curve(const TriangleMesh<double>& mesh, const CurveGraph<double>& surface,
                                                  const Proxy& proxy, const CurveOptions& options = {});

} // namespace skelgen
