#include <memory>
#include <string>

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
    int component = 0;
    bool quiet = false;
};

void run(const AnimateCommand& command) {
    require_different_files(command.mesh.file, command.output);
    require_folder_of(command.output);
    require_different_files(command.clip, command.output);
    if (io::rig_format_of(command.output) != io::RigFormat::glb)
        throw Error(ErrorCode::usage, command.output + ": its name must end in .glb");
    const ClipInput clip = load_clip(command.clip); // what is wrong with it is to be said before the long work
    const Character character = in_file(command.mesh.file, [&] {
        const WaitingLine waiting(command.mesh.file.string(), !command.quiet);
        return make_character(command.mesh, {command.component});
    });
    const auto animation = follow_clip(clip, character.rig);
    const auto names = *io::joint_names_named(command.names);
    in_file(command.output, [&] {
        io::write_file_atomically(command.output, rig_to_glb(character.rig, names, character.kept.looks, {animation}));
    });
    print_warnings(command.mesh.file, character, io::RigFormat::glb, command.quiet);
}

} // namespace

void add_animate_command(CLI::App& app) {
    auto command = std::make_shared<AnimateCommand>();
    CLI::App* sub = app.add_subcommand("animate", "Have a body move as a recorded skeleton does");
    add_mesh_input(*sub, command->mesh, "Mesh of one body");
    sub->add_option("--bvh", command->clip,
                    "Motion to follow, a BVH file: any skeleton whose joints are named as is common (Mixamo,\n"
                    "MotionBuilder, VRM, SMPL, Biovision, Poser, Biped, Unreal, ...), in any rest pose and unit")
        ->required();
    sub->add_option("-o,--output", command->output, "Character to write, with the motion as its animation: .glb")
        ->required();
    add_joint_names_option(*sub, command->names, "Whose names the joints get");
    add_component_option(*sub, command->component);
    add_skeleton_option(*sub, command->mesh.skeleton);
    sub->add_flag("-q,--quiet", command->quiet, "No warnings but what a licence forbids, and guesses");
    sub->footer("Example:\n  skelgen animate body.off --bvh walk.bvh -o walking.glb");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
