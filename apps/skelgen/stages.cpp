#include "stages.hpp"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/embedding/embed.hpp>

namespace skelgen::cli {
namespace {

std::string surface_text(const TriangleMesh<double>& mesh, const Body<double>& body) {
    std::ostringstream text;
    text << mesh.vertices.rows() << " vertices and " << mesh.faces.rows() << " faces; of them "
         << body.mesh.faces.rows() << " faces are the body's, " << body.dropped_pieces
         << (body.dropped_pieces == 1 ? " piece is" : " pieces are") << " left out";
    const auto open = (body.adjacency.array() < 0).count();
    text << "; " << (open == 0 ? "closed" : std::to_string(open) + " open edges");
    return text.str();
}

std::string curve_text(const curve::CurveResult<double>& found) {
    const core::CurveGraph<double> graph = core::curve_graph(found.curve);
    int ends = 0, junctions = 0;
    for (int v = 0; v < graph.size(); ++v) {
        ends += graph.degree(v) == 1 ? 1 : 0;
        junctions += graph.degree(v) > 2 ? 1 : 0;
    }
    std::ostringstream text;
    text << graph.size() << " nodes, " << ends << " ends, " << junctions << " junctions, "
         << core::cycle_count(found.curve) << " loops";
    if (found.is_point) text << "; too compact to be contracted to a curve";
    if (!found.converged) text << "; the contraction did not converge";
    return text.str();
}

std::string embedding_text(const CurveSkeleton<double>& curve, const SkeletonTemplate& wanted,
                           const embedding::MatchingOptions& options) {
    const Outcome<embedding::Embedding> found = embedding::embed(curve, wanted, options);
    if (!found) return found.failure().what;
    std::ostringstream text;
    text << found->matched_nodes << " ends and junctions matched, distortion " << found->distortion
         << "; the curve goes on beyond them for " << embedding::unmatched_reach(curve, *found) << " of its length";
    return text.str();
}

void print(const std::filesystem::path& mesh, const char* stage, const std::string& text) {
    std::fprintf(stderr, "%s: %s: %s\n", mesh.filename().c_str(), stage, text.c_str());
}

} // namespace

void print_stages(const MeshInput& input, const ExtractOptions& options) {
    const std::filesystem::path& file = input.file;
    const TriangleMesh<double> mesh = load_mesh(input);
    const Body<double> body = prepare(mesh, options.prepare);
    print(file, "surface", surface_text(mesh, body));
    const curve::CurveResult<double> found = find_curve(body, options.curve);
    print(file, "curve", curve_text(found));
    print(file, "template", embedding_text(found.curve, options.skeleton_template, options.matching));
}

} // namespace skelgen::cli
