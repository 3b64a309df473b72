#pragma once

#include <skelgen/extract.hpp>

#include "mesh_input.hpp"

namespace skelgen::cli {

/// Goes through the stages once more and prints on standard error what each of them makes of a mesh in which no
/// skeleton has been found: a line for the surface, the curve, and the template's place in it.
/// \throws Error as `io::read_mesh` and `prepare`, without the file's name.
void print_stages(const MeshInput& mesh, const ExtractOptions& options);

} // namespace skelgen::cli
