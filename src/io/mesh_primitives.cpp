#include "mesh_primitives.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shading_normals.hpp"
#include "tangents.hpp"
#include "unwritable_mesh.hpp"

namespace skelgen::io::detail {
namespace {

using applications::Skin;

/// Weights that sum to 1 as floats, too.
FloatRows float_weights(const Skin<double>& skin) {
    FloatRows weights = skin.weights.cast<float>();
    for (Eigen::Index v = 0; v < weights.rows(); ++v)
        weights(v, 0) += static_cast<float>(1 - weights.row(v).cast<double>().sum());
    return weights;
}

/// What every vertex of a mesh has, as floats; without a skin neither weights nor joints.
struct VertexRows {
    FloatRows positions, normals, weights;
    Eigen::Matrix<std::uint16_t, Eigen::Dynamic, 4, Eigen::RowMajor> joints;

    VertexRows(const TriangleMesh<double>& mesh, const Skin<double>* skin)
        : positions(mesh.vertices.cast<float>()), normals(shading_normals(mesh).cast<float>().rowwise().normalized()) {
        if (skin != nullptr) {
            weights = float_weights(*skin);
            joints = skin->joints.cast<std::uint16_t>();
        }
        if (!positions.allFinite()) refuse_to_write_mesh("a coordinate is too large for a float; scale the mesh down");
    }
};

Json describe_attributes(GltfBuffer& buffer, const VertexRows& rows, const ScenePart& part) {
    const auto of_part = [&](const FloatRows& all) { return all.middleRows(part.first_vertex, part.vertices); };
    Json attributes;
    attributes["POSITION"] = buffer.add_floats(of_part(rows.positions), GltfTarget::vertices, true);
    attributes["NORMAL"] = buffer.add_floats(of_part(rows.normals), GltfTarget::vertices);
    if (rows.joints.size() == 0) return attributes;
    attributes["JOINTS_0"] =
        buffer.add_joints({rows.joints.data() + 4 * part.first_vertex, static_cast<std::size_t>(4 * part.vertices)});
    attributes["WEIGHTS_0"] = buffer.add_floats(of_part(rows.weights), GltfTarget::vertices);
    return attributes;
}

/// The set of texture coordinates that a material's normal map goes by; none where it has no such map.
std::optional<std::size_t> normal_map_set(const Json& materials, const ScenePart& part) {
    if (!part.material || !materials[*part.material].contains("normalTexture")) return std::nullopt;
    const auto set = materials[*part.material]["normalTexture"].value("texCoord", std::size_t{0});
    if (set >= part.texture_coordinates.size()) return std::nullopt;
    return set;
}

/// The parts, which must be of this mesh: all of its faces, one after the other.
std::vector<ScenePart> checked(std::vector<ScenePart> parts, const TriangleMesh<double>& mesh) {
    if (parts.empty()) return {{0, mesh.vertices.rows(), 0, mesh.faces.rows(), std::nullopt, {}, {}}};
    Eigen::Index faces = 0;
    for (const ScenePart& part : parts) {
        const auto corners = mesh.faces.middleRows(std::min(part.first_face, mesh.faces.rows()),
                                                   std::min(part.faces, mesh.faces.rows() - faces));
        const bool own = part.faces == 0 || (corners.minCoeff() >= part.first_vertex &&
                                             corners.maxCoeff() < part.first_vertex + part.vertices);
        if (part.first_face != faces || corners.rows() != part.faces || !own ||
            part.first_vertex + part.vertices > mesh.vertices.rows())
            refuse_to_write_mesh("its looks are those of another mesh");
        faces += part.faces;
    }
    if (faces != mesh.faces.rows()) refuse_to_write_mesh("its looks are those of another mesh");
    return parts;
}

} // namespace

Json describe_primitives(GltfBuffer& buffer, const TriangleMesh<double>& mesh, const Skin<double>* skin,
                         const SceneLooks& looks) {
    if (mesh.faces.rows() == 0) refuse_to_write_mesh("it has no faces");
    const std::vector<ScenePart> parts = checked(looks.parts, mesh);
    const Json materials = parse_json(looks.json).value("materials", Json::array());
    const VertexRows rows(mesh, skin);
    std::map<Eigen::Index, Json> attributes_from; // by the first vertex
    Json primitives = Json::array();
    for (const ScenePart& part : parts) {
        if (part.faces == 0) continue;
        auto known = attributes_from.find(part.first_vertex);
        if (known == attributes_from.end())
            known = attributes_from.emplace(part.first_vertex, describe_attributes(buffer, rows, part)).first;
        Json attributes = known->second;
        for (std::size_t set = 0; set < part.texture_coordinates.size(); ++set)
            attributes["TEXCOORD_" + std::to_string(set)] =
                buffer.add_floats(part.texture_coordinates[set], GltfTarget::vertices);
        if (part.colours.rows() > 0) attributes["COLOR_0"] = buffer.add_floats(part.colours, GltfTarget::vertices);
        std::vector<std::uint32_t> corners;
        for (const int corner : mesh.faces.middleRows(part.first_face, part.faces).reshaped<Eigen::RowMajor>())
            corners.push_back(static_cast<std::uint32_t>(corner - part.first_vertex));
        if (const auto set = normal_map_set(materials, part)) // of the rest pose: those of the input have been turned
            attributes["TANGENT"] =
                buffer.add_floats(tangents(rows.positions.middleRows(part.first_vertex, part.vertices),
                                           rows.normals.middleRows(part.first_vertex, part.vertices), corners,
                                           part.texture_coordinates[*set]),
                                  GltfTarget::vertices);
        Json primitive{{"attributes", std::move(attributes)}, {"indices", buffer.add_indices(corners)}};
        if (part.material) primitive["material"] = *part.material;
        primitives.push_back(std::move(primitive));
    }
    return primitives;
}

void add_materials(Json& scene, GltfBuffer& buffer, const SceneLooks& looks) {
    const Json json = parse_json(looks.json);
    for (const auto& [key, value] : json.items()) scene[key] = value;
    for (std::size_t i = 0; i < looks.pictures.size(); ++i)
        scene["images"][i]["bufferView"] = buffer.add_bytes(looks.pictures[i]);
}

} // namespace skelgen::io::detail
