#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <nanoflann.hpp>

#include <skelgen/applications/impl/heat_weights.hpp>
#include <skelgen/applications/joint_weights.hpp>
#include <skelgen/applications/surface_laplacian.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>
#include <skelgen/surface/weld.hpp>

namespace skelgen::applications {

namespace detail {

/// The pieces of an input that are no part of a body, in its coordinates.
template <typename Scalar>
struct LoosePieces {
    TriangleMesh<Scalar> mesh;
    std::vector<int> first; ///< per vertex one of the input's at its place
    std::vector<int> index; ///< per vertex of the input its number here, -1 where it is no loose piece's
    core::DisjointSets pieces;
};

/// Per vertex of an input: does one of the body's stand for it?
template <typename Scalar>
std::vector<bool> named_by(const Body<Scalar>& body, std::size_t vertices) {
    std::vector<bool> out(vertices, false);
    for (const int v : body.source)
        if (v >= 0) out[static_cast<std::size_t>(v)] = true;
    for (std::size_t v = 0; v < body.nearest.size(); ++v)
        if (body.nearest[v] >= 0) out[v] = true;
    return out;
}

template <typename Scalar>
LoosePieces<Scalar> loose_pieces(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body) {
    const auto welded = surface::weld(mesh, Scalar(0));
    const auto n = static_cast<std::size_t>(welded.mesh.vertices.rows());
    core::DisjointSets pieces(n);
    const Triangles& faces = welded.mesh.faces;
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 2; ++k)
            pieces.unite(static_cast<std::size_t>(faces(f, k)), static_cast<std::size_t>(faces(f, k + 1)));
    const std::vector<bool> is_named = named_by(body, welded.placed.size());
    std::vector<bool> is_body(n, false); // per piece, by its representative
    for (std::size_t v = 0; v < is_named.size(); ++v)
        if (is_named[v] && welded.placed[v] >= 0)
            is_body[pieces.find(static_cast<std::size_t>(welded.placed[v]))] = true;

    std::vector<int> number(n, -1);
    int count = 0;
    for (std::size_t v = 0; v < n; ++v)
        if (!is_body[pieces.find(v)]) number[v] = count++;
    LoosePieces<Scalar> out{{Points<Scalar>(count, 3), Triangles(faces.rows(), 3)},
                            std::vector<int>(static_cast<std::size_t>(count), -1),
                            {},
                            core::DisjointSets(static_cast<std::size_t>(count))};
    for (std::size_t v = 0; v < welded.placed.size(); ++v) {
        const int place = welded.placed[v];
        out.index.push_back(place >= 0 ? number[static_cast<std::size_t>(place)] : -1);
        if (out.index.back() < 0) continue;
        out.first[static_cast<std::size_t>(out.index.back())] = static_cast<int>(v);
        const Vector3<Scalar> p =
            body.similarity.to_canonical(core::point(mesh.vertices, static_cast<Eigen::Index>(v)));
        core::set_point<Scalar>(out.mesh.vertices, out.index.back(), p);
    }
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        if (number[static_cast<std::size_t>(faces(f, 0))] < 0) continue;
        for (int k = 0; k < 3; ++k) out.mesh.faces(kept, k) = number[static_cast<std::size_t>(faces(f, k))];
        for (int k = 0; k < 2; ++k)
            out.pieces.unite(static_cast<std::size_t>(out.mesh.faces(kept, k)),
                             static_cast<std::size_t>(out.mesh.faces(kept, k + 1)));
        ++kept;
    }
    out.mesh.faces.conservativeResize(kept, 3);
    return out;
}

/// What lies nearer touches: 3 mm of a person, whose area's square root is a length of 1.4 m.
template <typename Scalar>
constexpr Scalar touching = Scalar(0.002);

/// Per vertex of the loose pieces its gap, `touching` where it is nearer or inside the body.
template <typename Scalar>
std::vector<Scalar> gaps_of(const LoosePieces<Scalar>& loose, const Body<Scalar>& body,
                            const std::vector<Scalar>& gaps) {
    std::vector<Scalar> out;
    for (std::size_t v = 0; v < loose.first.size(); ++v) {
        const Scalar gap = gaps[static_cast<std::size_t>(loose.first[v])];
        const auto is_inside = [&] {
            return surface::is_inside(body, core::point(loose.mesh.vertices, static_cast<Eigen::Index>(v)));
        };
        out.push_back(gap <= touching<Scalar> || is_inside() ? touching<Scalar> : gap);
    }
    return out;
}

