#pragma once

#include <skelgen/io/scene_looks.hpp>

#include "gltf_data.hpp"
#include "obj_file.hpp"

namespace skelgen::io::detail {

/// The looks with the materials that an OBJ file uses, numbered as `ObjFile::materials` has them, and their pictures.
/// What cannot be read is said in `lost_materials` and `lost_pictures`. Linear in the bytes read, which are
/// `max_file_bytes` at most.
[[nodiscard]] SceneLooks with_obj_materials(SceneLooks looks, const ObjFile& file, const LoadCompanion& load);

} // namespace skelgen::io::detail
