#pragma once

#include <optional>

#include <skelgen/surface/body.hpp>

namespace skelgen::surface {

/// The body cut open where parts of it that touch have grown together: wherever a handle has a loop around it that is
/// shorter than a wrist's girth, as fingers on a hip, or runs along creases (see handle_loops), as a hand's contact
/// with a thigh. A limb that is a handle by itself, its end hidden in another, stays. Both sides are closed; what was
/// done is added to the body's repairs. \returns none where there is nothing to open, or more than 24 handles, as torn
/// surfaces have them. O(n log n) for each handle at most, for all that are far apart at once; O(n) without any.
template <typename Scalar>
[[nodiscard]] std::optional<Body<Scalar>> open_handles(const Body<Scalar>& body);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/open_handles.hpp>
#endif
