#pragma once

#include <vector>

#include <skelgen/surface/body.hpp>

namespace skelgen::surface {

/// The body without some of its faces (`is_left_out`, one entry for each), the holes that they leave closed; others
/// stay as they are. Of what is in pieces then the largest. O(n log n), and as fill_holes.
template <typename Scalar>
[[nodiscard]] Body<Scalar> without_faces(const Body<Scalar>& body, const std::vector<bool>& is_left_out);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/without_faces.hpp>
#endif
