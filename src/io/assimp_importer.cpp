#include "assimp_importer.hpp"

#include <algorithm>

#include <skelgen/core/error.hpp>

#include <skelgen/io/bvh.hpp>

#include "polygon_bytes.hpp"
#include "separate_process.hpp"

#if SKELGEN_WITH_ASSIMP
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <assimp/scene.h>

#include "animation_choice.hpp"
#include "scene_library.hpp"
#include "scene_pose.hpp"
#include "vertex_merger.hpp"
#endif

namespace skelgen::io::detail {

bool is_fbx(std::string_view bytes) { return bytes.starts_with("Kaydara FBX Binary") || bytes.starts_with("; FBX "); }

bool is_collada(std::string_view bytes) {
    constexpr std::size_t far_enough = 1024;
    const std::size_t start = bytes.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos || bytes[start] != '<') return false;
    return bytes.substr(start, far_enough).find("<COLLADA") != std::string_view::npos;
}

#if SKELGEN_WITH_ASSIMP

namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::bad_input, message); }

Eigen::Vector3d to_eigen(const aiVector3D& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

Eigen::Matrix4d to_eigen(const aiMatrix4x4& matrix) {
    Eigen::Matrix4d result;
    for (unsigned row = 0; row < 4; ++row)
        for (unsigned column = 0; column < 4; ++column) result(row, column) = static_cast<double>(matrix[row][column]);
    return result;
}

/// The tree of nodes as a list, parents first.
struct NodeList {
    std::vector<const aiNode*> sources;
    std::vector<SceneNode> nodes;
    std::map<std::string, std::size_t> by_name; ///< the first of each name
};

NodeList list_nodes(const aiNode& root) {
    NodeList list;
    std::vector<std::pair<const aiNode*, int>> stack{{&root, -1}};
    while (!stack.empty()) {
        const auto [source, parent] = stack.back();
        stack.pop_back();
        SceneNode node;
        node.parent = parent;
        node.matrix = to_eigen(source->mTransformation);
        const auto index = static_cast<int>(list.nodes.size());
        list.by_name.emplace(source->mName.C_Str(), list.nodes.size());
        list.sources.push_back(source);
        list.nodes.push_back(std::move(node));
        for (unsigned i = source->mNumChildren; i > 0; --i) stack.emplace_back(source->mChildren[i - 1], index);
    }
    return list;
}

/// The values that a key has, in the order of `AnimationChannel`.
std::vector<double> key_values(const aiVectorKey& key) {
    const Eigen::Vector3d v = to_eigen(key.mValue);
    return {v.begin(), v.end()};
}
std::vector<double> key_values(const aiQuatKey& key) {
    const auto& q = key.mValue;
    return {static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z), static_cast<double>(q.w)};
}

/// A channel of some of an animation's keys; of those at the same time the first counts.
template <typename Key>
AnimationChannel read_channel(std::size_t node, AnimatedProperty property, const Key* keys, unsigned count,
                              double ticks_per_second) {
    AnimationChannel channel;
    channel.node = node;
    channel.property = property;
    for (unsigned i = 0; i < count; ++i) {
        const double time = keys[i].mTime / ticks_per_second;
        if (!channel.times.empty() && time <= channel.times.back()) continue;
        channel.times.push_back(time);
        const std::vector<double> values = key_values(keys[i]);
        channel.values.insert(channel.values.end(), values.begin(), values.end());
    }
    return channel;
}

