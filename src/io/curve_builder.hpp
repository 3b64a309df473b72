#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>

namespace skelgen::io::detail {

/// Puts together the curve skeleton that a reader finds, and lets through no part that contradicts the others. `fail`
/// is called with what is wrong; it throws, naming the place in the file.
template <typename Scalar>
class CurveBuilder {
public:
    /// \param first_index what the file counts nodes from, for its errors
    explicit CurveBuilder(int first_index) : first_index_(first_index) {}

    [[nodiscard]] std::size_t node_count() const { return coordinates_.size() / 3; }

    /// A node behind those before.
    template <typename Fail>
    void add_node(const std::array<Scalar, 3>& node, const Fail& fail) {
        if (!radii_.empty() && radii_.size() != node_count()) fail("the node before has no radius, but others have");
        if (node_count() >= static_cast<std::size_t>(std::numeric_limits<int>::max())) fail("there are too many nodes");
        coordinates_.insert(coordinates_.end(), node.begin(), node.end());
    }

    /// The radius of the last node; all have one, or none.
    template <typename Fail>
    void add_radius(Scalar radius, const Fail& fail) {
        if (radii_.size() + 1 > node_count()) fail("a radius comes without a node before it");
        if (radii_.size() + 1 < node_count()) fail("this node has a radius, but others have none");
        if (!(radius >= 0)) fail("a radius is negative");
        radii_.push_back(radius);
    }

    void clear_radii() { radii_.clear(); }
    void set_radius(std::size_t node, Scalar radius) { radii_[node] = radius; }

    /// An edge between two nodes, counted from 0, of which there are or will be `nodes`.
    template <typename Fail>
    void add_edge(std::int64_t a, std::int64_t b, std::size_t nodes, const Fail& fail) {
        for (const std::int64_t node : {a, b})
            if (node < 0 || static_cast<std::uint64_t>(node) >= nodes)
                fail("an edge names a node that does not exist: " + std::to_string(node + first_index_) +
                     " (counted from " + std::to_string(first_index_) + "); there are " + std::to_string(nodes));
        if (a == b) fail("an edge goes from a node to itself: " + std::to_string(a + first_index_));
        const std::array<int, 2> edge{static_cast<int>(std::min(a, b)), static_cast<int>(std::max(a, b))};
        if (!edges_.insert(edge).second)
            fail("the edge between " + std::to_string(a + first_index_) + " and " + std::to_string(b + first_index_) +
                 " is there already");
    }

    /// The curve skeleton, its edges in ascending order.
    template <typename Fail>
    [[nodiscard]] CurveSkeleton<Scalar> finish(const Fail& fail) {
        if (coordinates_.empty()) fail("there are no nodes");
        if (!radii_.empty() && radii_.size() != node_count()) fail("the last node has no radius, but others have");
        CurveSkeleton<Scalar> curve;
        curve.nodes = Eigen::Map<const Points<Scalar>>(coordinates_.data(), static_cast<Eigen::Index>(node_count()), 3);
        curve.edges.assign(edges_.begin(), edges_.end());
        curve.radii = std::move(radii_);
        return curve;
    }

private:
    int first_index_;
    std::vector<Scalar> coordinates_;
    std::vector<Scalar> radii_;
    std::set<std::array<int, 2>> edges_; ///< first < second
};

} // namespace skelgen::io::detail
