#pragma once

#include <algorithm>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>

namespace skelgen::core {

/// Curve skeletons as one: the nodes of the first, those of the second, and so on, with their edges. Radii and regions
/// are kept if every curve that has nodes has them; the regions' vertices stay as they are, so all curves have to be of
/// the same mesh. Without curves: an empty one. Linear.
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> joined(const std::vector<CurveSkeleton<Scalar>>& curves) {
    const auto all_have = [&](auto part) {
        return std::all_of(curves.begin(), curves.end(), [part](const CurveSkeleton<Scalar>& curve) {
            return (curve.*part).size() == static_cast<std::size_t>(curve.nodes.rows());
        });
    };
    const bool have_radii = all_have(&CurveSkeleton<Scalar>::radii);
    const bool have_regions = all_have(&CurveSkeleton<Scalar>::regions);

    CurveSkeleton<Scalar> out;
    Eigen::Index nodes = 0;
    for (const CurveSkeleton<Scalar>& curve : curves) nodes += curve.nodes.rows();
    out.nodes.resize(nodes, 3);
    int shift = 0;
    for (const CurveSkeleton<Scalar>& curve : curves) {
        out.nodes.middleRows(shift, curve.nodes.rows()) = curve.nodes;
        for (const auto& [a, b] : curve.edges) out.edges.push_back({a + shift, b + shift});
        if (have_radii) out.radii.insert(out.radii.end(), curve.radii.begin(), curve.radii.end());
        if (have_regions) out.regions.insert(out.regions.end(), curve.regions.begin(), curve.regions.end());
        shift += static_cast<int>(curve.nodes.rows());
    }
    return out;
}

} // namespace skelgen::core
