#pragma once

// Winding numbers at the nodes of a lattice, for envelopes (envelope.hpp).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/lattice.hpp>
#include <skelgen/surface/winding_tree.hpp>

namespace skelgen::surface::detail {

/// Where a surface ends: edges as its faces pass them, sorted, without those that faces pass both ways alike; as often
/// as one way is passed more often than the other.
inline std::vector<std::array<int, 2>> rims_of(const Triangles& faces) {
    std::vector<std::array<int, 3>> passes; // lower vertex, higher one, 1 upwards or -1
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = faces(f, k), b = faces(f, (k + 1) % 3);
            passes.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
        }
    std::sort(passes.begin(), passes.end());
    std::vector<std::array<int, 2>> out;
    for (std::size_t i = 0; i < passes.size();) {
        const auto [a, b, way] = passes[i];
        int sum = 0;
        for (; i < passes.size() && passes[i][0] == a && passes[i][1] == b; ++i) sum += passes[i][2];
        const std::array<int, 2> edge{sum > 0 ? a : b, sum > 0 ? b : a};
        out.insert(out.end(), static_cast<std::size_t>(std::abs(sum)), edge);
    }
    std::sort(out.begin(), out.end());
    return out;
}

/// Faces on the vertices of a mesh that close it: over each way along its rims, corner by corner, until no way is left.
/// So most of them are as small as the edges that they begin at, and few are large.
template <typename Scalar>
TriangleMesh<Scalar> caps_of(const TriangleMesh<Scalar>& mesh) {
    const std::vector<std::array<int, 2>> rims = rims_of(mesh.faces);
    std::vector<std::size_t> next(
        static_cast<std::size_t>(mesh.vertices.rows())); // per vertex: of its edges not walked
    for (std::size_t i = rims.size(); i-- > 0;) next[static_cast<std::size_t>(rims[i][0])] = i;
    std::vector<std::array<int, 3>> faces;
    const auto is_left = [&](int v) {
        const std::size_t i = next[static_cast<std::size_t>(v)];
        return i < rims.size() && rims[i][0] == v;
    };
    for (const auto& [start, end] : rims)
        while (is_left(start)) {
            std::vector<int> way; // comes back, as each vertex is left as often as it is reached
            for (int v = start; way.empty() || v != start; v = rims[next[static_cast<std::size_t>(v)]++][1])
                way.push_back(v);
            while (way.size() > 2) {
                std::vector<int> shorter;
                for (std::size_t i = 0; i < way.size(); i += 2) {
                    shorter.push_back(way[i]);
                    if (i + 1 < way.size()) faces.push_back({way[(i + 2) % way.size()], way[i + 1], way[i]});
                }
                way = std::move(shorter);
            }
        }
    TriangleMesh<Scalar> out{mesh.vertices, Triangles(static_cast<Eigen::Index>(faces.size()), 3)};
    for (std::size_t f = 0; f < faces.size(); ++f)
        out.faces.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
    return out;
}

/// How often a closed surface winds around the nodes of a lattice, counted along its rows as pictures are filled.
template <typename Scalar>
class LatticeRows {
public:
    explicit LatticeRows(const Lattice<Scalar>& lattice)
        : lattice_(lattice),
          rows_(static_cast<std::size_t>(lattice.nodes[1]) * static_cast<std::size_t>(lattice.nodes[2])) {}

    /// Adds the faces of a mesh. All that are added have to be closed together.
    void add(const TriangleMesh<Scalar>& mesh) {
        for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) add_face(mesh, mesh.faces.row(f));
    }

    [[nodiscard]] int winding_number(const LatticeNode& node) const {
        const Scalar x = lattice_.place(node)[0];
        int sum = 0;
        for (const auto& [at, way] : rows_[row_of(node[1], node[2])])
            if (at < x) sum += way;
        return sum;
    }

