#pragma once

#include <skelgen/surface/pieces.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/face_tree.hpp>
#include <skelgen/surface/manifold_parts.hpp>
#include <skelgen/surface/winding_tree.hpp>

namespace skelgen::surface {
namespace detail {

/// Faces that are looked at together.
template <typename Scalar>
struct FaceSet {
    std::vector<int> faces;
    core::Accumulator area = 0;
    Eigen::AlignedBox<Scalar, 3> box;

    void add(const TriangleMesh<Scalar>& mesh, int f) {
        faces.push_back(f);
        area += core::face_area_vector(mesh, f).norm();
        for (int k = 0; k < 3; ++k) box.extend(core::point(mesh.vertices, mesh.faces(f, k)));
    }
    void add(const FaceSet& other) {
        faces.insert(faces.end(), other.faces.begin(), other.faces.end());
        area += other.area;
        box.extend(other.box);
    }
};

/// Sets of faces that hang together by vertices, the largest first.
template <typename Scalar>
std::vector<FaceSet<Scalar>> connected_sets(const TriangleMesh<Scalar>& mesh) {
    core::DisjointSets joined(static_cast<std::size_t>(mesh.vertices.rows()));
    const auto vertex = [&](Eigen::Index f, int k) { return static_cast<std::size_t>(mesh.faces(f, k)); };
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 1; k < 3; ++k) joined.unite(vertex(f, 0), vertex(f, k));
    std::vector<FaceSet<Scalar>> out;
    std::vector<std::size_t> number(static_cast<std::size_t>(mesh.vertices.rows()), static_cast<std::size_t>(-1));
    for (int f = 0; f < static_cast<int>(mesh.faces.rows()); ++f) {
        std::size_t& set = number[joined.find(vertex(f, 0))];
        if (set == static_cast<std::size_t>(-1)) {
            set = out.size();
            out.emplace_back();
        }
        out[set].add(mesh, f);
    }
    std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
    return out;
}

/// Is a set of faces a sheet: its spread across the sheet less than a tenth of the lesser one along it? A hand has 0.3.
template <typename Scalar>
bool is_flat(const TriangleMesh<Scalar>& mesh, const FaceSet<Scalar>& set) {
    using core::Accumulator;
    constexpr Accumulator flat = 0.1;
    Eigen::Matrix<Accumulator, 3, 3> second = Eigen::Matrix<Accumulator, 3, 3>::Zero();
    const Vector3<Accumulator> origin = set.box.center().template cast<Accumulator>();
    Vector3<Accumulator> first = Vector3<Accumulator>::Zero();
    for (const int f : set.faces) {
        const Accumulator weight = core::face_area_vector(mesh, f).norm() / 3;
        for (int k = 0; k < 3; ++k) {
            const Vector3<Accumulator> p =
                core::point(mesh.vertices, mesh.faces(f, k)).template cast<Accumulator>() - origin;
            first += weight * p;
            core::add_outer_product<Accumulator>(second, weight, p);
        }
    }
    if (!(set.area > 0)) return true;
    core::add_outer_product<Accumulator>(second, -1 / set.area, first);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<Accumulator, 3, 3>> solver(second, Eigen::EigenvaluesOnly);
    const Vector3<Accumulator> spread = solver.eigenvalues();
    return spread[0] < flat * flat * spread[1];
}

/// A flat part of the surface: faces that go on from one to the next without a bend.
template <typename Scalar>
struct FlatSide {
    Vector3<Scalar> normal = Vector3<Scalar>::UnitX();
    Scalar offset = 0; ///< of its plane
    core::Accumulator area = 0;
    Vector3<Scalar> centre = Vector3<Scalar>::Zero(); ///< of the ball around it
    Scalar radius = 0;
};

/// Can there be a flat side with `least` of the area or more: do so many normals point the same way? Counted on a
/// cube's sides; a side of one direction lies in four of its squares at most.
template <typename Scalar>
bool may_have_flat_side(const TriangleMesh<Scalar>& mesh, core::Accumulator least) {
    constexpr int squares = 63; // along an edge of the cube: a degree and a half each
    std::vector<core::Accumulator> area(static_cast<std::size_t>(6 * squares * squares), 0);
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const Vector3<Scalar> normal = core::face_area_vector(mesh, f);
        int axis = 0;
        const Scalar most = normal.cwiseAbs().maxCoeff(&axis);
        if (!(most > 0)) continue;
        const auto square = [&](int k) {
            return std::min(squares - 1, static_cast<int>((normal[(axis + k) % 3] / most + 1) / 2 * squares));
        };
        const int side = 2 * axis + (normal[axis] > 0 ? 1 : 0);
        area[static_cast<std::size_t>((side * squares + square(1)) * squares + square(2))] += normal.norm();
    }
    return *std::max_element(area.begin(), area.end()) >= least / 4;
}