/// What a search in a tree of vertices is to find, as nanoflann's result sets are: the nearest vertex of another piece,
/// nearer than the reach.
template <typename Scalar>
class NearestOfOthers {
public:
    NearestOfOthers(const std::vector<std::size_t>& piece_of, std::size_t own, Scalar reach)
        : piece_of_(piece_of), own_(own), squared_(reach * reach) {}

    bool addPoint(Scalar squared, Eigen::Index vertex) {
        if (squared < squared_ && piece_of_[static_cast<std::size_t>(vertex)] != own_) {
            squared_ = squared;
            vertex_ = static_cast<int>(vertex);
        }
        return true; // go on
    }
    [[nodiscard]] Scalar worstDist() const { return squared_; }
    [[nodiscard]] bool full() const { return true; }

    [[nodiscard]] int vertex() const { return vertex_; } ///< -1: none
    [[nodiscard]] Scalar distance() const { return std::sqrt(squared_); }

private:
    const std::vector<std::size_t>& piece_of_;
    std::size_t own_;
    Scalar squared_;
    int vertex_ = -1;
};

/// Of a piece that touches nothing so many vertices, evenly, look for another one: all of them would come upon each
/// other all the way there.
inline constexpr std::size_t most_looks = 256;

/// Pairs of vertices of different loose pieces that touch: each vertex with the nearest of another piece; and of each
/// piece that touches nothing that which lies nearest to another one, where the body is farther.
template <typename Scalar>
std::vector<std::pair<int, int>> touching_pairs(const LoosePieces<Scalar>& loose, const std::vector<Scalar>& gaps) {
    const Points<Scalar>& places = loose.mesh.vertices;
    const nanoflann::KDTreeEigenMatrixAdaptor<Points<Scalar>, 3, nanoflann::metric_L2_Simple> tree(3, places);
    core::DisjointSets pieces = loose.pieces;
    std::vector<std::size_t> piece_of(gaps.size()), size(gaps.size(), 0); // the latter per piece, by representative
    std::vector<Scalar> reach = gaps; // per piece, by its representative: to the body, then to another piece, too
    for (std::size_t v = 0; v < gaps.size(); ++v) {
        piece_of[v] = pieces.find(v);
        ++size[piece_of[v]];
        reach[piece_of[v]] = std::min(reach[piece_of[v]], gaps[v]);
    }
    const auto nearest_to = [&](std::size_t v, Scalar within) {
        NearestOfOthers<Scalar> found(piece_of, piece_of[v], within);
        const auto row = static_cast<Eigen::Index>(v);
        const std::array<Scalar, 3> place{places(row, 0), places(row, 1), places(row, 2)};
        tree.index->findNeighbors(found, place.data(), nanoflann::SearchParams());
        return found;
    };
    std::vector<std::pair<int, int>> out;
    for (std::size_t v = 0; v < gaps.size(); ++v)
        if (const auto found = nearest_to(v, touching<Scalar>); found.vertex() >= 0) {
            reach[piece_of[v]] = touching<Scalar>;
            out.emplace_back(static_cast<int>(v), found.vertex());
        }

    std::map<std::size_t, std::pair<int, int>> nearest; // of a piece that touches nothing
    std::vector<std::size_t> seen(gaps.size(), 0);      // of a piece's vertices
    for (std::size_t v = 0; v < gaps.size(); ++v) {
        const std::size_t piece = piece_of[v], step = (size[piece] + most_looks - 1) / most_looks;
        if (seen[piece]++ % step != 0 || !(reach[piece] > touching<Scalar>)) continue;
        const auto found = nearest_to(v, reach[piece]);
        if (found.vertex() < 0) continue;
        nearest[piece] = {static_cast<int>(v), found.vertex()};
        reach[piece] = found.distance();
    }
    for (const auto& [piece, pair] : nearest) out.push_back(pair);
    return out;
}