/// What an animation moves, which is named as `ReadMeshOptions::animation`.
std::vector<AnimationChannel> read_channels(const NodeList& list, const aiScene& scene, const std::string& name) {
    std::vector<std::string> names;
    for (unsigned i = 0; i < scene.mNumAnimations; ++i) names.emplace_back(scene.mAnimations[i]->mName.C_Str());
    const aiAnimation& animation = *scene.mAnimations[choose_animation(names, name)];
    constexpr double usual_ticks = 25; // where the file does not say, as assimp's documentation has it
    const double ticks = animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : usual_ticks;
    std::vector<AnimationChannel> channels;
    for (unsigned i = 0; i < animation.mNumChannels; ++i) {
        const aiNodeAnim& source = *animation.mChannels[i];
        const auto node = list.by_name.find(source.mNodeName.C_Str());
        if (node == list.by_name.end()) continue;
        const std::size_t n = node->second;
        if (source.mNumPositionKeys > 0)
            channels.push_back(
                read_channel(n, AnimatedProperty::translation, source.mPositionKeys, source.mNumPositionKeys, ticks));
        if (source.mNumRotationKeys > 0)
            channels.push_back(
                read_channel(n, AnimatedProperty::rotation, source.mRotationKeys, source.mNumRotationKeys, ticks));
        if (source.mNumScalingKeys > 0)
            channels.push_back(
                read_channel(n, AnimatedProperty::scale, source.mScalingKeys, source.mNumScalingKeys, ticks));
    }
    return channels;
}

std::vector<SceneNode> animated(NodeList list, const aiScene& scene, const ReadMeshOptions& options) {
    for (const AnimationChannel& channel : read_channels(list, scene, options.animation))
        list.nodes = animate(std::move(list.nodes), channel, options.time);
    return list.nodes;
}

/// Puts the scene's meshes together.
class SceneReader {
public:
    SceneReader(const aiScene& scene, const ReadMeshOptions& options)
        : scene_(&scene), list_(list_nodes(*scene.mRootNode)) {
        matrices_ = world_matrices(options.animation.empty() ? list_.nodes : animated(list_, scene, options));
    }

    PolygonMesh read() {
        for (std::size_t i = 0; i < list_.sources.size(); ++i)
            for (unsigned k = 0; k < list_.sources[i]->mNumMeshes; ++k)
                add_mesh(*scene_->mMeshes[list_.sources[i]->mMeshes[k]], matrices_[i]);
        if (mesh_.sizes.empty() && mesh_.placeless > 0) refuse("has no vertex at a finite place; export it again");
        if (mesh_.sizes.empty()) refuse("shows no mesh; export the scene again, with the body's mesh");
        return std::move(mesh_);
    }

private:
    void add_mesh(const aiMesh& mesh, const Eigen::Matrix4d& node_matrix) {
        const auto influences = read_influences(mesh);
        std::vector<std::array<double, 3>> positions;
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            const Eigen::Vector3d stored = to_eigen(mesh.mVertices[i]);
            const Eigen::Vector3d posed = influences[i].empty() ? transformed(stored, node_matrix)
                                                                : skinned(stored, influences[i], joint_matrices_);
            positions.push_back({posed[0], posed[1], posed[2]});
            if (!posed.allFinite()) ++mesh_.placeless;
        }
        const bool mirrored = mesh.mNumBones == 0 && node_matrix.topLeftCorner<3, 3>().determinant() < 0;
        for (unsigned i = 0; i < mesh.mNumFaces; ++i) add_face(mesh.mFaces[i], positions, mirrored);
    }

    /// Per vertex the joints that move it; sets what each of the mesh's joints does.
    std::vector<std::vector<Influence>> read_influences(const aiMesh& mesh) {
        std::vector<std::vector<Influence>> influences(mesh.mNumVertices);
        joint_matrices_.clear();
        for (unsigned i = 0; i < mesh.mNumBones; ++i) {
            const aiBone& bone = *mesh.mBones[i];
            const auto node = list_.by_name.find(bone.mName.C_Str());
            if (node == list_.by_name.end()) refuse("has a skin with a joint that is no node of the scene");
            joint_matrices_.emplace_back(matrices_[node->second] * to_eigen(bone.mOffsetMatrix));
            for (unsigned k = 0; k < bone.mNumWeights; ++k) {
                const aiVertexWeight& weight = bone.mWeights[k];
                if (weight.mVertexId < mesh.mNumVertices && weight.mWeight != 0)
                    influences[weight.mVertexId].push_back({i, static_cast<double>(weight.mWeight)});
            }
        }
        return influences;
    }

    void add_face(const aiFace& face, const std::vector<std::array<double, 3>>& positions, bool mirrored) {
        if (face.mNumIndices < 3) return; // points and lines
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            const unsigned corner = face.mIndices[k];
            if (corner >= positions.size()) refuse("has a face that names a vertex that does not exist");
            const auto& position = positions[corner];
            if (!std::all_of(position.begin(), position.end(), [](double x) { return std::isfinite(x); })) return;
        }
        for (unsigned k = 0; k < face.mNumIndices; ++k)
            merger_.add_corner(positions[face.mIndices[mirrored ? face.mNumIndices - 1 - k : k]]);
        mesh_.sizes.push_back(static_cast<int>(face.mNumIndices));
    }

    const aiScene* scene_;
    NodeList list_;
    std::vector<Eigen::Matrix4d> matrices_;       ///< of the nodes, in the scene
    std::vector<Eigen::Matrix4d> joint_matrices_; ///< of the mesh being added
    PolygonMesh mesh_;
    VertexMerger merger_{mesh_}; // assimp has one vertex for each corner of a face
};

