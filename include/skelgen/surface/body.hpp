#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/face_tree.hpp>
#include <skelgen/surface/similarity.hpp>
#include <skelgen/surface/winding_tree.hpp>

namespace skelgen {

/// The surface that every later stage works on: one manifold piece in canonical form (unit area, centred, principal
/// axes along x, y, z, faces outwards), what is known of its connectivity, and the way back to the input.
template <typename Scalar = double>
struct Body {
    TriangleMesh<Scalar> mesh;
    Triangles adjacency;                                  ///< as from core::face_adjacency(mesh.faces)
    core::SurfaceGraph<Scalar> graph;                     ///< as from core::surface_graph(mesh, adjacency)
    surface::FaceTree<Scalar> tree;                       ///< of the mesh
    std::optional<surface::WindingTree<Scalar>> windings; ///< of the mesh where it is open
    bool is_closed = false;                               ///< no edge of the mesh is on a boundary
    Similarity<Scalar> similarity;                        ///< from the input's coordinates to the mesh's
    std::vector<int> source;          ///< per vertex that of the input at the same place (6e-8 apart at most where the
                                      ///< input was no sound surface), -1 for those added
    std::vector<int> nearest;         ///< per vertex of the input the one that stands for it, -1 where it was left out;
                                      ///< empty where `source` says it all: no two of the input share one
    int dropped_pieces = 0;           ///< connected pieces smaller than this one, left out
    std::vector<std::string> repairs; ///< what was done to the input and how much, one sentence each
    std::vector<std::vector<int>> rims = {}; ///< per hole of the input that was closed the vertices around it, in order
};

namespace surface {

/// A body of that mesh, with its connectivity; `mesh` must be manifold and in canonical form. O(n log n).
template <typename Scalar>
[[nodiscard]] Body<Scalar> make_body(TriangleMesh<Scalar> mesh, const Similarity<Scalar>& similarity,
                                     std::vector<int> source, int dropped_pieces);

/// Does the body's surface wind around a place, in its canonical form? As the winding number, 0.5 at least, says it; of
/// a closed surface by a ray's crossings. O(log faces), of a closed surface for each face that the ray comes near.
template <typename Scalar>
[[nodiscard]] bool is_inside(const Body<Scalar>& body, const Vector3<Scalar>& place);

/// Where vertices come from whose sources have sources themselves; -1 stays. O(n).
[[nodiscard]] inline std::vector<int> composed(std::vector<int> source, const std::vector<int>& source_of_source) {
    for (int& v : source)
        if (v >= 0) v = source_of_source[static_cast<std::size_t>(v)];
    return source;
}

/// `Body::nearest` for a body whose vertices come from those of another one, -1 for new ones. O(n).
[[nodiscard]] inline std::vector<int> carried_over(std::vector<int> nearest, const std::vector<int>& source) {
    std::vector<int> now;
    for (std::size_t v = 0; v < source.size(); ++v) {
        if (source[v] < 0) continue;
        if (static_cast<std::size_t>(source[v]) >= now.size()) now.resize(static_cast<std::size_t>(source[v]) + 1, -1);
        if (int& first = now[static_cast<std::size_t>(source[v])]; first < 0) first = static_cast<int>(v);
    }
    for (int& v : nearest)
        v = v >= 0 && static_cast<std::size_t>(v) < now.size() ? now[static_cast<std::size_t>(v)] : -1;
    return nearest;
}

/// The rims (`Body::rims`) of a surface on another one, whose vertices come from those of the first: `source` per
/// vertex, -1 for new ones. Rims of which a vertex is gone are left out. O(n).
[[nodiscard]] inline std::vector<std::vector<int>> carried_rims(const std::vector<std::vector<int>>& rims,
                                                                const std::vector<int>& source) {
    std::vector<std::vector<int>> out;
    if (rims.empty()) return out;
    std::vector<int> now; // per old vertex
    for (std::size_t v = source.size(); v-- > 0;) {
        if (source[v] < 0) continue;
        const auto old = static_cast<std::size_t>(source[v]);
        if (old >= now.size()) now.resize(old + 1, -1);
        now[old] = static_cast<int>(v);
    }
    for (std::vector<int> rim : rims) {
        for (int& v : rim) v = static_cast<std::size_t>(v) < now.size() ? now[static_cast<std::size_t>(v)] : -1;
        if (std::find(rim.begin(), rim.end(), -1) == rim.end()) out.push_back(std::move(rim));
    }
    return out;
}

/// The body with another surface, whose vertices come from those of the old one: `source` per vertex, -1 for new ones.
/// `mesh` as for make_body. O(n log n).
template <typename Scalar>
[[nodiscard]] Body<Scalar> resurfaced(Body<Scalar> body, TriangleMesh<Scalar> mesh, std::vector<int> source);

/// A curve skeleton of the body in the input's coordinates. Its regions index the input's vertices; where fans of faces
/// touch, several vertices of the body stand for one of the input: it goes to the first region that has it. O(n).
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> to_input(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve);

/// A kinematic skeleton of the body in the input's coordinates. O(joints).
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> to_input(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton);

/// A skeleton in the input's coordinates in those of the body. O(joints).
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> to_body(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton);

} // namespace surface
} // namespace skelgen

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/body.hpp>
#endif
