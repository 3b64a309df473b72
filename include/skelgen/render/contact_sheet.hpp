#pragma once

#include <string>
#include <vector>

#include <skelgen/render/image.hpp>

namespace skelgen::render {

/// How many columns show `cells` pictures of that size most nearly as a square; at least 1.
[[nodiscard]] int sheet_columns(int cells, int cell_width, int cell_height);

/// Puts pictures of equal size side by side, row by row.
/// \throws Error usage when there is none, when their sizes differ or when `columns` < 1.
[[nodiscard]] Image contact_sheet(const std::vector<Image>& cells, int columns);

/// The same of SVG documents written by `render_svg`, each `cell_width` x `cell_height` pixels.
/// \throws Error usage when there is none or when `columns` < 1.
[[nodiscard]] std::string svg_contact_sheet(const std::vector<std::string>& cells, int columns, int cell_width,
                                            int cell_height);

} // namespace skelgen::render