/// Those that have `least` of the area or more.
template <typename Scalar>
std::vector<FlatSide<Scalar>> flat_sides(const TriangleMesh<Scalar>& mesh, core::Accumulator least) {
    if (!may_have_flat_side(mesh, least)) return {};
    constexpr Scalar straight = Scalar(0.9998); // cosine: a degree
    std::vector<Vector3<Scalar>> normals(static_cast<std::size_t>(mesh.faces.rows()));
    for (std::size_t f = 0; f < normals.size(); ++f)
        normals[f] = core::face_area_vector(mesh, static_cast<Eigen::Index>(f)).stableNormalized();
    core::DisjointSets joined(normals.size());
    const Triangles adjacency = core::face_adjacency(mesh.faces);
    for (std::size_t f = 0; f < normals.size(); ++f)
        for (int k = 0; k < 3; ++k)
            if (const int g = adjacency(static_cast<Eigen::Index>(f), k); g > static_cast<int>(f))
                if (normals[f].dot(normals[static_cast<std::size_t>(g)]) > straight)
                    joined.unite(f, static_cast<std::size_t>(g));
    std::vector<core::Accumulator> area(normals.size(), 0);
    std::vector<Vector3<Scalar>> sum(normals.size(), Vector3<Scalar>::Zero()), centre = sum;
    const auto corner = [&](std::size_t f, int k) -> Vector3<Scalar> {
        return core::point(mesh.vertices, mesh.faces(static_cast<Eigen::Index>(f), k));
    };
    for (std::size_t f = 0; f < normals.size(); ++f) {
        const Vector3<Scalar> own = core::face_area_vector(mesh, static_cast<Eigen::Index>(f));
        area[joined.find(f)] += own.norm();
        sum[joined.find(f)] += own;
        centre[joined.find(f)] += own.norm() * (corner(f, 0) + corner(f, 1) + corner(f, 2)) / 3;
    }
    std::vector<FlatSide<Scalar>> out;
    for (std::size_t f = 0; f < normals.size(); ++f) {
        // A slowly bending surface has no single normal.
        if (area[f] < least || sum[f].norm() < straight * static_cast<Scalar>(area[f])) continue;
        const Vector3<Scalar> normal = sum[f].stableNormalized();
        FlatSide<Scalar> side{normal, normal.dot(corner(f, 0)), area[f], centre[f] / static_cast<Scalar>(area[f])};
        for (std::size_t g = 0; g < normals.size(); ++g) {
            if (joined.find(g) != f) continue;
            for (int k = 0; k < 3; ++k) side.radius = std::max(side.radius, (corner(g, k) - side.centre).norm());
        }
        out.push_back(side);
    }
    return out;
}

