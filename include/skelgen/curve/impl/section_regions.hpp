#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/curve/branch_centring.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

namespace detail {

template <typename Scalar>
using Claims = std::vector<core::Source<Scalar>>;

/// Sections claim the corners of the faces that they cut.
template <typename Scalar>
void claim_sections(Claims<Scalar>& claims, const CentredBranches<Scalar>& centred, const JoinedCurve<Scalar>& joined,
                    const Body<Scalar>& body, const std::vector<int>& origin_of_vertex) {
    for (std::size_t b = 0; b < centred.sections.size(); ++b) {
        const std::vector<int>& origins = centred.branched.branches[b].origins;
        for (std::size_t i = 0; i < centred.sections[b].size(); ++i) {
            const BranchSection<Scalar>& section = centred.sections[b][i];
            if (section.weight < sure_section<Scalar>) continue;
            for (std::size_t p = 0; p < section.contour.points.size(); ++p)
                for (int k = 0; k < 3; ++k) {
                    const int v = body.mesh.faces(section.contour.faces[p], k);
                    if (!std::binary_search(origins.begin(), origins.end(),
                                            origin_of_vertex[static_cast<std::size_t>(v)]))
                        continue;
                    const Vector3<Scalar> away = core::point(body.mesh.vertices, v) - section.contour.points[p];
                    claims.push_back({away.norm(), joined.nodes_of_branch[b][i], v});
                }
        }
    }
}

/// Nodes without a section of their own, and all ends and junctions, claim the vertex that their ball comes nearest to.
template <typename Scalar>
void claim_balls(Claims<Scalar>& claims, const CurveSkeleton<Scalar>& curve, const Body<Scalar>& body,
                 const std::vector<bool>& has_section) {
    for (std::size_t k = 0; k < has_section.size(); ++k) {
        if (has_section[k]) continue;
        const Vector3<Scalar> place = core::point(curve.nodes, static_cast<Eigen::Index>(k));
        const int v = body.tree.nearest_vertex(body.mesh, place);
        claims.push_back(
            {(core::point(body.mesh.vertices, v) - place).norm() - curve.radii[k], static_cast<int>(k), v});
    }
}

} // namespace detail

/// Per node of a curve the radius of the ball around it that touches the surface. O(k log faces).
template <typename Scalar>
std::vector<Scalar> ball_radii(const Points<Scalar>& nodes, const Body<Scalar>& body) {
    constexpr std::size_t in_a_row = 16;
    std::vector<Scalar> out(static_cast<std::size_t>(nodes.rows()));
    core::parallel_for(out.size(), in_a_row, [&](std::size_t k) {
        out[k] = body.tree.distance(body.mesh, core::point(nodes, static_cast<Eigen::Index>(k)));
    });
    return out;
}

/// The curve of centred branches: each node with the radius of the ball around it that touches the surface, and with
/// the vertices that are nearest along the surface to the section across its branch or to its ball, of those that
/// belonged to its branch: `origin_of_vertex` says so for each, by the numbers of Branch::origins. Every vertex comes
/// into one region. O(n log n).
template <typename Scalar>
CurveSkeleton<Scalar> curve_with_regions(const CentredBranches<Scalar>& centred, const Body<Scalar>& body,
                                         const std::vector<int>& origin_of_vertex) {
    const JoinedCurve<Scalar> joined = join_branches(centred.branched);
    CurveSkeleton<Scalar> out = joined.curve;
    out.radii = ball_radii(out.nodes, body);
    detail::Claims<Scalar> claims;
    detail::claim_sections(claims, centred, joined, body, origin_of_vertex);
    std::vector<bool> has_section(out.radii.size(), false);
    for (std::size_t b = 0; b < centred.sections.size(); ++b)
        for (std::size_t i = 0; i < centred.sections[b].size(); ++i)
            if (centred.sections[b][i].weight >= sure_section<Scalar>)
                has_section[static_cast<std::size_t>(joined.nodes_of_branch[b][i])] = true;
    detail::claim_balls(claims, out, body, has_section);
    const std::vector<int> owner = core::nearest_source(body.graph, claims);
    for (std::size_t v = 0; v < owner.size(); ++v)
        out.regions[static_cast<std::size_t>(owner[v])].push_back(static_cast<int>(v));
    return out;
}

} // namespace skelgen::curve
