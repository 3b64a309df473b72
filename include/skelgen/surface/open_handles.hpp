#pragma once

#include <optional>

#include <skelgen/surface/body.hpp>

namespace skelgen::surface {

/// Which loops are taken for contacts.
enum class Contacts {
    short_or_creased, ///< also longer ones along creases, as of a hand with a thigh
    short_alone       ///< those that are short as they are: a thin waist may be a crease, too
};

/// A body cut open.
template <typename Scalar = double>
struct OpenedBody {
    Body<Scalar> body;
    bool is_short_alone = true; ///< at short loops only: Contacts::short_alone leads to the same body
};

/// The body cut open where parts of it that touch have grown together: wherever a handle has a loop around it that is
/// shorter than a wrist's girth, as fingers on a hip, or runs along creases (see handle_loops), as a hand's contact
/// with a thigh. A limb that is a handle by itself, its end hidden in another, stays. Both sides are closed; what was
/// done is added to the body's repairs. \returns none where there is nothing to open, or more than 24 handles, as torn
/// surfaces have them. O(n log n) for each pair of handles at most, O(n) without any.
template <typename Scalar>
[[nodiscard]] std::optional<OpenedBody<Scalar>> open_handles(const Body<Scalar>& body,
                                                             Contacts contacts = Contacts::short_or_creased);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/open_handles.hpp>
#endif
