#include "rig_scene.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include <skelgen/core/error.hpp>
#include <skelgen/version.hpp>

#include "glb_container.hpp"
#include "shading_normals.hpp"
#include "tangents.hpp"

namespace skelgen::io::detail {
namespace {

using applications::Rig;
using applications::RigJoint;

[[noreturn]] void refuse(const std::string& message) {
    throw Error(ErrorCode::usage, "the rig cannot be written: " + message);
}

Json to_json(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }
Json to_json(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }

/// A joint's place and axes in those of its parent.
Json describe_joint(const Rig<double>& rig, std::size_t j) {
    const RigJoint<double>& joint = rig.joints[j];
    if (joint.parent < 0) return {{"translation", to_json(joint.position)}, {"rotation", to_json(joint.axes)}};
    const RigJoint<double>& parent = rig.joints[static_cast<std::size_t>(joint.parent)];
    const Eigen::Quaterniond back = parent.axes.conjugate();
    return {{"translation", to_json(back * (joint.position - parent.position))},
            {"rotation", to_json((back * joint.axes).normalized())}};
}

/// One row per joint: the columns of the matrix that takes the rest pose into its axes.
FloatRows inverse_bind_matrices(const Rig<double>& rig) {
    FloatRows rows(static_cast<Eigen::Index>(rig.joints.size()), 16);
    for (Eigen::Index j = 0; j < rows.rows(); ++j) {
        const RigJoint<double>& joint = rig.joints[static_cast<std::size_t>(j)];
        Eigen::Matrix4d inverse = Eigen::Matrix4d::Identity();
        inverse.topLeftCorner<3, 3>() = joint.axes.conjugate().toRotationMatrix();
        inverse.topRightCorner<3, 1>() = -(joint.axes.conjugate() * joint.position);
        rows.row(j) = inverse.reshaped().transpose().cast<float>();
    }
    return rows;
}

/// Weights that sum to 1 as floats, too.
FloatRows float_weights(const applications::Skin<double>& skin) {
    FloatRows weights = skin.weights.cast<float>();
    for (Eigen::Index v = 0; v < weights.rows(); ++v)
        weights(v, 0) += static_cast<float>(1 - weights.row(v).cast<double>().sum());
    return weights;
}

/// What every vertex of a rig has, as floats.
struct VertexRows {
    FloatRows positions, normals, weights;
    Eigen::Matrix<std::uint16_t, Eigen::Dynamic, 4, Eigen::RowMajor> joints;

    explicit VertexRows(const Rig<double>& rig)
        : positions(rig.mesh.vertices.cast<float>()),
          normals(shading_normals(rig.mesh).cast<float>().rowwise().normalized()), weights(float_weights(rig.skin)),
          joints(rig.skin.joints.cast<std::uint16_t>()) {
        if (!positions.allFinite()) refuse("a coordinate is too large for a float; scale the mesh down");
    }
};

Json describe_attributes(GltfBuffer& buffer, const VertexRows& rows, const ScenePart& part) {
    const auto of_part = [&](const FloatRows& all) { return all.middleRows(part.first_vertex, part.vertices); };
    Json attributes;
    attributes["POSITION"] = buffer.add_floats(of_part(rows.positions), GltfTarget::vertices, true);
    attributes["NORMAL"] = buffer.add_floats(of_part(rows.normals), GltfTarget::vertices);
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

/// One primitive for each part that has faces; those of the same vertices share them.
Json describe_primitives(GltfBuffer& buffer, const Rig<double>& rig, const std::vector<ScenePart>& parts,
                         const Json& materials) {
    const VertexRows rows(rig);
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
        std::vector<std::uint32_t> corners;
        for (const int corner : rig.mesh.faces.middleRows(part.first_face, part.faces).reshaped<Eigen::RowMajor>())
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

/// The parts, which must be of this mesh: all of its faces, one after the other.
std::vector<ScenePart> checked(std::vector<ScenePart> parts, const TriangleMesh<double>& mesh) {
    if (parts.empty()) return {{0, mesh.vertices.rows(), 0, mesh.faces.rows(), std::nullopt, {}}};
    Eigen::Index faces = 0;
    for (const ScenePart& part : parts) {
        const auto corners = mesh.faces.middleRows(std::min(part.first_face, mesh.faces.rows()),
                                                   std::min(part.faces, mesh.faces.rows() - faces));
        const bool own = part.faces == 0 || (corners.minCoeff() >= part.first_vertex &&
                                             corners.maxCoeff() < part.first_vertex + part.vertices);
        if (part.first_face != faces || corners.rows() != part.faces || !own ||
            part.first_vertex + part.vertices > mesh.vertices.rows())
            refuse("its looks are those of another mesh");
        faces += part.faces;
    }
    if (faces != mesh.faces.rows()) refuse("its looks are those of another mesh");
    return parts;
}

/// Materials and what they need, with the pictures in the buffer.
void add_materials(RigScene& scene, const Json& json, const SceneLooks& looks) {
    for (const auto& [key, value] : json.items()) scene.json[key] = value;
    for (std::size_t i = 0; i < looks.pictures.size(); ++i)
        scene.json["images"][i]["bufferView"] = scene.buffer.add_bytes(looks.pictures[i]);
}

} // namespace

RigScene make_rig_scene(const Rig<double>& rig, const std::vector<std::string>& names, const SceneLooks& looks) {
    if (rig.mesh.faces.rows() == 0) refuse("it has no faces");
    RigScene scene;
    const Json looks_json = parse_json(looks.json);
    Json primitives = describe_primitives(scene.buffer, rig, checked(looks.parts, rig.mesh),
                                          looks_json.value("materials", Json::array()));
    const std::size_t inverses = scene.buffer.add_floats(inverse_bind_matrices(rig), GltfTarget::none);

    Json nodes = Json::array({{{"name", "body"}, {"mesh", 0}, {"skin", 0}}});
    for (std::size_t j = 0; j < rig.joints.size(); ++j) {
        scene.joint_nodes.push_back(nodes.size());
        Json node{{"name", names[j]}};
        node.update(describe_joint(rig, j));
        nodes.push_back(std::move(node));
        if (const int parent = rig.joints[j].parent; parent >= 0)
            nodes[scene.joint_nodes[static_cast<std::size_t>(parent)]]["children"].push_back(scene.joint_nodes[j]);
    }
    Json& json = scene.json;
    json["asset"] = {{"version", "2.0"}, {"generator", "skelgen " + std::string(version)}};
    json["scene"] = 0;
    json["scenes"] = Json::array({{{"nodes", {0, scene.joint_nodes.front()}}}});
    json["nodes"] = std::move(nodes);
    json["meshes"] = Json::array({{{"name", "body"}, {"primitives", std::move(primitives)}}});
    json["skins"] = Json::array(
        {{{"inverseBindMatrices", inverses}, {"skeleton", scene.joint_nodes.front()}, {"joints", scene.joint_nodes}}});
    add_materials(scene, looks_json, looks);
    return scene;
}

std::string format_scene(RigScene scene) {
    scene.buffer.describe_in(scene.json);
    return format_glb_container(scene.json.dump(), scene.buffer.bytes());
}

} // namespace skelgen::io::detail
