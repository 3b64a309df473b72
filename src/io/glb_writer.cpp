#include "glb_writer.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/version.hpp>

#include "glb_container.hpp"
#include "gltf_buffer.hpp"
#include "mesh_primitives.hpp"
#include "unwritable_mesh.hpp"

namespace skelgen::io::detail {
namespace {

/// Meshes as they lie, each with a node of these; nodes name no mesh yet.
Json scene_of(Json nodes, Json meshes) {
    Json json;
    json["asset"] = {{"version", "2.0"}, {"generator", "skelgen " + std::string(version)}};
    json["scene"] = 0;
    Json all = Json::array();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        nodes[i]["mesh"] = i;
        all.push_back(i);
    }
    json["scenes"] = Json::array({{{"nodes", std::move(all)}}});
    json["nodes"] = std::move(nodes);
    json["meshes"] = std::move(meshes);
    return json;
}

} // namespace

std::string format_glb(const Points<double>& vertices, const Triangles& faces) {
    if (vertices.rows() == 0 || faces.rows() == 0) refuse_to_write_mesh("GLB has no way to write a mesh without faces");
    const FloatRows positions = vertices.cast<float>();
    if (!positions.allFinite()) refuse_to_write_mesh("a coordinate is too large for GLB; write OFF, OBJ or PLY");

    GltfBuffer buffer;
    const std::size_t position = buffer.add_floats(positions, GltfTarget::vertices, true);
    const std::vector<std::uint32_t> corners(faces.data(), faces.data() + faces.size());
    const std::size_t indices = buffer.add_indices(corners);

    Json primitives = Json::array({{{"attributes", {{"POSITION", position}}}, {"indices", indices}}});
    Json json = scene_of(Json::array({Json::object()}), Json::array({{{"primitives", std::move(primitives)}}}));
    buffer.describe_in(json);
    return format_glb_container(json.dump(), buffer.bytes());
}

std::string format_glb(const TriangleMesh<double>& mesh, const SceneLooks& looks,
                       const applications::VertexTurns<double>& turns) {
    GltfBuffer buffer;
    Json nodes = Json::array(), meshes = Json::array();
    for (WrittenObject& object : describe_objects(buffer, {mesh, nullptr, turns, looks})) {
        nodes.push_back(node_of(object));
        meshes.push_back(std::move(object.mesh));
    }
    Json json = scene_of(std::move(nodes), std::move(meshes));
    add_about(json, looks);
    add_materials(json, buffer, looks);
    buffer.describe_in(json);
    return format_glb_container(json.dump(), buffer.bytes());
}

} // namespace skelgen::io::detail
