#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/geodesics.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/denoise.hpp>
#include <skelgen/surface/face_tree.hpp>
#include <skelgen/surface/lattice.hpp>
#include <skelgen/surface/lattice_surface.hpp>
#include <skelgen/surface/manifold_parts.hpp>
#include <skelgen/surface/pieces.hpp>
#include <skelgen/surface/rounded.hpp>
#include <skelgen/surface/small_parts.hpp>
#include <skelgen/surface/winding_tree.hpp>

namespace skelgen::hands {

/// Where a hand is, as the skeleton has it.
template <typename Scalar = double>
struct HandPlace {
    Vector3<Scalar> elbow, wrist, knuckles, tip;

    /// From the wrist to the fingertip: the unit of all that is said about a hand.
    [[nodiscard]] Scalar length() const { return (tip - wrist).norm(); }

    /// How long it is when it is stretched: a fist's tip is near the wrist, but its digits are as long as others'.
    [[nodiscard]] Scalar stretched() const {
        constexpr Scalar of_forearm = Scalar(0.74); // people's: .108 and .146 of the body's height (Win09)
        return std::max(length(), of_forearm * (wrist - elbow).norm());
    }
};

/// The surface of a hand, and how far its places are from the forearm along it.
template <typename Scalar = double>
struct HandSurface {
    TriangleMesh<Scalar> mesh;
    Triangles adjacency; ///< as from core::face_adjacency
    core::SurfaceGraph<Scalar> graph;
    std::vector<int> source;         ///< per vertex that of the surface it was taken from
    std::vector<bool> is_at_rim;     ///< per vertex: the surface goes on beyond it
    Eigen::VectorX<Scalar> distance; ///< per vertex, from a plane across the forearm
};

namespace detail {

/// All relative to the hand's length.
template <typename Scalar>
struct Reach {
    /// How far behind the wrist a hand's surface begins: wrists are found to a fifth of a hand's length, and figures'
    /// thumbs leave the hand at the wrist itself. Chosen on figures of one maker.
    static constexpr Scalar behind = Scalar(0.5);
    static constexpr Scalar around = Scalar(1.6);  ///< of the surface that counts, from the wrist, of a stretched hand
    static constexpr Scalar rim = Scalar(0.35);    ///< of the rims above the lowest place that are the forearm's
    static constexpr Scalar bottom = Scalar(0.05); ///< of a closed surface, which has none
    static constexpr Scalar cell = Scalar(1) / 48; ///< of an envelope: a finger is four to five cells thick
};

/// Across the arm, where the surface of a hand begins.
template <typename Scalar>
struct ArmPlane {
    Vector3<Scalar> normal, origin;

