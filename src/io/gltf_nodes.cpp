#include "gltf_nodes.hpp"

#include <algorithm>

namespace skelgen::io::detail {
namespace {

template <typename Vector>
Vector read_vector(const GltfValue& value) {
    Vector vector;
    if (value.size() != static_cast<std::size_t>(vector.size()))
        value.fail("has " + std::to_string(value.size()) + " numbers; it must have " + std::to_string(vector.size()));
    for (Eigen::Index i = 0; i < vector.size(); ++i) vector(i) = value[static_cast<std::size_t>(i)].number();
    return vector;
}

SceneNode read_node(const GltfValue& value) {
    SceneNode node;
    if (const auto translation = value.find("translation"))
        node.translation = read_vector<Eigen::Vector3d>(*translation);
    if (const auto scale = value.find("scale")) node.scale = read_vector<Eigen::Vector3d>(*scale);
    if (const auto rotation = value.find("rotation")) {
        const auto v = read_vector<Eigen::Vector4d>(*rotation);
        node.rotation = Eigen::Quaterniond(v[3], v[0], v[1], v[2]);
        if (!(node.rotation.norm() > 0)) rotation->fail("is no rotation");
        node.rotation.normalize();
    }
    if (const auto matrix = value.find("matrix")) {
        using Columns = Eigen::Matrix<double, 16, 1>;
        const auto columns = read_vector<Columns>(*matrix);
        node.matrix = Eigen::Map<const Eigen::Matrix4d>(columns.data());
    }
    node.weights = read_morph_weights(value);
    return node;
}

} // namespace

std::vector<double> read_morph_weights(const GltfValue& node_or_mesh) {
    const auto weights = node_or_mesh.find("weights");
    std::vector<double> values;
    for (std::size_t i = 0; weights && i < weights->size(); ++i) values.push_back((*weights)[i].number());
    return values;
}

GltfNodes read_nodes(const GltfFile& file) {
    GltfNodes result;
    const std::size_t count = file.count("nodes");
    result.children.resize(count);
    for (std::size_t i = 0; i < count; ++i) result.nodes.push_back(read_node(file.root().at("nodes")[i]));
    for (std::size_t i = 0; i < count; ++i) {
        const auto children = file.root().at("nodes")[i].find("children");
        for (std::size_t k = 0; children && k < children->size(); ++k) {
            const GltfValue index = (*children)[k];
            static_cast<void>(file.referred("nodes", index)); // there it is
            const std::size_t child = index.whole_number();
            if (result.nodes[child].parent >= 0) index.fail("is a node that has two parents");
            result.nodes[child].parent = static_cast<int>(i);
            result.children[i].push_back(child);
        }
    }
    return result;
}

std::vector<std::size_t> shown_nodes(const GltfFile& file, const GltfNodes& nodes) {
    std::vector<std::size_t> stack;
    if (file.count("scenes") > 0) {
        const auto scene_index = file.root().find("scene");
        const GltfValue scene = scene_index ? file.referred("scenes", *scene_index) : file.root().at("scenes")[0];
        const auto roots = scene.find("nodes");
        for (std::size_t i = 0; roots && i < roots->size(); ++i) {
            static_cast<void>(file.referred("nodes", (*roots)[i]));
            stack.push_back((*roots)[i].whole_number());
        }
    } else {
        for (std::size_t i = 0; i < nodes.nodes.size(); ++i)
            if (nodes.nodes[i].parent < 0) stack.push_back(i);
    }

    std::vector<std::size_t> shown;
    std::vector<bool> seen(nodes.nodes.size(), false);
    while (!stack.empty()) {
        const std::size_t node = stack.back();
        stack.pop_back();
        if (seen[node]) continue; // a root that is below another one
        seen[node] = true;
        shown.push_back(node);
        stack.insert(stack.end(), nodes.children[node].begin(), nodes.children[node].end());
    }
    std::sort(shown.begin(), shown.end());
    return shown;
}

} // namespace skelgen::io::detail