/// Marks, in `keep`, the faces of plates that are grown to something: between two flat sides that look away from each
/// other, the outer one with all else behind it, but for soles that have sunk through it: what is beyond its plane
/// beside it, as toes below a shield, shows that it is none. How many there were.
template <typename Scalar>
int drop_grown_plates(const TriangleMesh<Scalar>& mesh, std::vector<bool>& keep) {
    constexpr double least_side = 0.05;                               // of the area: soles have 1.5 % each (LB44)
    constexpr Scalar thickness = Scalar(0.06), slack = Scalar(0.003); // of the size
    constexpr Scalar sunk = Scalar(0.03); // of the size: how far soles may have gone through; ankles are 0.04 high
    constexpr double most_sunk = 0.03;    // of the area: both soles (LB44)
    const std::vector<FlatSide<Scalar>> sides =
        flat_sides(mesh, least_side * static_cast<core::Accumulator>(core::surface_area(mesh)));
    const Scalar size = core::bounding_diagonal(mesh.vertices);
    int plates = 0;
    for (const FlatSide<Scalar>& outer : sides) {
        const auto depth = [&](int v) { return outer.offset - outer.normal.dot(core::point(mesh.vertices, v)); };
        bool is_outermost = true;
        for (int v = 0; v < static_cast<int>(mesh.vertices.rows()) && is_outermost; ++v)
            is_outermost = depth(v) > -sunk * size;
        core::Accumulator beyond = 0;
        for (Eigen::Index f = 0; f < mesh.faces.rows() && is_outermost; ++f) {
            if (depth(mesh.faces(f, 0)) >= -slack * size) continue;
            beyond += core::face_area_vector(mesh, f).norm();
            is_outermost = (core::point(mesh.vertices, mesh.faces(f, 0)) - outer.centre).norm() <= outer.radius;
        }
        is_outermost = is_outermost && beyond <= most_sunk * static_cast<core::Accumulator>(core::surface_area(mesh));
        if (!is_outermost) continue;
        Scalar deepest = -1;
        for (const FlatSide<Scalar>& inner : sides) {
            const Scalar d = outer.offset + inner.offset; // of planes that look away from each other
            if (inner.normal.dot(outer.normal) < Scalar(-0.999) && d > 0 && d < thickness * size)
                deepest = std::max(deepest, d);
        }
        if (deepest < 0) continue;
        ++plates;
        for (std::size_t f = 0; f < keep.size(); ++f) {
            Scalar most = 0;
            for (int k = 0; k < 3; ++k) most = std::max(most, depth(mesh.faces(static_cast<Eigen::Index>(f), k)));
            if (most <= deepest + slack * size) keep[f] = false;
        }
    }
    return plates;
}

/// The faces of a set alone.
template <typename Scalar>
TriangleMesh<Scalar> mesh_of(const TriangleMesh<Scalar>& mesh, const FaceSet<Scalar>& set) {
    return {mesh.vertices, mesh.faces(set.faces, Eigen::all)};
}

/// The faces of some sets in the mesh's order.
template <typename Scalar>
Triangles faces_in(const TriangleMesh<Scalar>& mesh, const std::vector<FaceSet<Scalar>>& sets) {
    std::vector<int> faces;
    for (const FaceSet<Scalar>& set : sets) faces.insert(faces.end(), set.faces.begin(), set.faces.end());
    std::sort(faces.begin(), faces.end());
    return mesh.faces(faces, Eigen::all);
}

/// Is a vertex of one set in or near a surface? Looks at four thousand of them.
template <typename Scalar>
bool meets(const TriangleMesh<Scalar>& mesh, const TriangleMesh<Scalar>& surface, const FaceSet<Scalar>& set,
           Scalar reach) {
    constexpr std::size_t samples = 4000, inner_samples = 100;
    const FaceTree<Scalar> tree(surface);
    const WindingTree<Scalar> windings(surface);
    const std::size_t stride = std::max<std::size_t>(1, set.faces.size() / samples);
    const std::size_t inner_stride = stride * std::max<std::size_t>(1, samples / inner_samples);
    for (std::size_t i = 0; i < set.faces.size(); i += stride) {
        const Vector3<Scalar> place = core::point(mesh.vertices, mesh.faces(set.faces[i], 0));
        if (i % inner_stride == 0 && windings.winding_number(surface, place) > Scalar(0.5)) return true;
        if (tree.distance(surface, place) <= reach) return true;
    }
    return false;
}

