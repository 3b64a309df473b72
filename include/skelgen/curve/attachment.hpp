#pragma once

#include <skelgen/curve/branched_curve.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

/// Each branch joined to the others where the way there is best centred: from where its own sections begin, it goes
/// straight to that point of the branches at its junction, at most `reach` times as far from the junction as the branch
/// lies in them, to which the sections across the way are least off their centres, summed over its length; the way
/// that it has stays if it is as good. Junctions that are left by all but two branches go. O(branches k) sections.
template <typename Scalar>
[[nodiscard]] BranchedCurve<Scalar> reattach_branches(BranchedCurve<Scalar> branched, const Body<Scalar>& body,
                                                      std::type_identity_t<Scalar> spacing);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/attachment.hpp>
#endif
