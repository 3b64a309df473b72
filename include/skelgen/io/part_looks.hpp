#pragma once

#include <skelgen/applications/own_part.hpp>
#include <skelgen/io/scene_looks.hpp>

namespace skelgen::io {

/// The looks of a mesh's part that belongs to one body, by that part's own numbers. Linear.
[[nodiscard]] SceneLooks looks_of(const SceneLooks& looks, const applications::OwnPart& part);

} // namespace skelgen::io
