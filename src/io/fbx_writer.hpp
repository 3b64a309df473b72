#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skelgen::io::detail {

/// What a scene's GLB does not say.
struct FbxOptions {
    double scale = 1;                  ///< what lengths are multiplied by
    double centimetres_per_unit = 100; ///< in a unit of the file, once they are
    /// As `SceneLooks::copies`: the last vertices of each primitive, which FBX has no need of.
    std::vector<int> copies = {};
    std::vector<double> seconds_per_frame = {}; ///< of each animation
};

/// A scene that this library has written as GLB, as binary FBX 7.4: meshes whose nodes do not move them, at most one
/// skin, and animations of its joints. Triangles are as they are there. Colours are those shown (sRGB), as three.js and
/// Unity take them; roughness and metalness are where Blender looks for them. Linear. \throws Error usage when the file
/// would be 4 GiB or larger.
[[nodiscard]] std::string glb_to_fbx(std::string_view glb, const FbxOptions& options);

/// How many pictures of a scene its FBX does not have: those that say how rough, metallic or shaded a place is.
[[nodiscard]] std::size_t pictures_lost_in_fbx(const std::string& looks_json);

} // namespace skelgen::io::detail
