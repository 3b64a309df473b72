#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <skelgen/core/mesh.hpp>
#include <skelgen/io/read_mesh.hpp>

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
    /// Vertices x 3: where the file has them, as it shows the mesh; zero where a vertex has none. No rows: none has.
    Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> normals = {};
    /// An earlier part that has the same vertices, and has what they look like for both; then all of the above are
    /// empty.
    std::optional<std::size_t> same_as = std::nullopt;
};

/// How far vertices move when a morph target has the weight 1.
struct MorphTarget {
    std::vector<int> vertices; ///< of the mesh, rising: those that it moves, or whose normals it changes
    Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> positions = {}; ///< how far each of them is moved
    /// What is added to the normal of each; no rows: nothing is known of them.
    Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> normals = {};
};

/// A run of parts that were one object in the scene.
struct SceneObject {
    std::string name, mesh_name; ///< of its node and of its mesh; empty: none
    std::size_t first_part = 0, parts = 0;
    std::vector<MorphTarget> morphs = {};
    std::vector<double> weights = {}; ///< of the morph targets as the mesh is: one each
    std::string extras, mesh_extras;  ///< JSON of the "extras" of node and mesh, the targets' names in it; empty: none
    std::size_t node = 0, mesh = 0;   ///< their numbers in the file
};

/// What a scene's mesh looks like, beside its shape: the part of a glTF file that other programs need to draw it alike.
struct SceneLooks {
    /// All faces, in their order. Several may have the same vertices.
    std::vector<ScenePart> parts;
    /// Where corners at one vertex look different (an OBJ's at a seam or a hard edge) there are further vertices,
    /// behind the mesh's own. Each is the number of the mesh's vertex that it is a copy of. Then each part has all of
    /// the vertices.
    std::vector<int> copies = {};
    /// Faces of the mesh, by its vertices and their copies; no rows: as they are in the mesh.
    Triangles faces = {};
    /// JSON, an object with the file's "materials", "textures", "samplers", "images", and with those of
    /// "extensionsUsed" and "extensionsRequired" that these need. Images have a "mimeType" and no bytes.
    std::string json = "{}";
    std::vector<std::string> pictures; ///< the bytes of the images, in their order
    /// Why images of the file are not there, one reason each: they are missing or damaged. What would show them has the
    /// plain colour that the file has beside them.
    std::vector<std::string> lost_pictures = {};
    /// Why files of materials (an OBJ's MTL) are not there, or materials not in them, one reason each: these have their
    /// names alone then.
    std::vector<std::string> lost_materials = {};
    /// All parts, in their order; none where the file knows no objects.
    std::vector<SceneObject> objects = {};
    /// JSON, an object: what the file says of itself, as its "asset" has it ("copyright", "extras").
    std::string about = "{}";
    /// JSON: what VRM says of an avatar, in the terms of VRM 1.0, as `rig_to_vrm` takes it over; empty: no VRM.
    std::string vrm;
    /// What the file's licence forbids ("redistribution and modification"), as far as VRM tells; empty: nothing.
    std::string forbidden;
    /// What else was in the file and is not here, a phrase each ("2 animations").
    std::vector<std::string> left_out = {};
};

/// How many morph targets the objects have together.
[[nodiscard]] inline std::size_t morph_target_count(const SceneLooks& looks) {
    std::size_t count = 0;
    for (const SceneObject& object : looks.objects) count += object.morphs.size();
    return count;
}

/// What is to be said of a character's makers; empty: what its file says.
struct Credits {
    std::string title, author, license; ///< of the licence its name or its address
};

/// The looks with these credits in the place of their own.
[[nodiscard]] SceneLooks with_credits(SceneLooks looks, const Credits& credits);

/// Reads how the mesh of a file looks: of the vertices and faces that `read_mesh` gives with these options. O(n log n).
///
/// - GLB, glTF, VRM: materials and all they need, texture coordinates, colours, normals; objects with their names and
///   morph targets. Normals of objects with morph targets are those without them.
/// - OBJ: normals, texture coordinates, colours behind vertices. Of the materials of its MTL files colour (Kd),
///   opacity (d, Tr), roughness (Pr, else Ns), metalness (Pm) and picture (map_Kd, PNG or JPEG). These files are looked
///   for as the OBJ names them, in its folder or below; a picture also beside the MTL, or by its bare name.
/// - PLY: normals and colours of vertices; a picture that it names is said to be lost.
///
/// Colours of OBJ and PLY are taken for sRGB where vertices have them, those of MTL for linear ones, as Blender does.
/// None for other files, and for those that say nothing of looks. \throws Error as `read_mesh`.
[[nodiscard]] std::optional<SceneLooks> read_looks(const std::filesystem::path& path,
                                                   const ReadMeshOptions& options = {});

/// The same of a file's content, as `parse_mesh`: what is in files of their own is lost.
[[nodiscard]] std::optional<SceneLooks> parse_looks(std::string_view content, const ReadMeshOptions& options = {});

} // namespace skelgen::io
