#pragma once

#include <vector>

#include <skelgen/io/scene_looks.hpp>

#include "fitted_file.hpp"

namespace skelgen::cli {

/// What of a mesh belongs to one of several bodies in it, by numbers in the mesh, rising.
struct OwnPart {
    std::vector<int> faces, vertices;
    bool is_all = true; ///< then both are empty
};

/// Leaves in the mesh what belongs to the body that was found, and no other body that stands apart from it, and brings
/// what was found in agreement with that. Returns what has stayed. O(n log n) for each body.
OwnPart keep_own_part(FittedFile& file);

/// The looks of that part. Linear.
[[nodiscard]] io::SceneLooks looks_of(const io::SceneLooks& looks, const OwnPart& part);

} // namespace skelgen::cli