    explicit ArmPlane(const HandPlace<Scalar>& place) {
        const Vector3<Scalar> forearm = (place.wrist - place.elbow).normalized();
        normal = (forearm + (place.knuckles - place.wrist).normalized()).normalized();
        origin = place.wrist - Reach<Scalar>::behind * place.length() * forearm;
    }
    [[nodiscard]] Scalar height(const Vector3<Scalar>& p) const { return normal.dot(p - origin); }
};

/// Those of the faces beyond the plane and near the hand that hang together with the one nearest to the knuckles.
template <typename Scalar>
std::vector<int> faces_of_hand(const TriangleMesh<Scalar>& mesh, const HandPlace<Scalar>& place) {
    const ArmPlane<Scalar> plane(place);
    const Scalar reach = Reach<Scalar>::around * place.stretched();
    const auto n = static_cast<std::size_t>(mesh.vertices.rows());
    std::vector<bool> is_near(n);
    for (std::size_t v = 0; v < n; ++v) {
        const Vector3<Scalar> p = core::point(mesh.vertices, static_cast<Eigen::Index>(v));
        is_near[v] = plane.height(p) > 0 && (p - place.wrist).norm() < reach;
    }
    core::DisjointSets parts(n);
    std::vector<int> faces;
    const auto corner = [&](int f, int k) { return static_cast<std::size_t>(mesh.faces(f, k)); };
    int nearest = -1;
    Scalar least = std::numeric_limits<Scalar>::infinity();
    for (int f = 0; f < static_cast<int>(mesh.faces.rows()); ++f) {
        if (!is_near[corner(f, 0)] || !is_near[corner(f, 1)] || !is_near[corner(f, 2)]) continue;
        faces.push_back(f);
        parts.unite(corner(f, 0), corner(f, 1));
        parts.unite(corner(f, 0), corner(f, 2));
        const Scalar distance = surface::distance_to_triangle<Scalar>(
            place.knuckles, core::point(mesh.vertices, mesh.faces(f, 0)), core::point(mesh.vertices, mesh.faces(f, 1)),
            core::point(mesh.vertices, mesh.faces(f, 2)));
        if (!(distance < least)) continue;
        least = distance;
        nearest = f;
    }
    if (nearest < 0) return {};
    const std::size_t wanted = parts.find(corner(nearest, 0));
    std::erase_if(faces, [&](int f) { return parts.find(corner(f, 0)) != wanted; });
    return faces;
}

/// Shortest ways over the surface from places that begin with distances; infinite where none leads.
template <typename Scalar>
Eigen::VectorX<Scalar> distances_with(const core::SurfaceGraph<Scalar>& graph,
                                      const std::vector<std::pair<Scalar, int>>& sources) {
    using Entry = std::pair<Scalar, int>;
    Eigen::VectorX<Scalar> distance =
        Eigen::VectorX<Scalar>::Constant(graph.size(), std::numeric_limits<Scalar>::infinity());
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> pending;
    const auto reach = [&](Scalar d, int v) {
        if (!(d < distance[v])) return;
        distance[v] = d;
        pending.emplace(d, v);
    };
    for (const auto& [d, v] : sources) reach(d, v);
    while (!pending.empty()) {
        const auto [d, v] = pending.top();
        pending.pop();
        if (d > distance[v]) continue;
        for (const auto& [w, length] : graph.neighbours[static_cast<std::size_t>(v)]) reach(d + length, w);
    }
    return distance;
}

/// Distances at the lattice's nodes up to a cell from the faces that come near it.
template <typename Scalar>
surface::SparseGrid<Scalar> band_in(const surface::Lattice<Scalar>& lattice, const TriangleMesh<Scalar>& faces) {
    constexpr Scalar longest_in_cells = 2;
    const Scalar cell = lattice.cell;
    surface::SparseGrid<Scalar> distance(lattice.nodes, std::numeric_limits<Scalar>::infinity());
    surface::for_each_small_part(faces, longest_in_cells * cell, [&](const surface::Corners<Scalar>& t) {
        surface::LatticeNode first{}, last{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto axis = static_cast<Eigen::Index>(k);
            const Scalar low = std::min(std::min(t[0][axis], t[1][axis]), t[2][axis]) - lattice.origin[axis];
            const Scalar high = std::max(std::max(t[0][axis], t[1][axis]), t[2][axis]) - lattice.origin[axis];
            const auto top = static_cast<Scalar>(lattice.nodes[k] - 1);
            first[k] = static_cast<int>(std::clamp(std::floor(low / cell), Scalar(0), top));
            last[k] = static_cast<int>(std::clamp(std::ceil(high / cell), Scalar(0), top));
        }
        surface::LatticeNode node{};
        for (node[0] = first[0]; node[0] <= last[0]; ++node[0])
            for (node[1] = first[1]; node[1] <= last[1]; ++node[1])
                for (node[2] = first[2]; node[2] <= last[2]; ++node[2]) {
                    const Scalar d = surface::distance_to_triangle<Scalar>(lattice.place(node), t[0], t[1], t[2]);
                    if (d > cell) continue;
                    Scalar& known = distance.at(node);
                    known = std::min(known, d);
                }
    });
    return distance;
}

/// The faces that come into a cube.
template <typename Scalar>
TriangleMesh<Scalar> faces_in_cube(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& centre, Scalar half) {
    std::vector<int> near;
    for (int f = 0; f < static_cast<int>(mesh.faces.rows()); ++f) {
        const Vector3<Scalar> a = core::point(mesh.vertices, mesh.faces(f, 0)) - centre;
        const Vector3<Scalar> b = core::point(mesh.vertices, mesh.faces(f, 1)) - centre;
        const Vector3<Scalar> c = core::point(mesh.vertices, mesh.faces(f, 2)) - centre;
        const Vector3<Scalar> low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
        if (low.maxCoeff() <= half && high.minCoeff() >= -half) near.push_back(f);
    }
    TriangleMesh<Scalar> out;
    out.vertices = mesh.vertices;
    out.faces.resize(static_cast<Eigen::Index>(near.size()), 3);
    for (std::size_t i = 0; i < near.size(); ++i) out.faces.row(static_cast<Eigen::Index>(i)) = mesh.faces.row(near[i]);
    return out;
}

/// Per vertex of a mesh without seams: is it of a piece that leaves a hand's surroundings, and not along the arm? So do
/// things that hands hold, and clothes and the body behind a hand. The arm's own piece winds around its bones.
template <typename Scalar>
std::vector<bool> others_vertices(const TriangleMesh<Scalar>& mesh, const HandPlace<Scalar>& place) {
    // Of the way from the elbow to the wrist: also a sleeve that ends before the hand has one of them inside.
    constexpr std::array<Scalar, 3> along{Scalar(0.5), Scalar(0.75), Scalar(1)};
    const auto n = static_cast<std::size_t>(mesh.vertices.rows());
    const auto corner = [&](Eigen::Index f, int k) { return static_cast<std::size_t>(mesh.faces(f, k)); };
    core::DisjointSets pieces(n);
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (const int k : {1, 2}) pieces.unite(corner(f, 0), corner(f, k));

    const Scalar reach = Reach<Scalar>::around * place.stretched();
    std::vector<bool> comes_near(n), leaves(n);
    for (std::size_t v = 0; v < n; ++v) {
        const Scalar from_wrist = (core::point(mesh.vertices, static_cast<Eigen::Index>(v)) - place.wrist).norm();
        (from_wrist < reach ? comes_near : leaves)[pieces.find(v)] = true;
    }
    std::vector<std::vector<int>> faces(n); // of those that may be another's
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        if (const std::size_t p = pieces.find(corner(f, 0)); comes_near[p] && leaves[p])
            faces[p].push_back(static_cast<int>(f));
    std::vector<bool> is_others(n);
    TriangleMesh<Scalar> piece{mesh.vertices, {}};
    for (std::size_t p = 0; p < n; ++p) {
        if (faces[p].empty()) continue;
        piece.faces = mesh.faces(faces[p], Eigen::all);
        is_others[p] = std::none_of(along.begin(), along.end(), [&](Scalar part) {
            const Vector3<Scalar> on_bone = place.elbow + part * (place.wrist - place.elbow);
            return std::abs(core::winding_number<Scalar>(piece, on_bone)) > Scalar(0.5);
        });
    }
    std::vector<bool> out(n);
    for (std::size_t v = 0; v < n; ++v) out[v] = is_others[pieces.find(v)];
    return out;
}

/// Places of joints by their names without the side, and of an end point; false where one is missing.
template <typename Scalar>
bool read_places(const KinematicSkeleton<Scalar>& skeleton, Side side,
                 std::initializer_list<std::pair<const char*, Vector3<Scalar>*>> joints, const char* end_point,
                 Vector3<Scalar>& end_place) {
    const std::string prefix(side_prefix(side));
    for (const auto& [joint, place] : joints) {
        const int found = find_joint(skeleton, prefix + joint);
        if (found < 0 || !skeleton.joints[static_cast<std::size_t>(found)].is_present) return false;
        *place = skeleton.joints[static_cast<std::size_t>(found)].position;
    }
    const auto end = std::find_if(skeleton.end_points.begin(), skeleton.end_points.end(),
                                  [&](const auto& each) { return each.first == prefix + end_point; });
    if (end == skeleton.end_points.end()) return false;
    end_place = end->second;
    return true;
}

} // namespace detail

/// A mesh without the pieces that leave a hand's surroundings, but do not wind around the forearm: what the hand holds,
/// clothes and the body behind it. None where all are the arm's, or none is. `mesh` must have no seams and be in the
/// unit of `place`. O(n log n), and O(faces) for each piece that comes near.
template <typename Scalar>
std::optional<TriangleMesh<Scalar>> arm_pieces(const TriangleMesh<Scalar>& mesh, const HandPlace<Scalar>& place) {
    const std::vector<bool> is_others = detail::others_vertices(mesh, place);
    const auto n = mesh.faces.rows();
    TriangleMesh<Scalar> out;
    out.faces.resize(n, 3);
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < n; ++f)
        if (!is_others[static_cast<std::size_t>(mesh.faces(f, 0))]) out.faces.row(kept++) = mesh.faces.row(f);
    if (kept == n || kept == 0) return std::nullopt;
    out.faces.conservativeResize(kept, 3);
    out.vertices = mesh.vertices;
    return out;
}

