#pragma once

#include <functional>

#include <skelgen/applications/heat_weights.hpp>
#include <skelgen/applications/resting_surface.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {

/// The weights with forearms and calves that keep their volume when elbows and knees bend by 90 degrees from rest, by
/// linear skinning: where what follows the hinge most and surrounds its bone would change by more than a twentieth, to
/// 3 %. Where few rings of vertices make a limb no place of the border does that alone: those beside it move too far or
/// not far enough, and a ring less or more is another part. So the logarithm of the odds of following the hinge may be
/// shifted, which moves the border along the limb, multiplied, which makes the bend narrower, and slanted, which turns
/// the border about the hinge's axis. All that bends is changed alike: pieces that lie on each other, as a sleeve on an
/// arm, stay together. Of the changes that serve the least is taken; where none does, that which leaves least, if it is
/// less than before. No part loses more than half of itself to the other one, and the part above changes by no more
/// than the one below may, or it did before. `restricted` is what weights have to keep to: those that are tried are
/// judged after it. `surface` at rest as `with_balanced_bends` has it; `faces` name the rows.
/// O(n joints) for what keeps its volume already, else O(changes faces around the hinge + tries (n joints +
/// restricted)), where of hundreds of changes at most some tens are tried.
template <typename Scalar>
[[nodiscard]] JointWeights with_kept_volumes(JointWeights weights, const RestingSurface<Scalar>& surface,
                                             const Triangles& faces, const SkeletonTemplate& skeleton_template,
                                             const std::function<JointWeights(JointWeights)>& restricted);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/kept_volumes.hpp>
#endif
