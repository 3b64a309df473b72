#pragma once

#include <vector>

#include <skelgen/curve/branch_sections.hpp>
#include <skelgen/curve/branched_curve.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

/// Each branch joined to the others where the way there is best centred: from where its own sections begin, it goes
/// straight to that point of the branches at its junction, not much farther from the junction than the branch lies in
/// them, to which the sections across the way are least off their centres, summed over its length. The way that it has
/// stays if it is about as good, or if the axes meet at its junction. Junctions that are left by all but two branches
/// go. \param meetings per knot, the place where axes meet, as meeting_axes() finds it. \param spacing of the lines'
/// points. O(branches k) sections.
template <typename Scalar>
[[nodiscard]] BranchedCurve<Scalar> reattach_branches(BranchedCurve<Scalar> branched,
                                                      const PlacesOfKnots<Scalar>& meetings, const Body<Scalar>& body,
                                                      std::type_identity_t<Scalar> spacing);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/attachment.hpp>
#endif