/// Is no vertex of either set in or near the other?
template <typename Scalar>
bool are_apart(const TriangleMesh<Scalar>& mesh, const FaceSet<Scalar>& large, const FaceSet<Scalar>& small) {
    constexpr Scalar near = Scalar(0.005); // of the size
    const Scalar reach = near * large.box.diagonal().norm();
    if (large.box.squaredExteriorDistance(small.box) > reach * reach) return true;
    return !meets(mesh, mesh_of(mesh, large), small, reach) && !meets(mesh, mesh_of(mesh, small), large, reach);
}

/// Things that stand apart from each other, the largest first: pieces whose grown boxes meet are one, unless they are
/// of a body's size both and apart all the same.
template <typename Scalar>
std::vector<FaceSet<Scalar>> things_apart(const TriangleMesh<Scalar>& mesh,
                                          const std::vector<FaceSet<Scalar>>& pieces) {
    constexpr Scalar gap = Scalar(0.02);      // of the largest piece's size
    constexpr double as_large = 0.5;          // by area
    constexpr std::size_t most_pieces = 4000; // the time grows with their square
    const Scalar reach = gap * pieces.front().box.diagonal().norm() / 2;
    const std::size_t count = std::min(pieces.size(), most_pieces);
    const auto grown = [&](std::size_t i) {
        const Vector3<Scalar> margin = Vector3<Scalar>::Constant(reach);
        return Eigen::AlignedBox<Scalar, 3>(pieces[i].box.min() - margin, pieces[i].box.max() + margin);
    };
    core::DisjointSets joined(pieces.size());
    std::vector<std::size_t> leaders{0}; // large pieces, apart from one another
    for (std::size_t i = 1; i < count && pieces[i].area >= as_large * pieces[0].area; ++i)
        if (std::all_of(leaders.begin(), leaders.end(),
                        [&](std::size_t j) { return are_apart(mesh, pieces[j], pieces[i]); }))
            leaders.push_back(i);
    std::vector<bool> is_leader(pieces.size(), false);
    for (const std::size_t leader : leaders) is_leader[leader] = true;
    std::vector<bool> placed = is_leader;
    std::vector<std::size_t> pending = leaders;
    for (std::size_t next = 0; next <= pending.size(); ++next) {
        if (next == pending.size()) { // what no leader reaches begins another thing
            const auto rest = static_cast<std::size_t>(std::find(placed.begin(), placed.end(), false) - placed.begin());
            if (rest >= count) break;
            placed[rest] = true;
            pending.push_back(rest);
        }
        const Eigen::AlignedBox<Scalar, 3> box = grown(pending[next]);
        for (std::size_t i = 0; i < count; ++i) {
            if (is_leader[i] && is_leader[pending[next]]) continue; // known to be apart
            if (!box.intersects(grown(i))) continue;
            joined.unite(pending[next], i);
            if (placed[i]) continue;
            placed[i] = true;
            pending.push_back(i);
        }
    }
    for (std::size_t i = count; i < pieces.size(); ++i) joined.unite(0, i);
    std::vector<FaceSet<Scalar>> out;
    std::vector<std::size_t> number(pieces.size(), pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        std::size_t& thing = number[joined.find(i)];
        if (thing == pieces.size()) {
            thing = out.size();
            out.emplace_back();
        }
        out[thing].add(pieces[i]);
    }
    std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
    return out;
}

} // namespace detail

