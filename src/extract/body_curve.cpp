#include "body_curve.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geodesics.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/centring.hpp>
#include <skelgen/curve/cut_surface.hpp>
#include <skelgen/curve/extract_curve.hpp>
#include <skelgen/embedding/loop_cuts.hpp>

namespace skelgen::detail {
namespace {

template <typename Scalar>
void check_surface(const TriangleMesh<Scalar>& mesh) {
    if (mesh.vertices.rows() < 4 || mesh.faces.rows() < 4)
        throw Error(ErrorCode::bad_input,
                    "the mesh has fewer than four vertices or faces; a body needs a closed surface");
    if (!mesh.vertices.allFinite())
        throw Error(ErrorCode::bad_input, "the mesh has a coordinate that is not a finite number; repair it");
    if (mesh.faces.minCoeff() < 0 || mesh.faces.maxCoeff() >= mesh.vertices.rows())
        throw Error(ErrorCode::bad_input, "a face refers to a vertex that does not exist; repair the mesh");
}

/// Where vertices come from whose sources have sources themselves; -1 stays.
std::vector<int> composed(std::vector<int> source, const std::vector<int>& source_of_source) {
    for (int& v : source)
        if (v >= 0) v = source_of_source[static_cast<std::size_t>(v)];
    return source;
}

/// Vertices whose curve node is one of these.
std::vector<int> vertices_of(const std::vector<int>& nodes, const std::vector<int>& node_of_vertex) {
    std::vector<int> out;
    for (std::size_t v = 0; v < node_of_vertex.size(); ++v)
        if (std::find(nodes.begin(), nodes.end(), node_of_vertex[v]) != nodes.end()) out.push_back(static_cast<int>(v));
    return out;
}

/// Gives vertices that are new in the mesh the curve node of a neighbour.
void spread(std::vector<int>& node_of_vertex, const TriangleMesh<double>& mesh) {
    const auto node = [&](Eigen::Index f, int k) -> int& {
        return node_of_vertex[static_cast<std::size_t>(mesh.faces(f, k))];
    };
    node_of_vertex.resize(static_cast<std::size_t>(mesh.vertices.rows()), -1);
    for (bool changed = true; changed;) {
        changed = false;
        for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
            for (int k = 0; k < 3; ++k) {
                if (node(f, k) >= 0) continue;
                node(f, k) = std::max(node(f, (k + 1) % 3), node(f, (k + 2) % 3));
                changed = changed || node(f, k) >= 0;
            }
    }
}

/// The body with its surface cut; none when that opens no loop, or takes off a limb.
std::optional<BodyCurve> with_cuts(const BodyCurve& found, const std::vector<LoopCut>& cuts,
                                   const ExtractOptions& options) {
    TriangleMesh<double> mesh = found.body.mesh;
    std::vector<int> source = found.body.source;
    std::vector<int> node = node_of_vertex(found.curve, mesh.vertices.rows());
    for (const LoopCut& cut : cuts) {
        CutSurface parted = cut_surface(mesh, vertices_of(cut.limb, node), vertices_of(cut.other, node));
        mesh = std::move(parted.mesh);
        source = composed(std::move(parted.source), source);
        spread(node, mesh);
    }
    BodyCurve out{found.similarity, largest_manifold_part(mesh), {}, {}};
    constexpr double whole = 0.95; // of the area
    if (surface_area(out.body.mesh) < whole * surface_area(found.body.mesh)) return std::nullopt;
    out.body.source = composed(std::move(out.body.source), source);
    out.body.dropped_pieces = found.body.dropped_pieces;
    out.surface = surface_graph(out.body.mesh);
    out.curve = extract_curve(out.body.mesh, out.surface, build_proxy(out.body.mesh, options.proxy), options.curve);
    if (cycle_count(out.curve) >= cycle_count(found.curve)) return std::nullopt;
    return out;
}

} // namespace

template <typename Scalar>
BodyCurve find_body_curve(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    check_surface(mesh);
    TriangleMesh<double> clean{mesh.vertices.template cast<double>(), mesh.faces};
    remove_noise(clean, options.denoise);
    const CanonicalMesh canonical = canonical_form(clean);
    BodyCurve out{canonical.similarity, largest_manifold_part(canonical.mesh), {}, {}};
    out.surface = surface_graph(out.body.mesh);
    const Proxy proxy = build_proxy(out.body.mesh, options.proxy);
    out.curve = extract_curve(out.body.mesh, out.surface, proxy, options.curve);
    out.body.source = composed(std::move(out.body.source), canonical.input_vertex);
    return out;
}

std::optional<BodyCurve> part_contacts(const BodyCurve& found, const SkeletonTemplate& wanted,
                                       const ExtractOptions& options) {
    std::optional<BodyCurve> out = found;
    while (out && cycle_count(out->curve) > 0) {
        const std::vector<LoopCut> cuts = find_loop_cuts(out->curve, wanted, options.matching);
        out = cuts.empty() ? std::nullopt : with_cuts(*out, cuts, options);
    }
    return out;
}

template BodyCurve find_body_curve(const TriangleMesh<float>&, const ExtractOptions&);
template BodyCurve find_body_curve(const TriangleMesh<double>&, const ExtractOptions&);

} // namespace skelgen::detail
