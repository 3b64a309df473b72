#include <memory>
#include <string>
#include <utility>

#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/rig_formats.hpp>

#include "character.hpp"
#include "clip_input.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "fitted_file.hpp"
#include "waiting_line.hpp"

namespace skelgen::cli {
namespace {

struct AnimateCommand {
    MeshInput mesh;
    std::string clip;
    std::string output;
    std::string names = "skelgen";
    BoneOptions bones;
    int component = 0;
    bool quiet = false;
};

void run(const AnimateCommand& command) {
    require_different_files(command.mesh.file, command.output);
    require_folder_of(command.output);
    require_different_files(command.clip, command.output);
    const auto format = io::rig_format_of(command.output);
    if (format != io::RigFormat::glb && format != io::RigFormat::fbx)
        throw Error(ErrorCode::usage, command.output + ": its name must end in .glb or .fbx");
    const ClipInput clip = load_clip(command.clip); // what is wrong with it is to be said before the long work
    const Character character = in_file(command.mesh.file, [&] {
        const WaitingLine waiting(command.mesh.file.string(), !command.quiet);
        return make_character(command.mesh, {command.component});
    });
    auto animation = follow_clip(clip, character.rig);
    const auto rig = applications::with_engine_bones(character.rig, command.bones.wanted());
    animation = applications::with_engine_bones(std::move(animation), character.rig, rig);
    const auto names = *io::joint_names_named(command.names);
    const auto write = format == io::RigFormat::fbx ? io::rig_to_fbx : io::rig_to_glb;
    in_file(command.output,
            [&] { io::write_file_atomically(command.output, write(rig, names, character.kept.looks, {animation})); });
    print_warnings(command.mesh.file, character, *format, command.quiet);
}

} // namespace

void add_animate_command(CLI::App& app) {
    auto command = std::make_shared<AnimateCommand>();
    CLI::App* sub = app.add_subcommand("animate", "Have a body move as a recorded skeleton does");
    add_mesh_input(*sub, command->mesh, "Mesh of one body");
    sub->add_option(
           "--clip,--bvh", command->clip,
           "Motion to follow: a BVH file, or the first animation of an FBX, GLB, glTF, VRMA or DAE. Any skeleton\n"
           "whose joints have common names (Mixamo, MotionBuilder, VRM, SMPL, Biovision, Poser, Biped, Unreal,\n"
           "...), in any rest pose and unit")
        ->required();
    sub->add_option("-o,--output", command->output,
                    "Character to write, with the motion as its animation: .glb or .fbx")
        ->required();
    add_joint_names_option(*sub, command->names, "Whose names the joints get");
    add_bone_options(*sub, command->bones);
    add_component_option(*sub, command->component);
    add_skeleton_options(*sub, command->mesh);
    sub->add_flag("-q,--quiet", command->quiet, "No warnings but what a licence forbids, and guesses");
    sub->footer("Example:\n  skelgen animate body.off --bvh walk.bvh -o walking.glb");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