/// That of a finished skeleton's hand; none where the arm ends before it, or where its joints lie in one place.
template <typename Scalar>
std::optional<HandPlace<Scalar>> hand_place(const KinematicSkeleton<Scalar>& skeleton, Side side) {
    HandPlace<Scalar> out;
    const bool is_there = detail::read_places(
        skeleton, side,
        {std::pair{"elbow", &out.elbow}, std::pair{"wrist", &out.wrist}, std::pair{"hand", &out.knuckles}}, "fingertip",
        out.tip);
    const bool has_bones = (out.wrist - out.elbow).norm() > 0 && (out.knuckles - out.wrist).norm() > 0;
    if (!is_there || !has_bones || !(out.length() > 0)) return std::nullopt;
    return out;
}

/// That of the front of a foot, whose digits are its toes: the instep for the wrist, the ball for the knuckles; none
/// where the leg ends before the foot.
template <typename Scalar>
std::optional<HandPlace<Scalar>> toes_place(const KinematicSkeleton<Scalar>& skeleton, Side side) {
    constexpr Scalar behind_ball = Scalar(0.5); // of the way from the ball to the end of the toes
    HandPlace<Scalar> out;
    if (!detail::read_places(skeleton, side, {std::pair{"ankle", &out.elbow}, std::pair{"foot", &out.knuckles}}, "toe",
                             out.tip))
        return std::nullopt;
    const Vector3<Scalar> toes = out.tip - out.knuckles;
    if (!(toes.norm() > 0)) return std::nullopt;
    out.wrist = out.knuckles - behind_ball * toes;
    out.elbow = out.wrist - (1 + behind_ball) * toes;
    return out;
}