applications::MotionClip import_clip_here(std::string_view bytes, MeshFormat format, const ClipOfScene& wanted) {
    applications::MotionClip clip;
    with_imported_scene(
        bytes, format == MeshFormat::dae ? "dae" : "fbx",
        [&](const aiScene& scene) {
            NodeList list = list_nodes(*scene.mRootNode);
            SceneMotion motion;
            if (!wanted.animation.empty()) motion.channels = read_channels(list, scene, wanted.animation);
            motion.is_bone.resize(list.nodes.size(), false);
            for (const aiNode* node : list.sources) motion.names.emplace_back(node->mName.C_Str());
            for (const AnimationChannel& channel : motion.channels) motion.is_bone[channel.node] = true;
            for (unsigned m = 0; m < scene.mNumMeshes; ++m)
                for (unsigned b = 0; b < scene.mMeshes[m]->mNumBones; ++b)
                    if (const auto bone = list.by_name.find(scene.mMeshes[m]->mBones[b]->mName.C_Str());
                        bone != list.by_name.end())
                        motion.is_bone[bone->second] = true;
            motion.nodes = std::move(list.nodes);
            clip = clip_of(std::move(motion), wanted.time);
        },
        Pivots::one_node);
    return clip;
}

PolygonMesh import_here(std::string_view bytes, MeshFormat format, const ReadMeshOptions& options) {
    PolygonMesh mesh;
    with_imported_scene(bytes, format == MeshFormat::dae ? "dae" : "fbx",
                        [&](const aiScene& scene) { mesh = SceneReader(scene, options).read(); });
    return mesh;
}

} // namespace

PolygonMesh import_scene(std::string_view bytes, MeshFormat format, const ReadMeshOptions& options) {
    if (!options.isolated) return import_here(bytes, format, options);
    constexpr std::size_t least = std::size_t{1} << 30U, per_byte = 64;
    const ProcessLimits limits{60, std::max(least, per_byte * bytes.size())};
    return polygons_from_bytes(
        run_separately([&] { return to_bytes(import_here(bytes, format, options)); }, limits, "reading the scene"));
}

applications::MotionClip import_clip(std::string_view bytes, MeshFormat format, const ClipOfScene& wanted) {
    if (!wanted.isolated) return import_clip_here(bytes, format, wanted);
    const ProcessLimits limits{60, std::size_t{1} << 32U};
    return parse_bvh(run_separately([&] { return clip_to_bvh(import_clip_here(bytes, format, wanted)); }, limits,
                                    "reading the scene"));
}

#else

applications::MotionClip import_clip(std::string_view bytes, MeshFormat format, const ClipOfScene&) {
    static_cast<void>(import_scene(bytes, format, {})); // says what is missing
    return {};
}

PolygonMesh import_scene(std::string_view, MeshFormat, const ReadMeshOptions&) {
    throw Error(ErrorCode::bad_input,
                "is FBX or DAE, which this build of skelgen cannot read; build it with assimp (Debian: "
                "libassimp-dev), or export it as GLB");
}

#endif

} // namespace skelgen::io::detail
