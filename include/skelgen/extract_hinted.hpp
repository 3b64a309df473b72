#pragma once

#include <string>
#include <vector>

#include <skelgen/extract.hpp>

namespace skelgen {

/// Where someone who looks at a mesh says that a joint is.
struct Hint {
    std::string joint;                                  ///< of the template: "left_hand"
    Vector3<double> position = Vector3<double>::Zero(); ///< in the mesh's coordinates
};

/// Moves a skeleton's joints so that the hinted ones are where the hints have them. The others follow along the bones:
/// those of head and limbs as beads on an elastic thread between hinted joints and the trunk; the trunk's give way
/// little. End points move with their joints. `size`: of the body, in the skeleton's unit. \throws Error usage when
/// a hint names no joint of the template, or two name the same; or its place is not finite.
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> bent_to(KinematicSkeleton<Scalar> skeleton,
                                                const SkeletonTemplate& skeleton_template,
                                                const std::vector<Hint>& hints, Scalar size);

/// As `extract`, with hints as witnesses: all candidates of the search are looked at, with the sides of arms and legs
/// as they are and exchanged, and bodies at rest are laid to the hints (`search::fit_at_rest`). That which is likeliest
/// by itself and has its joints nearest to the hints is taken and bent to them (`bent_to`), and so are the other side's
/// joints to where the surface mirrors the hints, where it does. Where it is unlikely, bodies in any pose are laid into
/// the surface and to the hints, from all of these on (`search::fit_posed`), and the cheapest is taken. However
/// unlikely that is, it is an answer: its confidence says what it would be worth without hints. Hinted joints have a
/// confidence of 1. Takes as long as a search that does not find anything. \throws Error as `extract` and `bent_to`;
/// usage when a hint is far outside of the mesh; NoSkeleton when there is no candidate at all.
template <typename Scalar>
[[nodiscard]] Extraction<Scalar> extract_hinted(TriangleMesh<Scalar> mesh, const std::vector<Hint>& hints,
                                                const ExtractOptions& options = {});

} // namespace skelgen

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/impl/extract_hinted.hpp>
#endif