/// What of a surface is beyond a plane across the forearm and near the hand: of the parts that hang together the one
/// nearest to the knuckles. None where there is none, or too little of it to have digits. `mesh` must be edge-manifold
/// and in the unit of `place`. O(faces + k log k) for the k vertices there.
template <typename Scalar>
std::optional<HandSurface<Scalar>> hand_surface(const TriangleMesh<Scalar>& mesh, const HandPlace<Scalar>& place) {
    constexpr std::size_t least_faces = 12;
    const std::vector<int> faces = detail::faces_of_hand(mesh, place);
    if (faces.size() < least_faces) return std::nullopt;
    HandSurface<Scalar> out;
    std::vector<int> number(static_cast<std::size_t>(mesh.vertices.rows()), -1);
    out.mesh.faces.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.faces(faces[i], k);
            int& own = number[static_cast<std::size_t>(v)];
            if (own < 0) {
                own = static_cast<int>(out.source.size());
                out.source.push_back(v);
            }
            out.mesh.faces(static_cast<Eigen::Index>(i), k) = own;
        }
    const auto n = static_cast<Eigen::Index>(out.source.size());
    out.mesh.vertices.resize(n, 3);
    for (Eigen::Index v = 0; v < n; ++v)
        out.mesh.vertices.row(v) = mesh.vertices.row(out.source[static_cast<std::size_t>(v)]);
    out.adjacency = core::face_adjacency(out.mesh.faces);
    out.graph = core::surface_graph(out.mesh, out.adjacency);
    out.is_at_rim.assign(out.source.size(), false);
    for (Eigen::Index f = 0; f < out.mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            if (out.adjacency(f, k) < 0)
                for (const int end : {k, (k + 1) % 3})
                    out.is_at_rim[static_cast<std::size_t>(out.mesh.faces(f, end))] = true;

    const detail::ArmPlane<Scalar> plane(place);
    std::vector<Scalar> heights;
    for (Eigen::Index v = 0; v < n; ++v) heights.push_back(plane.height(core::point(out.mesh.vertices, v)));
    const Scalar lowest = *std::min_element(heights.begin(), heights.end());
    std::vector<std::pair<Scalar, int>> sources;
    using Reach = detail::Reach<Scalar>;
    for (std::size_t v = 0; v < heights.size(); ++v) {
        const Scalar above = (heights[v] - lowest) / place.length();
        if (above < Reach::bottom || (out.is_at_rim[v] && above < Reach::rim))
            sources.emplace_back(heights[v], static_cast<int>(v));
    }
    out.distance = detail::distances_with(out.graph, sources);
    for (Eigen::Index v = 0; v < n; ++v)
        if (!std::isfinite(out.distance[v])) out.distance[v] = 0; // hangs on by a vertex alone
    return out;
}

