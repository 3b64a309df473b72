#include "obj_looks.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/io/polygon_mesh.hpp>

#include "json_values.hpp"
#include "mesh_parsers.hpp"
#include "obj_file.hpp"
#include "obj_materials.hpp"
#include "srgb.hpp"

namespace skelgen::io::detail {
namespace {

/// Of each row of numbers the number of the first one that is equal. O(n log n).
std::vector<int> first_equals(const std::vector<float>& numbers, std::size_t columns) {
    std::vector<int> order(numbers.size() / columns), first(order.size());
    std::iota(order.begin(), order.end(), 0);
    const auto row = [&](int i) { return numbers.begin() + static_cast<std::ptrdiff_t>(columns) * i; };
    const auto width = static_cast<std::ptrdiff_t>(columns);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return std::lexicographical_compare(row(a), row(a) + width, row(b), row(b) + width);
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool is_same = i > 0 && std::equal(row(order[i]), row(order[i]) + width, row(order[i - 1]));
        first[static_cast<std::size_t>(order[i])] = is_same ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
    }
    return first;
}

/// The faces of an OBJ by vertices that look alike from all sides: its own, and copies of them.
struct SplitVertices {
    Triangles faces;
    std::vector<int> face_source; ///< per face the polygon
    std::vector<ObjCorner> looks; ///< of the vertices, then of the copies
    std::vector<int> copies;      ///< whose
};

class CornerSplitter {
public:
    explicit CornerSplitter(const ObjFile& file)
        : file_(&file), textures_(first_equals(file.texture_coordinates, 2)), normals_(first_equals(file.normals, 3)),
          is_used_(file.mesh.coordinates.size() / 3, false) {
        split_.looks.resize(is_used_.size());
    }

    SplitVertices split() {
        CutPolygons cut = cut_polygons(file_->mesh);
        std::vector<std::size_t> first_corner(file_->mesh.sizes.size());
        std::size_t corners = 0;
        for (std::size_t face = 0; face < first_corner.size(); ++face) {
            first_corner[face] = corners;
            corners += static_cast<std::size_t>(file_->mesh.sizes[face]);
        }
        for (Eigen::Index f = 0; f < cut.triangles.rows(); ++f) {
            const std::size_t first = first_corner[static_cast<std::size_t>(cut.source[static_cast<std::size_t>(f)])];
            for (int k = 0; k < 3; ++k) cut.triangles(f, k) = vertex_of(corner_at(first, cut.triangles(f, k)));
        }
        split_.faces = std::move(cut.triangles);
        split_.face_source = std::move(cut.source);
        return std::move(split_);
    }

private:
    /// The corner of a polygon that is at the vertex; the first one where it comes there twice.
    [[nodiscard]] std::size_t corner_at(std::size_t first, int vertex) const {
        const auto begin = file_->mesh.corners.begin();
        return static_cast<std::size_t>(
            std::find(begin + static_cast<std::ptrdiff_t>(first), file_->mesh.corners.end(), vertex) - begin);
    }

    [[nodiscard]] bool is_zero(int normal) const {
        const auto first = file_->normals.begin() + 3 * static_cast<std::ptrdiff_t>(normal);
        return std::all_of(first, first + 3, [](float x) { return x == 0; });
    }

    /// The vertex, or the copy of it, that looks as the corner does. The first corner has the vertex itself.
    int vertex_of(std::size_t corner) {
        const int vertex = file_->mesh.corners[corner];
        const auto v = static_cast<std::size_t>(vertex);
        ObjCorner looks = file_->corners[corner];
        if (looks.texture >= 0) looks.texture = textures_[static_cast<std::size_t>(looks.texture)];
        if (looks.normal >= 0) looks.normal = normals_[static_cast<std::size_t>(looks.normal)];
        if (looks.normal >= 0 && is_zero(looks.normal)) looks.normal = -1;
        if (!is_used_[v]) {
            is_used_[v] = true;
            split_.looks[v] = looks;
        }
        if (split_.looks[v] == looks) return vertex;
        if (split_.looks.size() >= static_cast<std::size_t>(std::numeric_limits<int>::max()))
            throw Error(ErrorCode::bad_input, "has more corners than an int can count; simplify it");
        const auto [known, is_new] =
            copies_.emplace(std::array{vertex, looks.texture, looks.normal}, static_cast<int>(split_.looks.size()));
        if (is_new) {
            split_.looks.push_back(looks);
            split_.copies.push_back(vertex);
        }
        return known->second;
    }

