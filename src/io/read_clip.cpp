#include <skelgen/io/read_clip.hpp>

#include <string>

#include <skelgen/core/error.hpp>
#include <skelgen/io/bvh.hpp>
#include <skelgen/io/read_file.hpp>

#include "assimp_importer.hpp"
#include "companion_file.hpp"
#include "gltf_animation.hpp"
#include "gltf_nodes.hpp"
#include "json_values.hpp"
#include "plain_content.hpp"
#include "scene_clip.hpp"

namespace skelgen::io {
namespace {

using applications::MotionClip;
using detail::GltfValue;

/// Names bones as VRM does where the file tells which nodes they are. \returns whether it does.
bool name_human_bones(detail::SceneMotion& motion, const detail::GltfFile& file) {
    const auto extensions = file.root().find("extensions");
    for (const char* extension : {"VRMC_vrm_animation", "VRMC_vrm"}) {
        const auto humanoid = extensions ? extensions->find(extension) : std::nullopt;
        if (!humanoid) continue;
        const GltfValue bones = humanoid->at("humanoid").at("humanBones");
        for (const auto& [name, bone] : bones.members()) {
            const std::size_t node = bones.at(name.c_str()).at("node").whole_number();
            if (node >= motion.nodes.size()) bones.fail("names a node that is not there");
            motion.names[node] = name;
            motion.is_bone[node] = true;
        }
        return true;
    }
    return false;
}

/// The bones of a scene, and what an animation of this name moves; empty: none.
detail::SceneMotion read_gltf_motion(std::string_view content, const std::string& animation,
                                     const detail::LoadCompanion& load) {
    const detail::GltfFile file = detail::open_gltf(content);
    detail::GltfData data(file, content.size(), load);
    detail::SceneMotion motion;
    motion.nodes = detail::read_nodes(file).nodes;
    if (!animation.empty()) motion.channels = detail::read_animation(data, animation);
    motion.is_bone.resize(motion.nodes.size(), false);
    for (std::size_t n = 0; n < motion.nodes.size(); ++n) {
        const auto name = file.root().at("nodes")[n].find("name");
        motion.names.push_back(name ? name->text() : "node" + std::to_string(n));
    }
    if (name_human_bones(motion, file)) return motion;
    for (const detail::AnimationChannel& channel : motion.channels)
        if (channel.property != detail::AnimatedProperty::weights) motion.is_bone[channel.node] = true;
    for (std::size_t s = 0; s < file.count("skins"); ++s) {
        const GltfValue joints = file.root().at("skins")[s].at("joints");
        for (std::size_t j = 0; j < joints.size(); ++j) {
            const std::size_t node = joints[j].whole_number();
            if (node >= motion.nodes.size()) joints.fail("names a node that is not there");
            motion.is_bone[node] = true;
        }
    }
    return motion;
}

/// What a scene has, by its content; none where it is no scene.
std::optional<MotionClip> parse_scene(std::string_view content, const detail::ClipOfScene& wanted,
                                      const detail::LoadCompanion& load) {
    if (detail::is_glb(content) || detail::is_gltf_json(content))
        return detail::clip_of(read_gltf_motion(content, wanted.animation, load), wanted.time);
    if (detail::is_fbx(content)) return detail::import_clip(content, MeshFormat::fbx, wanted);
    if (detail::is_collada(content)) return detail::import_clip(content, MeshFormat::dae, wanted);
    return std::nullopt;
}

MotionClip parse(std::string_view stored, bool isolated, const detail::LoadCompanion& load) {
    std::string storage;
    const std::string_view content = detail::plain_content(stored, storage);
    try {
        if (auto clip = parse_scene(content, {"1", std::nullopt, isolated}, load)) return *std::move(clip);
    } catch (const Error& error) { // of a scene without animations, too: it is the file that lacks them
        throw Error(ErrorCode::bad_input, detail::valid_utf8(error.what()));
    }
    return parse_bvh(stored);
}

} // namespace

MotionClip parse_clip(std::string_view content, bool isolated) {
    return parse(content, isolated, detail::refuse_companion);
}

MotionClip read_clip(const std::filesystem::path& path, bool isolated) {
    const std::string content = read_file(path);
    return parse(content, isolated, [folder = path.parent_path()](const std::string& reference) {
        return detail::read_companion(folder, reference);
    });
}

std::optional<MotionClip> read_rig(const std::filesystem::path& path, const ReadMeshOptions& options) {
    const std::string content = read_file(path);
    std::string storage;
    const auto load = [folder = path.parent_path()](const std::string& reference) {
        return detail::read_companion(folder, reference);
    };
    return parse_scene(detail::plain_content(content, storage), {options.animation, options.time, options.isolated},
                       load);
}

} // namespace skelgen::io
