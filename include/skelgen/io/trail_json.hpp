#pragma once

#include <string>

#include <skelgen/search/trail.hpp>

namespace skelgen::io {

/// What was tried on a mesh as JSON: {"format": "skelgen-trail", "version": 1, "tried": [{"surface", "opened", "cuts",
/// "held", "lacking", "curve", "outcome", "probability", "seconds"}...]}; `outcome` is "found" or a refusal's code.
[[nodiscard]] std::string trail_to_json(const search::Trail& trail);

} // namespace skelgen::io
