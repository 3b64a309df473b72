#pragma once

#include <functional>
#include <string_view>

struct aiScene;

namespace skelgen::io::detail {

/// Has the library assimp import a scene, and `use` look at it; no file but the scene's own is read. `extension`: "fbx"
/// or "dae". The library is loaded here.
/// \throws Error bad_input when the library is not on this machine, or cannot read the scene.
void with_imported_scene(std::string_view bytes, const char* extension, const std::function<void(const aiScene&)>& use);

} // namespace skelgen::io::detail