/// The part of all directions from a place in which faces are met.
template <typename Scalar>
Scalar surrounded_part(const Vector3<Scalar>& place, const TriangleMesh<Scalar>& mesh, const std::vector<int>& faces) {
    constexpr int looks = 100;
    constexpr Scalar golden = std::numbers::pi_v<Scalar> * (3 - Scalar(2.236067977499790));
    int met = 0;
    for (int i = 0; i < looks; ++i) { // evenly: along a spiral of the golden angle
        const Scalar z = 1 - (2 * static_cast<Scalar>(i) + 1) / looks, r = std::sqrt(1 - z * z);
        const Vector3<Scalar> look(r * std::cos(golden * static_cast<Scalar>(i)),
                                   r * std::sin(golden * static_cast<Scalar>(i)), z);
        met += std::any_of(faces.begin(), faces.end(), [&](int f) {
            Eigen::Matrix3<Scalar> corners;
            for (int k = 0; k < 3; ++k) corners.col(k) = core::point(mesh.vertices, mesh.faces(f, k)) - place;
            const Scalar a = look.dot(corners.col(0).cross(corners.col(1)));
            const Scalar b = look.dot(corners.col(1).cross(corners.col(2)));
            const Scalar c = look.dot(corners.col(2).cross(corners.col(0)));
            const bool is_crossed = (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
            const Scalar volume = corners.determinant(), side = a + b + c; // in front: both of one sign
            return is_crossed && side * volume > 0;
        });
    }
    return static_cast<Scalar>(met) / looks;
}

/// An arm, or all that is none.
inline std::size_t party_of(const TemplateJoint& joint) {
    if (part_of(joint.role) != BodyPart::arm) return 2;
    return joint.side == Side::right ? 1 : 0;
}

/// The heat that a body gives to its loose pieces.
template <typename Scalar>
class LooseHeat {
    using Accumulator = core::Accumulator;
    using PerParty = std::array<Accumulator, 3>;

public:
    LooseHeat(const LoosePieces<Scalar>& loose, const std::vector<Scalar>& gaps, const JointWeights& weights,
              const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template)
        : loose_(loose), groups_(loose.pieces), skeleton_(skeleton), template_(skeleton_template) {
        const Eigen::VectorX<Accumulator> areas = core::vertex_areas(loose.mesh);
        const Accumulator least = core::rounding<Accumulator>() * areas.sum();
        const Eigen::Index n = areas.size();
        heat_ = {surface_laplacian(loose.mesh), Eigen::VectorX<Accumulator>(n), weights(loose.first, Eigen::all)};
        for (Eigen::Index v = 0; v < n; ++v) {
            const auto gap = static_cast<Accumulator>(gaps[static_cast<std::size_t>(v)]);
            heat_.supply[v] = std::max(areas[v], least) / (gap * gap);
        }
        heat_.of_joint.array().colwise() *= heat_.supply.array();
        join(touching_pairs(loose, gaps), areas);
        for (const auto& [group, vertices] : by_group()) leave_out_strangers(group, vertices);
    }

    [[nodiscard]] const Heat& heat() const { return heat_; }

private:
    void join(const std::vector<std::pair<int, int>>& pairs, const Eigen::VectorX<Accumulator>& areas) {
        constexpr auto apart = static_cast<Accumulator>(touching<Scalar>);
        std::vector<Eigen::Triplet<Accumulator>> links;
        for (const auto& [a, b] : pairs) {
            const Accumulator link = std::min(areas[a], areas[b]) / (apart * apart);
            for (const int v : {a, b}) links.emplace_back(v, v, link);
            links.emplace_back(a, b, -link);
            links.emplace_back(b, a, -link);
            groups_.unite(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
        }
        Eigen::SparseMatrix<Accumulator> joined(areas.size(), areas.size());
        joined.setFromTriplets(links.begin(), links.end());
        heat_.conduction += joined;
    }

    [[nodiscard]] std::map<std::size_t, std::vector<int>> by_group() {
        std::map<std::size_t, std::vector<int>> out;
        for (std::size_t v = 0; v < loose_.first.size(); ++v) out[groups_.find(v)].push_back(static_cast<int>(v));
        return out;
    }

    /// Takes from pieces that touch each other the heat of arms, or of all else, that are merely near.
    void leave_out_strangers(std::size_t group, const std::vector<int>& vertices) {
        constexpr Accumulator least = 0.05;
        PerParty given{};
        for (const int v : vertices)
            for (std::size_t j = 0; j < template_.joints.size(); ++j)
                given[party_of(template_.joints[j])] += heat_.of_joint(v, static_cast<Eigen::Index>(j));
        const Accumulator all = given[0] + given[1] + given[2];
        std::array<bool, 3> is_stranger{};
        for (std::size_t party = 0; party < 3; ++party)
            is_stranger[party] = given[party] > 0 && given[party] < least * all;
        for (std::size_t arm = 0; arm < 2; ++arm)
            if ((is_stranger[arm] || (is_stranger[2] && given[arm] > 0)) && surrounds_shoulder(group, arm))
                is_stranger[arm] = is_stranger[2] = false;
        if (is_stranger == std::array<bool, 3>{}) return;
        for (const int v : vertices) {
            for (std::size_t j = 0; j < template_.joints.size(); ++j)
                if (is_stranger[party_of(template_.joints[j])]) heat_.of_joint(v, static_cast<Eigen::Index>(j)) = 0;
            heat_.supply[v] = heat_.of_joint.row(v).sum();
        }
    }

    [[nodiscard]] bool surrounds_shoulder(std::size_t group, std::size_t arm) {
        const int shoulder = find_joint(template_, JointRole::shoulder, arm == 1 ? Side::right : Side::left);
        if (shoulder < 0) return true;
        std::vector<int> faces;
        for (int f = 0; f < loose_.mesh.faces.rows(); ++f)
            if (groups_.find(static_cast<std::size_t>(loose_.mesh.faces(f, 0))) == group) faces.push_back(f);
        const Vector3<Scalar>& place = skeleton_.joints[static_cast<std::size_t>(shoulder)].position;
        return surrounded_part(place, loose_.mesh, faces) > Scalar(0.5);
    }

    const LoosePieces<Scalar>& loose_;
    core::DisjointSets groups_; ///< of pieces that touch
    const KinematicSkeleton<Scalar>& skeleton_;
    const SkeletonTemplate& template_;
    Heat heat_;
};

} // namespace detail

/// The weights of an input with those of its loose pieces found anew: of clothes, hair, weapons and bags that are no
/// part of the body, whose vertices have them from the nearest place on it. A piece follows what it touches, and what
/// hangs free moves with the rest of the piece: its own surface, and pieces of this kind that touch, conduct; the body
/// warms each vertex by its weights there, the less the farther it is (as bones do, BP07). So a skirt's middle, far
/// from both legs, is shared by them, by way of the trunk. Of an arm and all else, a piece does not follow what gives
/// it less than a twentieth of its heat, unless it surrounds the shoulder: a bow goes with the hand that holds it,
/// though it passes a thigh, and a quiver with the hip, though an elbow is near. `weights`, one row a vertex of the
/// mesh that the body was made of, and `gaps`, how far each vertex is from the place that gave it its row; these and
/// `skeleton` in the coordinates of the body. O(n^1.5) in the vertices of loose pieces.
template <typename Scalar>
JointWeights with_loose_pieces(JointWeights weights, const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body,
                               const std::vector<Scalar>& gaps, const KinematicSkeleton<Scalar>& skeleton,
                               const SkeletonTemplate& skeleton_template) {
    const auto loose = detail::loose_pieces(mesh, body);
    if (loose.first.empty()) return weights;
    const std::vector<Scalar> own_gaps = detail::gaps_of(loose, body, gaps);
    const detail::LooseHeat<Scalar> warmed(loose, own_gaps, weights, skeleton, skeleton_template);
    const Outcome<JointWeights> found = heat_weights(warmed.heat());
    if (!found) return weights;
    const JointWeights own = following_one_limb(*found, skeleton_template, 1);
    for (std::size_t v = 0; v < loose.index.size(); ++v)
        if (loose.index[v] >= 0) weights.row(static_cast<Eigen::Index>(v)) = own.row(loose.index[v]);
    return weights;
}

} // namespace skelgen::applications
