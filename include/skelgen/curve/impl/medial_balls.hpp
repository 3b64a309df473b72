#pragma once

#include <skelgen/curve/medial_balls.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/surface/face_tree.hpp>

namespace skelgen::curve {
namespace detail {

/// A ball that would touch a second point closer to the first than this angle (seen from the centre, as a cosine; 37
/// degrees) is held up by the mesh's own facets, not by the opposite side of the body. Calibrated.
template <typename Scalar>
inline constexpr Scalar nearly_same_direction = Scalar(0.8);

/// The vertices of a mesh in a tree of boxes, of which each is parted in four along its longest sides. Boxes and places
/// are held in single precision, relative to the mesh's size, four and eight side by side, so that they are measured at
/// once; what rounding may decide is looked at closely.
template <typename Scalar>
class VertexTree {
public:
    explicit VertexTree(const Points<Scalar>& vertices) : vertices_(vertices) {
        std::vector<Entry> entries;
        entries.reserve(static_cast<std::size_t>(vertices.rows()));
        for (int v = 0; v < static_cast<int>(vertices.rows()); ++v) entries.push_back({core::point(vertices, v), v});
        if (entries.empty()) return;
        if (const Scalar size = vertices.cwiseAbs().maxCoeff(); size > 0) scale_ = 1 / size;
        root_ = add(entries.begin(), entries.end());
    }

    /// The vertex nearest to a place, the lowest of equals, of those whose squared distance is below a bound; -1 where
    /// there is none. The nearer a first guess is (-1 for none), the sooner it is found.
    [[nodiscard]] int nearest(const Vector3<Scalar>& place, Scalar below, int guess) const {
        Search search{place, (place * scale_).template cast<float>(), below};
        set_limit(search);
        if (guess >= 0) look_at(guess, search);
        if (vertices_.rows() > 0) look_into(root_, search);
        return search.vertex;
    }

    /// All vertices: those that follow each other are near each other.
    [[nodiscard]] std::vector<int> in_order() const {
        std::vector<int> out;
        for (const Leaf& leaf : leaves_)
            for (const int v : leaf.vertices)
                if (v >= 0) out.push_back(v);
        return out;
    }

private:
    static constexpr int parts = 4, most_in_leaf = 8;
    static constexpr float far = std::numeric_limits<float>::infinity();

    struct Entry {
        Vector3<Scalar> place;
        int vertex;
    };
    using Entries = typename std::vector<Entry>::iterator;
    /// Boxes by their middles and half sizes, and what they hold: of parts the index of their node, of vertices minus
    /// one minus that of their leaf.
    struct Node {
        std::array<Eigen::Array<float, parts, 1>, 3> middle, half;
        std::array<int, parts> held{};
    };
    struct Leaf {
        std::array<Eigen::Array<float, most_in_leaf, 1>, 3> places;
        std::array<int, most_in_leaf> vertices{}; ///< -1 where there are fewer
    };
    struct Search {
        Vector3<Scalar> place;
        Vector3<float> rounded; ///< relative to the mesh's size, as are boxes and leaves
        Scalar squared;         ///< distance of the nearest so far
        int vertex = -1;
        float limit = 0; ///< squared distance, as rounding may have it, of what may be nearer
    };

    void set_limit(Search& search) const {
        constexpr float rounding = 16 * std::numeric_limits<float>::epsilon();
        const float nearest = std::sqrt(static_cast<float>(search.squared * scale_ * scale_));
        const float distance = nearest + rounding * (1 + nearest + search.rounded.cwiseAbs().maxCoeff());
        search.limit = std::min(distance * distance, std::numeric_limits<float>::max());
    }

    int add(Entries first, Entries last) {
        const auto count = static_cast<std::size_t>(last - first);
        if (count <= static_cast<std::size_t>(most_in_leaf)) return add_leaf(first, count);
        const auto index = nodes_.size();
        nodes_.emplace_back();
        const Entries middle = parted(first, last);
        const std::array<Entries, parts + 1> ends{first, parted(first, middle), middle, parted(middle, last), last};
        for (std::size_t part = 0; part < static_cast<std::size_t>(parts); ++part) {
            Eigen::AlignedBox<Scalar, 3> box;
            for (auto entry = ends[part]; entry != ends[part + 1]; ++entry) box.extend(entry->place);
            for (std::size_t k = 0; k < 3; ++k) {
                const auto axis = static_cast<Eigen::Index>(k);
                nodes_[index].middle[k][static_cast<Eigen::Index>(part)] =
                    static_cast<float>(scale_ * (box.min()[axis] + box.max()[axis]) / 2);
                nodes_[index].half[k][static_cast<Eigen::Index>(part)] =
                    static_cast<float>(scale_ * (box.max()[axis] - box.min()[axis]) / 2);
            }
            const int held = add(ends[part], ends[part + 1]);
            nodes_[index].held[part] = held;
        }
        return static_cast<int>(index);
    }

