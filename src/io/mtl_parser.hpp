#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skelgen::io::detail {

/// A material of an MTL file: of what it says, what glTF has words for.
struct MtlMaterial {
    std::string name;
    std::optional<std::array<double, 3>> colour = {}; ///< Kd
    double opacity = 1;                               ///< d, else 1 - Tr
    std::optional<double> roughness = {};             ///< Pr, else by Ns as Blender has it
    double metalness = 0;                             ///< Pm
    std::string colour_map = {};                      ///< map_Kd: a file's name; empty: none
    std::string opacity_map = {};                     ///< map_d
};

/// Reads all materials of an MTL file. What is not known or unsound in it is skipped. Linear.
[[nodiscard]] std::vector<MtlMaterial> parse_mtl(std::string_view text);

} // namespace skelgen::io::detail
