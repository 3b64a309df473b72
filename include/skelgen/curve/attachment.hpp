#pragma once

#include <vector>

#include <skelgen/curve/branch_sections.hpp>
#include <skelgen/curve/branched_curve.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

/// Does a branch that begins at a junction run in its own sections' middle as soon as it is out of the junction's ball,
/// or little farther, or does it end by then? So tubes meet, and shoulders do not. `sections` are those across `line`.
/// O(k).
template <typename Scalar>
[[nodiscard]] bool meets_tightly(const Points<Scalar>& line, const std::vector<BranchSection<Scalar>>& sections,
                                 const Body<Scalar>& body);

/// Each branch joined to the others where the way there is best centred: from where its own sections begin, it goes
/// straight to that point of the branches at its junction, not much farther from the junction than the branch lies in
/// them, to which the sections across the way are least off their centres, summed over its length. The way that it has
/// stays if it is about as good, or if the branch meets the others tightly. Junctions that are left by all but two
/// branches go. `spacing`: of the lines' points. O(branches k) sections.
template <typename Scalar>
[[nodiscard]] BranchedCurve<Scalar> reattach_branches(BranchedCurve<Scalar> branched, const Body<Scalar>& body,
                                                      std::type_identity_t<Scalar> spacing);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/attachment.hpp>
#endif