    int add_leaf(Entries first, std::size_t count) {
        Leaf leaf;
        leaf.vertices.fill(-1);
        for (auto& along : leaf.places) along.setConstant(far);
        for (std::size_t i = 0; i < count; ++i) {
            const Entry& entry = first[static_cast<std::ptrdiff_t>(i)];
            leaf.vertices[i] = entry.vertex;
            for (std::size_t k = 0; k < 3; ++k)
                leaf.places[k][static_cast<Eigen::Index>(i)] =
                    static_cast<float>(scale_ * entry.place[static_cast<Eigen::Index>(k)]);
        }
        leaves_.push_back(leaf);
        return -static_cast<int>(leaves_.size());
    }

    /// Sorted into the lower and the higher half along the longest side of the box around them.
    static Entries parted(Entries first, Entries last) {
        Eigen::AlignedBox<Scalar, 3> box;
        for (auto entry = first; entry != last; ++entry) box.extend(entry->place);
        Eigen::Index axis = 0;
        box.sizes().maxCoeff(&axis);
        const auto middle = first + (last - first) / 2;
        std::nth_element(first, middle, last, [&](const Entry& a, const Entry& b) {
            return a.place[axis] != b.place[axis] ? a.place[axis] < b.place[axis] : a.vertex < b.vertex;
        });
        return middle;
    }

    void look_at(int vertex, Search& search) const {
        const Scalar squared = (core::point(vertices_, vertex) - search.place).squaredNorm();
        if (squared > search.squared || (squared == search.squared && !(vertex < search.vertex))) return;
        search.squared = squared;
        search.vertex = vertex;
        set_limit(search);
    }

    void look_into(int held, Search& search) const {
        if (held < 0) {
            const Leaf& leaf = leaves_[static_cast<std::size_t>(-held - 1)];
            const Eigen::Array<float, most_in_leaf, 1> squared = (leaf.places[0] - search.rounded[0]).square() +
                                                                 (leaf.places[1] - search.rounded[1]).square() +
                                                                 (leaf.places[2] - search.rounded[2]).square();
            if (!(squared.minCoeff() <= search.limit)) return;
            for (int i = 0; i < most_in_leaf; ++i)
                if (squared[i] <= search.limit) look_at(leaf.vertices[static_cast<std::size_t>(i)], search);
            return;
        }
        const Node& node = nodes_[static_cast<std::size_t>(held)];
        Eigen::Array<float, parts, 1> squared =
            outside(node, search, 0) + outside(node, search, 1) + outside(node, search, 2);
        for (;;) {
            Eigen::Index next = 0;
            if (!(squared.minCoeff(&next) <= search.limit)) return;
            squared[next] = far;
            look_into(node.held[static_cast<std::size_t>(next)], search);
        }
    }

    static Eigen::Array<float, parts, 1> outside(const Node& node, const Search& search, std::size_t k) {
        return ((node.middle[k] - search.rounded[static_cast<Eigen::Index>(k)]).abs() - node.half[k])
            .max(0.0F)
            .square();
    }

    const Points<Scalar>& vertices_;
    std::vector<Node> nodes_;
    std::vector<Leaf> leaves_;
    int root_ = 0;
    Scalar scale_ = 1;
};

} // namespace detail

template <typename Scalar>
MedialBalls<Scalar> medial_balls(const TriangleMesh<Scalar>& mesh, std::type_identity_t<Scalar> largest_radius) {
    constexpr std::size_t most_steps = 30; // a ball shrinks in a few steps; none may go on for its last bits
    const Points<Scalar> normals = core::vertex_normals(mesh);
    const detail::VertexTree<Scalar> tree(mesh.vertices);
    MedialBalls<Scalar> balls{Points<Scalar>(mesh.vertices.rows(), 3),
                              Eigen::Matrix<Scalar, Eigen::Dynamic, 1>(mesh.vertices.rows())};
    constexpr std::size_t in_a_row = 128;
    const std::vector<int> order = tree.in_order();
    core::parallel_for((order.size() + in_a_row - 1) / in_a_row, 1, [&](std::size_t row) {
        std::array<int, most_steps> touched; // by the ball before this one, which is much like it
        touched.fill(-1);
        for (std::size_t i = row * in_a_row; i < std::min(order.size(), (row + 1) * in_a_row); ++i) {
            const int v = order[i];
            const Vector3<Scalar> p = core::point(mesh.vertices, v), n = core::point(normals, v);
            Scalar radius = largest_radius;
            for (int& nearest : touched) {
                const Vector3<Scalar> centre = p - radius * n;
                nearest = tree.nearest(centre, radius * radius * (1 - core::rounding<Scalar>()), nearest);
                if (nearest < 0 || nearest == v) break;
                const Vector3<Scalar> chord = p - core::point(mesh.vertices, nearest);
                const Scalar along = chord.dot(n);
                if (along <= 0) break;
                const Scalar shrunk = chord.squaredNorm() / (2 * along);
                // The two contact points subtend this angle at the new centre.
                if (1 - chord.squaredNorm() / (2 * shrunk * shrunk) > detail::nearly_same_direction<Scalar>) break;
                radius = shrunk;
            }
            balls.radii[v] = radius;
            core::set_point(balls.centres, v, Vector3<Scalar>(p - radius * n));
        }
    });
    return balls;
}

} // namespace skelgen::curve
