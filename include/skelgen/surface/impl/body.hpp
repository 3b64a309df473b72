#pragma once

#include <skelgen/surface/body.hpp>

#include <optional>
#include <unordered_set>
#include <utility>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/geodesics.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/parallel.hpp>

namespace skelgen::surface {

template <typename Scalar>
Body<Scalar> make_body(TriangleMesh<Scalar> mesh, const Similarity<Scalar>& similarity, std::vector<int> source,
                       int dropped_pieces) {
    Triangles adjacency;
    core::SurfaceGraph<Scalar> graph;
    bool is_closed = false;
    std::optional<FaceTree<Scalar>> tree;
    const auto connect = [&] {
        adjacency = core::face_adjacency(mesh.faces);
        graph = core::surface_graph(mesh, adjacency);
        is_closed = adjacency.rows() > 0 && adjacency.minCoeff() >= 0;
    };
    core::in_parallel(connect, [&] { tree.emplace(mesh); });
    std::optional<WindingTree<Scalar>> windings;
    if (!is_closed) windings.emplace(mesh);
    return {std::move(mesh),
            std::move(adjacency),
            std::move(graph),
            *std::move(tree),
            std::move(windings),
            is_closed,
            similarity,
            std::move(source),
            {},
            dropped_pieces,
            {},
            {}};
}

template <typename Scalar>
bool is_inside(const Body<Scalar>& body, const Vector3<Scalar>& place) {
    if (body.windings) return body.windings->winding_number(body.mesh, place) > Scalar(0.5);
    // In no plane of symmetry; the second and the third, where the first passes through an edge.
    for (const Vector3<double>& way :
         {Vector3<double>(0.48, 0.6, 0.64), Vector3<double>(-0.64, 0.48, 0.6), Vector3<double>(0.6, -0.64, 0.48)}) {
        const Vector3<Scalar> direction = way.cast<Scalar>();
        if (const auto windings = body.tree.windings_along(body.mesh, place, direction)) return *windings > 0;
    }
    return core::winding_number(body.mesh, place) > Scalar(0.5);
}

template <typename Scalar>
Body<Scalar> resurfaced(Body<Scalar> body, TriangleMesh<Scalar> mesh, std::vector<int> source) {
    std::vector<int> nearest = carried_over(std::move(body.nearest), source);
    std::vector<std::vector<int>> rims = carried_rims(body.rims, source);
    Body<Scalar> out =
        make_body(std::move(mesh), body.similarity, composed(std::move(source), body.source), body.dropped_pieces);
    out.nearest = std::move(nearest);
    out.repairs = std::move(body.repairs);
    out.rims = std::move(rims);
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

/// A skeleton in other coordinates, given what becomes there of a place, a direction and a length.
template <typename Scalar, typename Place, typename Direction, typename Length>
KinematicSkeleton<Scalar> in_coordinates(KinematicSkeleton<Scalar> skeleton, const Place& place,
                                         const Direction& direction, const Length& length) {
    for (Joint<Scalar>& joint : skeleton.joints) {
        joint.position = place(joint.position);
        joint.radius = length(joint.radius);
    }
    for (auto& [name, point] : skeleton.end_points) point = place(point);
    BodyFrame<Scalar>& frame = skeleton.frame;
    frame = {place(frame.origin), direction(frame.left), direction(frame.forward), direction(frame.up)};
    return skeleton;
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
    using Vector = Vector3<Scalar>;
    const Similarity<Scalar>& similarity = body.similarity;
    return detail::in_coordinates(
        skeleton, [&](const Vector& p) { return similarity.to_input(p); },
        [&](const Vector& d) { return similarity.direction_to_input(d); },
        [&](Scalar length) { return length * similarity.scale; });
}

template <typename Scalar>
KinematicSkeleton<Scalar> to_body(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton) {
    using Vector = Vector3<Scalar>;
    const Similarity<Scalar>& similarity = body.similarity;
    return detail::in_coordinates(
        skeleton, [&](const Vector& p) { return similarity.to_canonical(p); },
        [&](const Vector& d) -> Vector { return similarity.rotation * d; },
        [&](Scalar length) { return length / similarity.scale; });
}

} // namespace skelgen::surface
