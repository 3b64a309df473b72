#pragma once

#include <skelgen/extract.hpp>

#include "mesh_input.hpp"

namespace skelgen::cli {

/// What is found in a file's mesh with the joints of the file's own rig, as far as these are sound: they lie in the
/// body, or near its surface. What was taken, and how far what is found without them lies from them, is a warning of
/// the skeleton. Fewer than half of a body's limb joints are none: then what is found is taken. \throws Error as
/// `io::read_mesh`, `io::read_rig` and `extract`, without the file's name; bad_input when the file has no rig, or it is
/// not known as a body's.
[[nodiscard]] Extraction<double> extract_with_rig(const MeshInput& input, const ExtractOptions& options);

} // namespace skelgen::cli