/// As hand_surface, of any mesh without seams: cut where it is not manifold, and where its faces are few made rounder.
/// Digits that touch each other, or what they hold, stay apart on it, as they do in no envelope. O(n log n).
template <typename Scalar>
std::optional<HandSurface<Scalar>> own_hand_surface(const TriangleMesh<Scalar>& mesh, const HandPlace<Scalar>& place) {
    constexpr Eigen::Index least_faces = 1000; // 200 a digit: its rings have corners enough then
    constexpr int most_passes = 2;             // each makes four faces of one
    const Scalar half = detail::Reach<Scalar>::around * place.stretched();
    const auto near = surface::used_part(detail::faces_in_cube<Scalar>(mesh, place.wrist, half));
    TriangleMesh<Scalar> sound;
    for (const auto& part : surface::manifold_parts(near.mesh))
        sound = sound.faces.rows() > 0 ? surface::side_by_side(sound, part.mesh) : part.mesh;
    std::optional<HandSurface<Scalar>> hand = hand_surface(sound, place);
    for (int pass = 0; pass < most_passes && hand && hand->mesh.faces.rows() < least_faces; ++pass)
        hand = hand_surface(surface::rounded(hand->mesh), place);
    return hand;
}

/// One closed surface around all that encloses something near a hand, of cells as fine as digits need: where the
/// winding number is one half (JKS13). For hands of many pieces, of few triangles, or that an envelope of the whole
/// body has no room for. `tree` of `mesh`, whose faces must look outwards. O(faces + cells log faces).
template <typename Scalar>
TriangleMesh<Scalar> hand_envelope(const TriangleMesh<Scalar>& mesh, const surface::WindingTree<Scalar>& tree,
                                   const HandPlace<Scalar>& place) {
    constexpr int smoothing_passes = 4; // so that cells do not show
    using Reach = detail::Reach<Scalar>;
    const Scalar length = place.length(), half = Reach::around * place.stretched();
    const Vector3<Scalar> centre =
        place.wrist + Scalar(0.4) * length * (place.knuckles - place.wrist).normalized(); // of a hand, about
    surface::Lattice<Scalar> lattice;
    lattice.cell = Reach::cell * length;
    const int nodes = static_cast<int>(2 * half / lattice.cell) + 2;
    lattice.nodes = {nodes, nodes, nodes};
    lattice.origin = centre - Vector3<Scalar>::Constant(lattice.cell * static_cast<Scalar>(nodes - 1) / 2);

    const surface::SparseGrid<Scalar> distance = detail::band_in(lattice, detail::faces_in_cube(mesh, centre, half));
    std::vector<surface::LatticeNode> seeds;
    distance.for_each([&](const surface::LatticeNode& node, Scalar d) {
        if (d <= lattice.cell && lattice.has(node)) seeds.push_back(node);
    });
    surface::LatticeShape<Scalar> shape;
    shape.depth = [&](const surface::LatticeNode& node) {
        return tree.winding_number(mesh, lattice.place(node)) - Scalar(0.5);
    };
    shape.crossing = [&](const surface::LatticeNode& in, const surface::LatticeNode& out, Scalar depth_in,
                         Scalar depth_out) {
        const Scalar d_in = distance.get(in), d_out = distance.get(out), sum = d_in + d_out;
        constexpr Scalar rounded_up = Scalar(1.001);
        if (sum <= rounded_up * lattice.cell) return sum > 0 ? d_in / sum : Scalar(0.5);
        return std::clamp(depth_in / (depth_in - depth_out), Scalar(0), Scalar(1));
    };
    return surface::smoothed(surface::lattice_surface(lattice, seeds, shape), smoothing_passes);
}

} // namespace skelgen::hands
