#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace skelgen::io {

/// A run of a scene's vertices and faces that look alike.
struct ScenePart {
    Eigen::Index first_vertex = 0, vertices = 0;
    Eigen::Index first_face = 0, faces = 0;
    std::optional<std::size_t> material; ///< index into the materials
    /// Sets of texture coordinates, vertices x 2 each.
    std::vector<Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>> texture_coordinates;
    /// Vertices x 4: red, green, blue (linear) and alpha, 0 to 1, by which the material's colour is multiplied; no rows
    /// where there are none.
    Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor> colours = {};
};

/// What a scene's mesh looks like, beside its shape: the part of a glTF file that other programs need to draw it alike.
struct SceneLooks {
    /// All faces, in their order. Several may have the same vertices.
    std::vector<ScenePart> parts;
    /// JSON, an object with the file's "materials", "textures", "samplers", "images", and with those of
    /// "extensionsUsed" and "extensionsRequired" that these need. Images have a "mimeType" and no bytes.
    std::string json = "{}";
    std::vector<std::string> pictures; ///< the bytes of the images, in their order
    /// Why images of the file are not there, one reason each: they are missing or damaged. What would show them has the
    /// plain colour that the file has beside them.
    std::vector<std::string> lost_pictures = {};
};

/// Reads how the mesh of a glTF, GLB or VRM file looks: of the vertices and faces that `read_mesh` gives. None for
/// other files, which have looks of other kinds. \throws Error as `read_mesh`.
[[nodiscard]] std::optional<SceneLooks> read_looks(const std::filesystem::path& path);

/// The same of a file's content, as `parse_mesh`: pictures in files of their own are lost.
[[nodiscard]] std::optional<SceneLooks> parse_looks(std::string_view content);

} // namespace skelgen::io
