#pragma once

#include <skelgen/surface/body.hpp>

#include <unordered_set>
#include <utility>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/geodesics.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::surface {

template <typename Scalar>
Body<Scalar> make_body(TriangleMesh<Scalar> mesh, const Similarity<Scalar>& similarity, std::vector<int> source,
                       int dropped_pieces) {
    Triangles adjacency = core::face_adjacency(mesh.faces);
    core::CurveGraph<Scalar> graph = core::surface_graph(mesh, adjacency);
    FaceTree<Scalar> tree(mesh);
    return {std::move(mesh),
            std::move(adjacency),
            std::move(graph),
            std::move(tree),
            similarity,
            std::move(source),
            {},
            dropped_pieces,
            {}};
}

template <typename Scalar>
Body<Scalar> resurfaced(Body<Scalar> body, TriangleMesh<Scalar> mesh, std::vector<int> source) {
    std::vector<int> nearest = carried_over(std::move(body.nearest), source);
    Body<Scalar> out =
        make_body(std::move(mesh), body.similarity, composed(std::move(source), body.source), body.dropped_pieces);
    out.nearest = std::move(nearest);
    out.repairs = std::move(body.repairs);
    return out;
}

namespace detail {

/// The regions where each vertex of the input has one that stands for it: it goes where that one is.
template <typename Scalar>
std::vector<std::vector<int>> regions_of_input(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve) {
    std::vector<int> region(static_cast<std::size_t>(body.mesh.vertices.rows()), -1);
    for (std::size_t k = 0; k < curve.regions.size(); ++k)
        for (const int v : curve.regions[k]) region[static_cast<std::size_t>(v)] = static_cast<int>(k);
    std::vector<std::vector<int>> out(curve.regions.size());
    for (std::size_t v = 0; v < body.nearest.size(); ++v)
        if (const int place = body.nearest[v]; place >= 0 && region[static_cast<std::size_t>(place)] >= 0)
            out[static_cast<std::size_t>(region[static_cast<std::size_t>(place)])].push_back(static_cast<int>(v));
    return out;
}

} // namespace detail

template <typename Scalar>
CurveSkeleton<Scalar> to_input(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve) {
    CurveSkeleton<Scalar> out = curve;
    for (Eigen::Index v = 0; v < curve.nodes.rows(); ++v)
        out.nodes.row(v) = body.similarity.to_input(core::point(curve.nodes, v)).transpose();
    for (Scalar& radius : out.radii) radius *= body.similarity.scale;
    if (!body.nearest.empty()) {
        out.regions = detail::regions_of_input(body, curve);
        return out;
    }
    std::unordered_set<int> taken;
    for (std::size_t k = 0; k < curve.regions.size(); ++k) {
        out.regions[k].clear();
        for (const int v : curve.regions[k])
            if (const int vertex = body.source[static_cast<std::size_t>(v)]; vertex >= 0 && taken.insert(vertex).second)
                out.regions[k].push_back(vertex);
    }
    return out;
}

template <typename Scalar>
KinematicSkeleton<Scalar> to_input(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton) {
    const Similarity<Scalar>& similarity = body.similarity;
    KinematicSkeleton<Scalar> out = skeleton;
    for (Joint<Scalar>& joint : out.joints) {
        joint.position = similarity.to_input(joint.position);
        joint.radius *= similarity.scale;
    }
    for (auto& [name, point] : out.end_points) point = similarity.to_input(point);
    out.frame = {similarity.to_input(skeleton.frame.origin), similarity.direction_to_input(skeleton.frame.left),
                 similarity.direction_to_input(skeleton.frame.forward),
                 similarity.direction_to_input(skeleton.frame.up)};
    return out;
}

template <typename Scalar>
KinematicSkeleton<Scalar> to_body(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton) {
    const Similarity<Scalar>& similarity = body.similarity;
    KinematicSkeleton<Scalar> out = skeleton;
    for (Joint<Scalar>& joint : out.joints) {
        joint.position = similarity.to_canonical(joint.position);
        joint.radius /= similarity.scale;
    }
    for (auto& [name, place] : out.end_points) place = similarity.to_canonical(place);
    out.frame = {similarity.to_canonical(skeleton.frame.origin), similarity.rotation * skeleton.frame.left,
                 similarity.rotation * skeleton.frame.forward, similarity.rotation * skeleton.frame.up};
    return out;
}

} // namespace skelgen::surface
