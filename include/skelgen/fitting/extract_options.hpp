#pragma once

#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/curve/find_curve.hpp>
#include <skelgen/embedding/spectral_matching.hpp>
#include <skelgen/refinement/refine.hpp>
#include <skelgen/surface/prepare.hpp>
#include <skelgen/symmetry/sides.hpp>

namespace skelgen::fitting {

/// What `extract_skeleton` looks for and how; the defaults of each stage are documented with it.
struct ExtractOptions {
    SkeletonTemplate skeleton_template; ///< empty: the built-in `human21`
    surface::PrepareOptions prepare;
    curve::CurveOptions curve;
    embedding::MatchingOptions matching;
    refinement::RefinementOptions refinement;
    symmetry::SidesOptions sides;
    bool with_curve = true; ///< whether the curve comes out, too: without it, joints are the same, in less time
    int threads = 1;        ///< that work on it, 1 to 1024; what comes out does not depend on it
};

/// \throws Error usage when an option is out of its range, bad_input when the template breaks a rule
/// (core/template_rules.hpp).
void validate(const ExtractOptions& options);

/// Those for a first try, which serves most bodies as well and takes a third of the time for the curve: a proxy of half
/// as many vertices (but no fewer than 750: fewer are no body's any longer), contracted in half as many steps, as it is
/// held to the balls inside five times as firmly, and a draft of the curve (curve/find_curve.hpp). Calibrated on the
/// bodies of the README's tables.
ExtractOptions for_first_try(ExtractOptions options);

} // namespace skelgen::fitting

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/fitting/impl/extract_options.hpp>
#endif
