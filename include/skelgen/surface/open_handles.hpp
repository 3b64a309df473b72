#pragma once

#include <optional>
#include <vector>

#include <skelgen/surface/body.hpp>

namespace skelgen::surface {

/// Which loops are taken for contacts.
enum class Contacts {
    short_or_creased, ///< also longer ones along creases, as of a hand with a thigh
    short_alone       ///< those that are short as they are: a thin waist may be a crease, too
};

/// A surface that has been cut open in some places.
template <typename Scalar = double>
struct OpenedSurface {
    TriangleMesh<Scalar> mesh;
    Triangles adjacency;
    std::vector<int> source; ///< per vertex that of the body, -1 for new ones; empty where there is no cut yet
    int opened = 0;          ///< in how many places
};

/// A body cut open.
template <typename Scalar = double>
struct OpenedBody {
    Body<Scalar> body;
    std::optional<OpenedSurface<Scalar>> before_creases; ///< its surface before the first cut at a loop that is not
                                                         ///< short; none where all are: Contacts::short_alone then
                                                         ///< leads to the same body
};

/// The body cut open where parts of it that touch have grown together: wherever a handle has a loop around it that is
/// shorter than a wrist's girth, as fingers on a hip, or runs along creases (see handle_loops), as a hand's contact
/// with a thigh. A limb that is a handle by itself, its end hidden in another, stays. Both sides are closed; what was
/// done is added to the body's repairs. \returns none where there is nothing to open, or more than 24 handles, as torn
/// surfaces have them. O(n log n) for each handle at most, for all that are far apart at once; O(n) without any.
template <typename Scalar>
[[nodiscard]] std::optional<OpenedBody<Scalar>> open_handles(const Body<Scalar>& body,
                                                             Contacts contacts = Contacts::short_or_creased);

/// The same at short loops alone, of a body that `opened` comes of, as open_handles has them: its cuts up to the first
/// that is not at one are taken over.
template <typename Scalar>
[[nodiscard]] std::optional<OpenedBody<Scalar>> open_short_handles(const Body<Scalar>& body,
                                                                   const OpenedBody<Scalar>& opened);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/open_handles.hpp>
#endif
