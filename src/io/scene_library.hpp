#pragma once

#include <functional>
#include <string_view>

struct aiScene;

namespace skelgen::io::detail {

/// What the library makes of a node whose place is told in several steps, as FBX has them: as many nodes, or one, which
/// is what animations are of.
enum class Pivots { several_nodes, one_node };

/// Has the library assimp import a scene, and `use` look at it; no file but the scene's own is read. `extension`: "fbx"
/// or "dae". The library is loaded here.
/// \throws Error bad_input when the library is not on this machine, or cannot read the scene.
void with_imported_scene(std::string_view bytes, const char* extension, const std::function<void(const aiScene&)>& use,
                         Pivots pivots = Pivots::several_nodes);

} // namespace skelgen::io::detail
