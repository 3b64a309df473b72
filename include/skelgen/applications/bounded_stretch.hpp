#pragma once

#include <vector>

#include <skelgen/applications/heat_weights.hpp>
#include <skelgen/applications/resting_surface.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {

/// The weights with no edge that grows to more than 1.9 times its length when elbows and knees bend by 90 degrees from
/// rest, nor to more than three times when any joint of a limb bends so, by linear skinning: where it would, the
/// weights of its ends come nearer to each other, in rounds over the edges whose ends the last one changed, and so
/// moved at rest; nothing else changes. Edges between two limbs stay. Edges shorter than a thousandth of the square
/// root of the area count as that long. `faces` name the weights' rows, `limb_of_joint` as `LimbRegions::of_joint`.
/// O(rounds faces + joints).
template <typename Scalar>
[[nodiscard]] JointWeights with_bounded_stretch(JointWeights weights, const RestingSurface<Scalar>& surface,
                                                const Triangles& faces, const SkeletonTemplate& skeleton_template,
                                                const std::vector<int>& limb_of_joint);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/bounded_stretch.hpp>
#endif
