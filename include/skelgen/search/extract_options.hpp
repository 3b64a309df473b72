#pragma once

#include <functional>

#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/curve/find_curve.hpp>
#include <skelgen/embedding/spectral_matching.hpp>
#include <skelgen/refinement/refine.hpp>
#include <skelgen/surface/prepare.hpp>

namespace skelgen::search {

/// What `extract` looks for and how; the defaults of each stage are documented with it.
struct ExtractOptions {
    SkeletonTemplate skeleton_template; ///< empty: the built-in `human21`
    bool or_quadruped = false; ///< whether a four-legged animal is looked for, too: the likelier of the two is taken
    surface::PrepareOptions prepare;
    curve::CurveOptions curve;
    embedding::MatchingOptions matching;
    refinement::RefinementOptions refinement;
    int budget = 12;        ///< curves that are looked for at most, counted in drafts (hypothesis.hpp); 1 to 1000
    bool with_curve = true; ///< whether the curve comes out, too: without it, joints are the same, in less time
    int threads = 1;        ///< that work on it, 1 to 1024; what comes out does not depend on it
    /// Called before each try with what of the budget is spent and the budget: what it throws ends the search.
    std::function<void(int spent, int budget)> before_try = {};
};

/// \throws Error usage when an option is out of its range, bad_input when the template breaks a rule
/// (core/template_rules.hpp).
void validate(const ExtractOptions& options);

/// The template that they ask for.
[[nodiscard]] SkeletonTemplate wanted_template(const ExtractOptions& options);

} // namespace skelgen::search

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/search/impl/extract_options.hpp>
#endif
