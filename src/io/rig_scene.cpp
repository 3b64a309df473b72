#include "rig_scene.hpp"

#include <algorithm>
#include <utility>

#include <skelgen/version.hpp>

#include "glb_container.hpp"
#include "mesh_primitives.hpp"

namespace skelgen::io::detail {
namespace {

using applications::Rig;
using applications::RigJoint;

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

} // namespace

RigScene make_rig_scene(const Rig<double>& rig, const std::vector<std::string>& names, const SceneLooks& looks) {
    RigScene scene;
    std::vector<WrittenObject> objects =
        describe_objects(scene.buffer, {rig.mesh, &rig.skin, rig.turns, looks, rig.metres_per_unit});
    const std::size_t inverses = scene.buffer.add_floats(inverse_bind_matrices(rig), GltfTarget::none);

    Json nodes = Json::array(), meshes = Json::array(), roots = Json::array();
    for (WrittenObject& object : objects) {
        // Programs that tell nodes by their names must find the joints by theirs.
        if (std::find(names.begin(), names.end(), object.name) != names.end()) object.name += "_mesh";
        Json node = node_of(object);
        node["mesh"] = meshes.size();
        node["skin"] = 0;
        roots.push_back(nodes.size());
        scene.objects.push_back(object.object);
        nodes.push_back(std::move(node));
        meshes.push_back(std::move(object.mesh));
    }
    for (std::size_t j = 0; j < rig.joints.size(); ++j) {
        scene.joint_nodes.push_back(nodes.size());
        Json node{{"name", names[j]}, {"extras", {{"confidence", rig.joints[j].confidence}}}};
        node.update(describe_joint(rig, j));
        nodes.push_back(std::move(node));
        if (const int parent = rig.joints[j].parent; parent >= 0)
            nodes[scene.joint_nodes[static_cast<std::size_t>(parent)]]["children"].push_back(scene.joint_nodes[j]);
    }
    Json& json = scene.json;
    json["asset"] = {{"version", "2.0"}, {"generator", "skelgen " + std::string(version)}};
    json["scene"] = 0;
    roots.push_back(scene.joint_nodes.front());
    json["scenes"] = Json::array({{{"nodes", std::move(roots)}}});
    json["nodes"] = std::move(nodes);
    json["meshes"] = std::move(meshes);
    json["skins"] = Json::array(
        {{{"inverseBindMatrices", inverses}, {"skeleton", scene.joint_nodes.front()}, {"joints", scene.joint_nodes}}});
    add_about(json, looks);
    add_materials(json, scene.buffer, looks);
    return scene;
}

std::string format_scene(RigScene scene) {
    scene.buffer.describe_in(scene.json);
    return format_glb_container(scene.json.dump(), scene.buffer.bytes());
}

} // namespace skelgen::io::detail
