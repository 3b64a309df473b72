#pragma once

#include <string>
#include <vector>

#include <skelgen/applications/segmentation.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/coloured_ply.hpp>

namespace skelgen::cli {

/// The values of the option --parts.
inline const std::vector<std::string> part_sets{"bones", "body"};

/// The parts of a mesh's vertices and faces; `set` is one of `part_sets`.
[[nodiscard]] applications::Segmentation parts_of(const Extraction<double>& found, const std::string& set);

/// Each vertex in the colour of its part.
[[nodiscard]] std::vector<io::ByteColour> vertex_colours(const applications::Segmentation& parts);

} // namespace skelgen::cli
