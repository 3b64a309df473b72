#pragma once

#include <optional>

#include <skelgen/surface/body.hpp>

namespace skelgen::surface {

/// The body with a lid on each of its pockets, as a modelled mouth is one: cavities that are wider inside than their
/// mouth, whose walls see each other across less than the breadth of a head. What lies between limbs, however near they
/// are, is none: a rim that long around so little surface is no mouth's (see impl). Vertices in a pocket are left out;
/// what was done is added to the body's repairs. \returns none where there is nothing to close. O(log n) for each face
/// that another one lies opposite to, and for some thousand more.
template <typename Scalar>
[[nodiscard]] std::optional<Body<Scalar>> close_pockets(const Body<Scalar>& body);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/pockets.hpp>
#endif