template <typename Scalar>
BodyFaces faces_of_body(const TriangleMesh<Scalar>& mesh, int component, bool is_one_piece) {
    constexpr double least_plate = 0.02, body_size = 0.5; // by area
    constexpr double reach_of_body = 0.6;                 // by diagonal
    BodyFaces out;
    std::vector<bool> keep(static_cast<std::size_t>(mesh.faces.rows()), true);
    int plates = detail::drop_grown_plates(mesh, keep);
    out.stood_on_plate = plates > 0;
    if (plates == 0 && is_one_piece) {
        out.faces = mesh.faces;
        return out;
    }
    TriangleMesh<Scalar> rest{mesh.vertices, plates > 0 ? Triangles() : mesh.faces};
    if (plates > 0) {
        rest.faces.resize(std::count(keep.begin(), keep.end(), true), 3);
        Eigen::Index row = 0;
        for (std::size_t f = 0; f < keep.size(); ++f)
            if (keep[f]) rest.faces.row(row++) = mesh.faces.row(static_cast<Eigen::Index>(f));
        if (rest.faces.rows() < 4) rest.faces = mesh.faces; // nothing but a plate: that is for others to say
    }
    std::vector<detail::FaceSet<Scalar>> pieces = detail::connected_sets(rest);
    core::Accumulator area = 0;
    for (const auto& piece : pieces) area += piece.area;
    const auto is_plate = [&](const detail::FaceSet<Scalar>& piece) {
        return piece.area > least_plate * area && detail::is_flat(rest, piece);
    };
    const auto first_plate =
        std::stable_partition(pieces.begin(), pieces.end(), [&](const auto& p) { return !is_plate(p); });
    if (first_plate != pieces.begin()) {
        plates += static_cast<int>(pieces.end() - first_plate);
        pieces.erase(first_plate, pieces.end());
    }
    const auto all_pieces = static_cast<int>(pieces.size());
    if (all_pieces == 1 && plates == 0) {
        out.faces = std::move(rest.faces);
        return out;
    }
    detail::FaceSet<Scalar> chosen = pieces.front();
    if (pieces.size() > 1) {
        const std::vector<detail::FaceSet<Scalar>> things = detail::things_apart(rest, pieces);
        const auto is_body = [&](const detail::FaceSet<Scalar>& thing) {
            return thing.area >= body_size * things[0].area &&
                   thing.box.diagonal().norm() >= Scalar(reach_of_body) * things[0].box.diagonal().norm();
        };
        out.bodies = static_cast<int>(std::count_if(things.begin(), things.end(), is_body));
        chosen = things[static_cast<std::size_t>(std::clamp(component, 1, out.bodies)) - 1];
        if (things.size() > 1) out.all_things = detail::faces_in(rest, things);
    }
    std::sort(chosen.faces.begin(), chosen.faces.end());
    out.faces = rest.faces(chosen.faces, Eigen::all);
    for (const auto& piece : pieces)
        out.dropped_pieces += !std::binary_search(chosen.faces.begin(), chosen.faces.end(), piece.faces.front());
    out.dropped_pieces = std::min(out.dropped_pieces, all_pieces - 1);
    if (plates > 0) out.notes.push_back(plates == 1 ? "a plate left out" : std::to_string(plates) + " plates left out");
    return out;
}

template <typename Scalar>
UsedPart<Scalar> used_part(const TriangleMesh<Scalar>& mesh) {
    UsedPart<Scalar> out;
    std::vector<int> index(static_cast<std::size_t>(mesh.vertices.rows()), -1);
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) index[static_cast<std::size_t>(mesh.faces.data()[i])] = 0;
    for (std::size_t v = 0; v < index.size(); ++v)
        if (index[v] == 0) {
            index[v] = static_cast<int>(out.source.size());
            out.source.push_back(static_cast<int>(v));
        }
    out.mesh.vertices.resize(static_cast<Eigen::Index>(out.source.size()), 3);
    for (std::size_t v = 0; v < out.source.size(); ++v)
        out.mesh.vertices.row(static_cast<Eigen::Index>(v)) = mesh.vertices.row(out.source[v]);
    out.mesh.faces = mesh.faces;
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i)
        out.mesh.faces.data()[i] = index[static_cast<std::size_t>(mesh.faces.data()[i])];
    return out;
}

} // namespace skelgen::surface
