#include "gltf_primitive.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "draco_codec.hpp"
#include "finite_float.hpp"

namespace skelgen::io::detail {
namespace {

enum class Mode { triangles = 4, strip = 5, fan = 6 };

constexpr const char* draco_extension = "KHR_draco_mesh_compression";

/// The attributes of a primitive by name, be they accessors or within a Draco mesh.
class Attributes {
public:
    /// `with_looks`: of a Draco mesh colours and normals are decoded, too; a shape does not depend on them.
    Attributes(GltfData& data, const GltfValue& primitive, bool with_looks = false)
        : data_(&data), attributes_(primitive.at("attributes")), draco_(find_draco(primitive)),
          with_looks_(with_looks) {
        if (draco_) decode();
    }

    [[nodiscard]] std::optional<GltfArray> find(const std::string& name, std::size_t columns) {
        const auto index = attributes_.find(name.c_str());
        if (!index) return std::nullopt;
        for (std::size_t i = 0; i < names_.size(); ++i)
            if (names_[i] == name) return GltfArray{mesh_.points, columns, mesh_.attributes[i]};
        return data_->accessor(*index, columns);
    }

    /// As `find`, with three or four columns.
    [[nodiscard]] std::optional<GltfArray> find_colours() {
        return attributes_.find(colours) ? find(colours, columns_of(colours)) : std::nullopt;
    }

    /// The triangles of a Draco mesh; none without one.
    [[nodiscard]] const std::vector<std::array<std::size_t, 3>>* triangles() const {
        return draco_ ? &mesh_.triangles : nullptr;
    }

private:
    static std::optional<GltfValue> find_draco(const GltfValue& primitive) {
        const auto extensions = primitive.find("extensions");
        return extensions ? extensions->find(draco_extension) : std::nullopt;
    }

    static constexpr const char *colours = "COLOR_0", *normals = "NORMAL";

    [[nodiscard]] std::size_t columns_of(const std::string& name) const {
        if (name == colours)
            return data_->file().referred("accessors", attributes_.at(colours)).at("type").text() == "VEC3" ? 3 : 4;
        return name == "POSITION" || name == normals ? 3 : name.starts_with("TEXCOORD_") ? 2 : 4;
    }

    [[nodiscard]] bool is_read(const std::string& name) const {
        for (const char* start : {"POSITION", "JOINTS_", "WEIGHTS_", "TEXCOORD_"})
            if (name.starts_with(start)) return true;
        return with_looks_ && (name == colours || name == normals);
    }

    void decode() {
        const GltfValue ids = draco_->at("attributes");
        std::vector<DracoAttribute> wanted;
        for (const auto& [name, unused] : ids.members()) {
            if (!is_read(name)) continue;
            names_.push_back(name);
            wanted.push_back({ids.at(name.c_str()).whole_number(), columns_of(name)});
        }
        mesh_ = decode_draco(data_->view(draco_->at("bufferView")), wanted);
        data_->count_numbers(mesh_.points * 3 + mesh_.triangles.size() * 3, *draco_);
    }

