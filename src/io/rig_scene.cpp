#include "rig_scene.hpp"

#include <cstdint>
#include <utility>

#include <skelgen/core/error.hpp>
#include <skelgen/version.hpp>

#include "glb_container.hpp"
#include "shading_normals.hpp"

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

Json describe_attributes(GltfBuffer& buffer, const Rig<double>& rig) {
    const FloatRows positions = rig.mesh.vertices.cast<float>();
    if (!positions.allFinite()) refuse("a coordinate is too large for a float; scale the mesh down");
    const FloatRows normals = shading_normals(rig.mesh).cast<float>().rowwise().normalized();
    const std::vector<std::uint16_t> joints(rig.skin.joints.data(), rig.skin.joints.data() + rig.skin.joints.size());
    Json attributes;
    attributes["POSITION"] = buffer.add_floats(positions, GltfTarget::vertices, true);
    attributes["NORMAL"] = buffer.add_floats(normals, GltfTarget::vertices);
    attributes["JOINTS_0"] = buffer.add_joints(joints);
    attributes["WEIGHTS_0"] = buffer.add_floats(float_weights(rig.skin), GltfTarget::vertices);
    return attributes;
}

} // namespace

RigScene make_rig_scene(const Rig<double>& rig, const std::vector<std::string>& names) {
    if (rig.mesh.faces.rows() == 0) refuse("it has no faces");
    RigScene scene;
    Json attributes = describe_attributes(scene.buffer, rig);
    const std::vector<std::uint32_t> corners(rig.mesh.faces.data(), rig.mesh.faces.data() + rig.mesh.faces.size());
    const std::size_t indices = scene.buffer.add_indices(corners);
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
    json["meshes"] =
        Json::array({{{"name", "body"},
                      {"primitives", Json::array({{{"attributes", std::move(attributes)}, {"indices", indices}}})}}});
    json["skins"] = Json::array(
        {{{"inverseBindMatrices", inverses}, {"skeleton", scene.joint_nodes.front()}, {"joints", scene.joint_nodes}}});
    return scene;
}

std::string format_scene(RigScene scene) {
    scene.buffer.describe_in(scene.json);
    return format_glb_container(scene.json.dump(), scene.buffer.bytes());
}

} // namespace skelgen::io::detail
