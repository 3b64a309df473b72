#pragma once

#include <string>
#include <string_view>

#include <skelgen/curve/find_curve.hpp>
#include <skelgen/surface/prepare.hpp>

namespace skelgen::search {

/// How much work goes into a curve skeleton.
enum class Effort {
    draft,         ///< a coarse proxy, roughly centred: enough for bodies
    detailed,      ///< roughly centred, with finer branches: tails, horns, trunks
    more_detailed, ///< the same of a proxy three times as fine
    rest_fit,      ///< none: a body at rest is laid into the surface (rest_fit.hpp)
    posed_fit      ///< none: a body in any pose is laid into the surface (posed_fit.hpp)
};

/// What may be true of a mesh: which surface stands for the body, and what is looked for in it. A value: the ladder
/// (ladder.hpp) tries one after the other.
struct Hypothesis {
    surface::Remedy surface = surface::Remedy::largest_piece;
    Effort effort = Effort::draft;
};

/// The options of a curve that is found with such an effort. A draft's proxy has half as many vertices as wanted (but
/// no fewer than 750: fewer are no body's any longer), is contracted in half as many steps, as it is held to the balls
/// inside five times as firmly, and is centred roughly (curve/find_curve.hpp). Calibrated on the research bodies.
[[nodiscard]] curve::CurveOptions curve_options(Effort effort, curve::CurveOptions wanted);

/// What a curve of such an effort costs, in drafts.
[[nodiscard]] int cost_of(Effort effort);

/// As trails spell them: "largest_piece", "draft", ...
[[nodiscard]] std::string_view to_string(surface::Remedy remedy);
[[nodiscard]] std::string_view to_string(Effort effort);

} // namespace skelgen::search

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/search/impl/hypothesis.hpp>
#endif