    GltfData* data_;
    GltfValue attributes_;
    std::optional<GltfValue> draco_;
    bool with_looks_;
    DracoMesh mesh_;
    std::vector<std::string> names_; ///< of the mesh's attributes
};

Mode mode_of(const GltfValue& primitive) {
    const std::size_t mode = primitive.whole_number("mode", static_cast<std::size_t>(Mode::triangles));
    constexpr std::size_t most = 6;
    if (mode > most) primitive.fail("has the mode " + std::to_string(mode) + ", which glTF does not have");
    return static_cast<Mode>(mode);
}

std::vector<Eigen::Vector3d> read_positions(Attributes& attributes, const GltfValue& primitive) {
    const auto array = attributes.find("POSITION", 3);
    if (!array) primitive.fail("has no POSITION");
    std::vector<Eigen::Vector3d> positions(array->rows);
    for (std::size_t i = 0; i < array->rows; ++i) positions[i] = Eigen::Map<const Eigen::Vector3d>(array->row(i));
    return positions;
}

/// The rows of a vertex attribute (POSITION or NORMAL), moved as far as the targets that have weight move them.
std::vector<Eigen::Vector3d> morphed(std::vector<Eigen::Vector3d> positions, const char* attribute, GltfData& data,
                                     const GltfValue& primitive, const std::vector<double>& weights) {
    const auto targets = primitive.find("targets");
    for (std::size_t i = 0; targets && i < weights.size() && i < targets->size(); ++i) {
        if (weights[i] == 0) continue; // most have no weight, and reading them all would take long
        const auto moved = (*targets)[i].find(attribute);
        if (!moved) continue;
        const GltfArray offsets = data.accessor(*moved, 3);
        if (offsets.rows != positions.size()) moved->fail("has another number of vertices than the mesh");
        for (std::size_t k = 0; k < positions.size(); ++k)
            positions[k] += weights[i] * Eigen::Map<const Eigen::Vector3d>(offsets.row(k));
    }
    return positions;
}

std::size_t to_joint(double value, const GltfValue& primitive) {
    constexpr double most = 65535; // a joint is a short or a byte
    if (!(value >= 0 && value <= most)) primitive.fail("has joints that are no whole numbers from 0 to 65535");
    return static_cast<std::size_t>(value);
}

/// The vertices with one more set of four joints each, and their weights.
GltfVertices with_influences(GltfVertices vertices, const GltfArray& joints, const GltfArray& weights,
                             const GltfValue& primitive) {
    std::vector<Influence> all;
    all.reserve(vertices.joints.size() + joints.values.size());
    for (std::size_t vertex = 0; vertex < vertices.positions.size(); ++vertex) {
        const auto before = vertices.influences_of(vertex);
        all.insert(all.end(), before.begin(), before.end());
        for (std::size_t k = 0; k < joints.columns; ++k)
            all.push_back({to_joint(joints.row(vertex)[k], primitive), weights.row(vertex)[k]});
    }
    vertices.joints = std::move(all);
    vertices.influences += joints.columns;
    return vertices;
}

GltfVertices read_vertices(GltfData& data, Attributes& attributes, const GltfValue& primitive,
                           const std::vector<double>& morph_weights) {
    GltfVertices vertices;
    vertices.positions = morphed(read_positions(attributes, primitive), "POSITION", data, primitive, morph_weights);
    for (std::size_t set = 0;; ++set) {
        const auto joints = attributes.find("JOINTS_" + std::to_string(set), 4);
        const auto weights = attributes.find("WEIGHTS_" + std::to_string(set), 4);
        if (!joints || !weights) return vertices;
        if (joints->rows != vertices.positions.size() || weights->rows != vertices.positions.size())
            primitive.fail("has other numbers of joints or weights than of vertices");
        vertices = with_influences(std::move(vertices), *joints, *weights, primitive);
    }
}

std::vector<std::size_t> read_indices(GltfData& data, const GltfValue& primitive, std::size_t vertices) {
    std::vector<std::size_t> indices;
    const auto accessor = primitive.find("indices");
    if (!accessor) {
        indices.resize(vertices);
        for (std::size_t i = 0; i < vertices; ++i) indices[i] = i;
        return indices;
    }
    for (const double index : data.accessor(*accessor, 1).values) {
        if (!(index >= 0 && index < static_cast<double>(vertices)))
            accessor->fail("names a vertex that does not exist: there are " + std::to_string(vertices));
        indices.push_back(static_cast<std::size_t>(index));
    }
    return indices;
}

std::vector<std::array<std::size_t, 3>> make_triangles(const std::vector<std::size_t>& corners, Mode mode) {
    std::vector<std::array<std::size_t, 3>> triangles;
    const std::size_t step = mode == Mode::triangles ? 3 : 1;
    for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
        if (mode == Mode::fan)
            triangles.push_back({corners[i + 1], corners[i + 2], corners[0]});
        else if (mode == Mode::strip && i % 2 == 1) // every other one runs the other way round
            triangles.push_back({corners[i], corners[i + 2], corners[i + 1]});
        else
            triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    return triangles;
}

} // namespace

bool has_triangles(const GltfValue& primitive) { return mode_of(primitive) >= Mode::triangles; }

std::string vertex_key(const GltfValue& primitive) {
    std::string key;
    const GltfValue attributes = primitive.at("attributes");
    for (const auto& [name, index] : attributes.members())
        if (name == "POSITION" || name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_"))
            key += name + index.dump() + ' ';
    for (const char* rest : {"targets", "extensions"}) {
        const auto member = primitive.members().find(rest);
        if (member != primitive.members().end()) key += member->second.dump();
    }
    return key;
}

std::vector<TextureCoordinates> read_texture_coordinates(GltfData& data, const GltfValue& primitive) {
    Attributes attributes(data, primitive);
    std::vector<TextureCoordinates> sets;
    while (const auto array = attributes.find("TEXCOORD_" + std::to_string(sets.size()), 2)) {
        TextureCoordinates set(static_cast<Eigen::Index>(array->rows), 2);
        for (Eigen::Index i = 0; i < set.size(); ++i)
            set.data()[i] = finite_float(array->values[static_cast<std::size_t>(i)]);
        sets.push_back(std::move(set));
    }
    return sets;
}

std::vector<Eigen::Vector3d> read_normals(GltfData& data, const GltfValue& primitive,
                                          const std::vector<double>& morph_weights) {
    const auto array = Attributes(data, primitive, true).find("NORMAL", 3);
    if (!array) return {};
    std::vector<Eigen::Vector3d> normals(array->rows);
    for (std::size_t i = 0; i < array->rows; ++i) normals[i] = Eigen::Map<const Eigen::Vector3d>(array->row(i));
    return morphed(std::move(normals), "NORMAL", data, primitive, morph_weights);
}

VertexColours read_colours(GltfData& data, const GltfValue& primitive) {
    const auto array = Attributes(data, primitive, true).find_colours();
    if (!array) return {};
    VertexColours colours = VertexColours::Ones(static_cast<Eigen::Index>(array->rows), 4);
    for (Eigen::Index i = 0; i < colours.rows(); ++i)
        for (std::size_t channel = 0; channel < array->columns; ++channel)
            colours(i, static_cast<Eigen::Index>(channel)) =
                std::clamp(finite_float(array->row(static_cast<std::size_t>(i))[channel]), 0.0F, 1.0F);
    return colours;
}

GltfPrimitive read_primitive(GltfData& data, const GltfValue& primitive, const std::vector<double>& morph_weights) {
    Attributes attributes(data, primitive);
    GltfPrimitive result;
    result.vertices = read_vertices(data, attributes, primitive, morph_weights);
    if (const auto* const decoded = attributes.triangles())
        result.triangles = *decoded;
    else
        result.triangles =
            make_triangles(read_indices(data, primitive, result.vertices.positions.size()), mode_of(primitive));
    return result;
}

} // namespace skelgen::io::detail
