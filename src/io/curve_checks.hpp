#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/error.hpp>

namespace skelgen::io::detail {

/// \throws Error `code` when the parts of a curve skeleton contradict each other or a number is not finite.
template <typename Scalar>
void check_curve(const CurveSkeleton<Scalar>& curve, ErrorCode code) {
    const auto require = [code](bool condition, const char* broken) {
        if (!condition)
            throw Error(code, std::string("the curve skeleton is unsound: ") + broken + "; compute it again");
    };
    const auto nodes = static_cast<std::size_t>(curve.nodes.rows());
    const auto is_node = [nodes](int i) { return i >= 0 && static_cast<std::size_t>(i) < nodes; };
    require(curve.nodes.allFinite(), "a node's coordinate is not a number or infinite");
    for (const auto& [a, b] : curve.edges)
        require(is_node(a) && is_node(b), "an edge names a node that does not exist");
    require(curve.radii.empty() || curve.radii.size() == nodes, "there is not one radius for each node");
    require(curve.regions.empty() || curve.regions.size() == nodes, "there is not one region for each node");
    require(std::all_of(curve.radii.begin(), curve.radii.end(), [](Scalar r) { return std::isfinite(r) && r >= 0; }),
            "a radius is negative, infinite or not a number");
}

} // namespace skelgen::io::detail
