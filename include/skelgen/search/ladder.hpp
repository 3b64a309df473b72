#pragma once

#include <memory>
#include <string>
#include <vector>

#include <skelgen/core/outcome.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/curve/find_curve.hpp>
#include <skelgen/search/extract_options.hpp>
#include <skelgen/search/line.hpp>
#include <skelgen/search/trail.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::search {

/// A candidate, and what it was found in.
template <typename Scalar = double>
struct Found {
    Candidate<Scalar> candidate;
    std::shared_ptr<const Body<Scalar>> body;  ///< in which it was found: opened
    std::shared_ptr<const Body<Scalar>> whole; ///< the same surface before that
    std::shared_ptr<const curve::CurveResult<Scalar>> curve;
    Hypothesis hypothesis;
    double noise = 0;                ///< smoothed away before: the root mean square, part of the body's size
    BodyKind plan = BodyKind::human; ///< of its template: the one wanted, or a four-legged animal's beside it
};

/// The skeleton that was found with its confidences, in the input's coordinates.
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> skeleton_in_input(const Found<Scalar>& found);

/// What is to be known of a skeleton beside its numbers: doubtful joints, what it lacks, contacts, repairs, noise.
template <typename Scalar>
[[nodiscard]] std::vector<std::string> warnings_of(const Found<Scalar>& found, const SkeletonTemplate& wanted);

/// What a climb has led to.
template <typename Scalar = double>
struct Climb {
    std::vector<Found<Scalar>>
        found;       ///< the best, its joints where all together expect them; all, in order, for an exhaustive one
    Failure failure; ///< where none was found: of what came nearest
    Trail trail;
    StageTimings timings;
};

/// How far a climb goes.
enum class Thoroughness {
    until_sure, ///< to the first candidate that is sure enough
    exhaustive  ///< through the whole budget, keeping all candidates: to calibrate with
};

/// The one loop of the search: tries what may be true of a mesh (hypothesis.hpp), in the order of what that promises,
/// until a candidate is sure enough or the budget of curves is used up. What is not sure leads to further hypotheses:
/// bodies laid into the surface itself, and finer curves for animals. How far all candidates agree is part of their
/// evidence. Each surface, curve and embedding is found once. `known`: joints' places in the mesh's coordinates, which
/// bodies at rest are laid to. Where the options ask for a four-legged animal, too, both are looked for in the same
/// curves, each is unlikely where the other is likely, and the likelier one is found. \throws Error bad_input when
/// `mesh` is no usable surface; usage when `options.prepare.component` is larger than the number of bodies.
template <typename Scalar>
[[nodiscard]] Climb<Scalar> climb(const TriangleMesh<Scalar>& mesh, const SkeletonTemplate& wanted,
                                  const ExtractOptions& options, Thoroughness thoroughness = Thoroughness::until_sure,
                                  std::vector<KnownPlace> known = {});

} // namespace skelgen::search

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/search/impl/ladder.hpp>
#endif
