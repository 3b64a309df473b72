#pragma once

#include <string_view>

namespace skelgen {

/// Why there is no skeleton, or none that this hypothesis leads to. The names that files have are `to_string`'s.
enum class Refusal {
    none,
    several_bodies,   ///< bodies that stand apart: each wants a file of its own
    nothing_enclosed, ///< the surface encloses no volume
    too_compact,      ///< the shape reaches no farther than it is thick
    too_few_ends,     ///< the curve skeleton has fewer ends and junctions than the template
    too_many_ends,    ///< it has more than any body: a torn surface
    curve_in_pieces,  ///< it is not connected
    flat_trunk,       ///< trunk or hips have no extent, so that sides have no meaning
    no_mirror,        ///< the surface mirrors itself in no plane: no body at rest can be laid into it
    unlikely,         ///< a skeleton was found, and the evidence is against it
};

/// As files spell it: "too_few_ends".
[[nodiscard]] constexpr std::string_view to_string(Refusal refusal) {
    switch (refusal) {
    case Refusal::several_bodies:
        return "several_bodies";
    case Refusal::nothing_enclosed:
        return "nothing_enclosed";
    case Refusal::too_compact:
        return "too_compact";
    case Refusal::too_few_ends:
        return "too_few_ends";
    case Refusal::too_many_ends:
        return "too_many_ends";
    case Refusal::curve_in_pieces:
        return "curve_in_pieces";
    case Refusal::flat_trunk:
        return "flat_trunk";
    case Refusal::no_mirror:
        return "no_mirror";
    case Refusal::unlikely:
        return "unlikely";
    case Refusal::none:
        break;
    }
    return "none";
}

} // namespace skelgen