private:
    /// Where an edge of a face has a row's y.
    struct Pass {
        Scalar x, z;
    };

    void add_face(const TriangleMesh<Scalar>& mesh, const Eigen::RowVector3i& face) {
        const auto corner = [&](int k) { return core::point(mesh.vertices, face[k % 3]); };
        const auto [first_y, last_y] = nodes_along(1, corner(0)[1], corner(1)[1], corner(2)[1]);
        for (int j = first_y; j <= last_y; ++j) {
            const Scalar y = lattice_.place({0, j, 0})[1];
            Pass up{}, down{}; // by the edge that leads to larger y, and by that back
            bool is_passed = false;
            for (int k = 0; k < 3; ++k) {
                const bool is_below = corner(k)[1] <= y, is_next_below = corner(k + 1)[1] <= y;
                if (is_below == is_next_below) continue;
                (is_below ? up : down) = pass(mesh, face[k], face[(k + 1) % 3], y);
                is_passed = true;
            }
            if (is_passed) add_between(up, down, j);
        }
    }

    /// The same whichever of the edge's faces asks: what is closed has no gaps in any row.
    static Pass pass(const TriangleMesh<Scalar>& mesh, int from, int to, Scalar y) {
        const Vector3<Scalar> a = core::point(mesh.vertices, std::min(from, to)),
                              b = core::point(mesh.vertices, std::max(from, to));
        const Scalar part = (y - a[1]) / (b[1] - a[1]);
        return {a[0] + part * (b[0] - a[0]), a[2] + part * (b[2] - a[2])};
    }

    /// Of the rows with that y those that pass the face, between two of its edges.
    void add_between(const Pass& up, const Pass& down, int j) {
        const auto [low, high] = std::minmax(up.z, down.z);
        const auto [first_z, last_z] = nodes_along(2, low, high, low);
        for (int k = first_z; k <= last_z; ++k) {
            const Scalar z = lattice_.place({0, 0, k})[2];
            if (!(low <= z && z < high)) continue;
            const Scalar x = up.x + (z - up.z) / (down.z - up.z) * (down.x - up.x);
            rows_[row_of(j, k)].emplace_back(x, up.z > down.z ? 1 : -1);
        }
    }

    /// The nodes along an axis between the least and the greatest of three numbers, and one more at either end.
    [[nodiscard]] std::pair<int, int> nodes_along(std::size_t axis, Scalar a, Scalar b, Scalar c) const {
        const auto [least, most] = std::minmax({a, b, c});
        const Scalar origin = lattice_.origin[static_cast<Eigen::Index>(axis)];
        return {std::max(0, static_cast<int>(std::floor((least - origin) / lattice_.cell))),
                std::min(lattice_.nodes[axis] - 1, static_cast<int>(std::ceil((most - origin) / lattice_.cell)))};
    }

    [[nodiscard]] std::size_t row_of(int y, int z) const {
        return static_cast<std::size_t>(y) + static_cast<std::size_t>(lattice_.nodes[1]) * static_cast<std::size_t>(z);
    }

    const Lattice<Scalar>& lattice_;
    std::vector<std::vector<std::pair<Scalar, int>>> rows_; ///< per row along x: where faces pass it, 1 inwards or -1
};

/// The winding number of a surface that may be open (JKS13), at a lattice's nodes: that of the closed one which it
/// makes with its caps, a whole number, less that of the caps by themselves, which are few.
template <typename Scalar>
class WindingField {
public:
    /// `caps` and their tree: of the mesh.
    WindingField(const TriangleMesh<Scalar>& mesh, const TriangleMesh<Scalar>& caps, const WindingTree<Scalar>& tree,
                 const Lattice<Scalar>& lattice)
        : caps_(caps), tree_(tree), lattice_(lattice), closed_(lattice) {
        closed_.add(mesh);
        closed_.add(caps);
    }

    /// The winding number less one half: positive inside.
    [[nodiscard]] Scalar depth(const LatticeNode& node) const {
        return static_cast<Scalar>(closed_.winding_number(node)) - tree_.winding_number(caps_, lattice_.place(node)) -
               Scalar(0.5);
    }

private:
    const TriangleMesh<Scalar>& caps_;
    const WindingTree<Scalar>& tree_;
    const Lattice<Scalar>& lattice_;
    LatticeRows<Scalar> closed_;
};

} // namespace skelgen::surface::detail
