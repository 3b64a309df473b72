#pragma once

#include <skelgen/applications/heat_weights.hpp>
#include <skelgen/applications/resting_surface.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {

/// The weights with the borders at elbows and knees moved along the limb, by at most some half of its radius, to where
/// a bend by 90 degrees from rest changes the volumes of what is above and below least, by linear skinning and as
/// squares of their shares. In a bent tube of section A whose border is the length c below the joint, whose middle line
/// is y inside of it, and which follows the hinge by w, the part below gains A (c / 4 - y / 2 - integral of w (1 - w))
/// beyond the border, and the part above A (-c / 4 - y / 2 - integral) on its side: what the one gains by moving the
/// border the other loses, and the smaller part feels it more. A limb that comes bent is another one at rest wherever
/// its border is, so each of the borders that are tried is seen on the surface that it leads to. Where several
/// pieces bend, as a skirt and the knee below it, borders stay, so that these stay together; and where a bend changes
/// both volumes together, as shares, by less than `tolerated`. `surface` closed, or open where the bend moves it little
/// or as a whole, its skeleton the template's rest pose but for lengths; `faces` name the rows. O(n joints).
template <typename Scalar>
[[nodiscard]] JointWeights with_balanced_bends(JointWeights weights, const RestingSurface<Scalar>& surface,
                                               const Triangles& faces, const SkeletonTemplate& skeleton_template,
                                               core::Accumulator tolerated = 0);

/// How much a bend by 90 degrees from rest changes the volumes of what is above and below an elbow or a knee together,
/// as shares, at the one where it is most. As `with_balanced_bends`. O(n joints).
template <typename Scalar>
[[nodiscard]] core::Accumulator largest_bend_change(const JointWeights& weights, const RestingSurface<Scalar>& surface,
                                                    const Triangles& faces, const SkeletonTemplate& skeleton_template);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/balanced_bends.hpp>
#endif