    const ObjFile* file_;
    std::vector<int> textures_, normals_; ///< see `first_equals`
    std::vector<bool> is_used_;
    std::map<std::array<int, 3>, int> copies_; ///< by vertex, texture coordinates and normal
    SplitVertices split_;
};

/// Rows of numbers, one per vertex, by the number of the row that each has; zero for -1. No rows where there are none.
template <typename Rows, typename Index>
Rows rows_by(const std::vector<float>& numbers, std::size_t vertices, const Index& index) {
    if (numbers.empty()) return {};
    Rows rows = Rows::Zero(static_cast<Eigen::Index>(vertices), Rows::ColsAtCompileTime);
    for (Eigen::Index v = 0; v < rows.rows(); ++v)
        if (const std::ptrdiff_t row = index(static_cast<std::size_t>(v)); row >= 0)
            for (Eigen::Index k = 0; k < rows.cols(); ++k)
                rows(v, k) = numbers[static_cast<std::size_t>(row * rows.cols() + k)];
    return rows;
}

using Colours = decltype(ScenePart::colours);
using Normals = decltype(ScenePart::normals);
using Coordinates = decltype(ScenePart::texture_coordinates)::value_type;

/// Colours as glTF has them: light, 0 to 1. Those of an OBJ may go to 255.
Colours as_light(Colours colours) {
    constexpr float most = 255;
    if (colours.rows() > 0 && colours.maxCoeff() > 1) {
        colours.leftCols<3>() /= most;
        if (colours.col(3).maxCoeff() > 1) colours.col(3) /= most;
    }
    colours = colours.cwiseMax(0.0F).cwiseMin(1.0F);
    for (Eigen::Index v = 0; v < colours.rows(); ++v)
        for (int channel = 0; channel < 3; ++channel) colours(v, channel) = linear_light(colours(v, channel));
    return colours;
}

/// What the vertices and their copies look like, as a part with all faces.
ScenePart whole_part(const ObjFile& file, const SplitVertices& split) {
    const std::size_t own = file.mesh.coordinates.size() / 3, all = split.looks.size();
    ScenePart part{0, static_cast<Eigen::Index>(all), 0, split.faces.rows(), std::nullopt, {}};
    auto coordinates =
        rows_by<Coordinates>(file.texture_coordinates, all, [&](std::size_t v) { return split.looks[v].texture; });
    for (Eigen::Index v = 0; v < coordinates.rows(); ++v) // OBJ counts from the picture's foot, glTF from its top
        if (split.looks[static_cast<std::size_t>(v)].texture >= 0) coordinates(v, 1) = 1 - coordinates(v, 1);
    if (coordinates.rows() > 0) part.texture_coordinates.push_back(std::move(coordinates));
    part.normals = rows_by<Normals>(file.normals, all, [&](std::size_t v) { return split.looks[v].normal; });
    part.colours = as_light(rows_by<Colours>(file.colours, all, [&](std::size_t v) {
        return v < own ? static_cast<std::ptrdiff_t>(v) : static_cast<std::ptrdiff_t>(split.copies[v - own]);
    }));
    return part;
}

/// The part as runs of faces of the same material, in their order.
std::vector<ScenePart> parts_by_material(ScenePart whole, const std::vector<int>& face_source,
                                         const std::vector<int>& materials) {
    const auto material_of = [&](std::size_t face) -> std::optional<std::size_t> {
        const int material = materials[static_cast<std::size_t>(face_source[face])];
        return material < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(material));
    };
    std::vector<ScenePart> parts;
    const Eigen::Index vertices = whole.vertices;
    for (std::size_t face = 0; face < face_source.size(); ++face) {
        const auto material = material_of(face);
        if (parts.empty() || parts.back().material != material) {
            if (parts.empty())
                parts.push_back(std::move(whole));
            else
                parts.push_back({0, vertices, 0, 0, std::nullopt, {}});
            if (parts.size() > 1) parts.back().same_as = 0;
            parts.back().first_face = static_cast<Eigen::Index>(face);
            parts.back().faces = 0;
            parts.back().material = material;
        }
        ++parts.back().faces;
    }
    return parts;
}

/// Where vertices have colours, parts without a material get one that shows them: glTF's own is of bare metal.
SceneLooks with_painted_material(SceneLooks looks) {
    if (looks.parts.front().colours.rows() == 0) return looks;
    Json json = parse_json(looks.json);
    const std::size_t number = json.contains("materials") ? json["materials"].size() : 0;
    bool is_needed = false;
    for (ScenePart& part : looks.parts) {
        if (part.material) continue;
        part.material = number;
        is_needed = true;
    }
    if (!is_needed) return looks;
    json["materials"].push_back({{"name", "vertex colours"},
                                 {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}},
                                 {"doubleSided", true}});
    looks.json = json.dump();
    return looks;
}

} // namespace

std::optional<SceneLooks> read_obj_looks(std::string_view text, const LoadCompanion& load) {
    const ObjFile file = parse_obj_file(text);
    if (file.texture_coordinates.empty() && file.normals.empty() && file.colours.empty() && file.materials.empty())
        return std::nullopt;
    SplitVertices split = CornerSplitter(file).split();
    SceneLooks looks;
    looks.parts = parts_by_material(whole_part(file, split), split.face_source, file.face_materials);
    if (!split.copies.empty()) looks.faces = std::move(split.faces);
    looks.copies = std::move(split.copies);
    if (!file.materials.empty()) looks = with_obj_materials(std::move(looks), file, load);
    return with_painted_material(std::move(looks));
}

std::optional<SceneLooks> read_ply_looks(std::string_view bytes) {
    const PlyFile file = parse_ply_file(bytes);
    if (file.normals.empty() && file.colours.empty() && file.texture_file.empty()) return std::nullopt;
    const auto vertices = file.mesh.coordinates.size() / 3;
    const auto itself = [](std::size_t v) { return static_cast<std::ptrdiff_t>(v); };
    SceneLooks looks;
    looks.parts.push_back(
        {0, static_cast<Eigen::Index>(vertices), 0, cut_polygons(file.mesh).triangles.rows(), std::nullopt, {}});
    ScenePart& part = looks.parts.front();
    if (file.normals.size() == 3 * vertices) part.normals = rows_by<Normals>(file.normals, vertices, itself);
    if (file.colours.size() == 4 * vertices) part.colours = as_light(rows_by<Colours>(file.colours, vertices, itself));
    if (!file.texture_file.empty())
        looks.lost_pictures.push_back("'" + valid_utf8(file.texture_file) +
                                      "' is a PLY's, whose texture is not read; export the mesh as OBJ or GLB");
    return with_painted_material(std::move(looks));
}

} // namespace skelgen::io::detail
