#include <memory>
#include <string>

#include <skelgen/applications/rig.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/rig_formats.hpp>

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

struct Character {
    applications::Rig<double> rig;
    io::SceneLooks looks;
    KinematicSkeleton<double> skeleton;
};

Character make_character(const AnimateCommand& command) {
    const WaitingLine waiting(command.mesh.file.string(), !command.quiet);
    ExtractOptions options;
    options.prepare.component = command.component;
    const FittedFile body = fit_file(command.mesh, options);
    const SkeletonTemplate& human = builtin_template(body.skeleton().template_name);
    return {applications::make_rig(body.mesh, body.found.body, body.skeleton(), human), load_looks(command.mesh),
            body.skeleton()};
}

void run(const AnimateCommand& command) {
    require_different_files(command.mesh.file, command.output);
    require_different_files(command.clip, command.output);
    if (io::rig_format_of(command.output) != io::RigFormat::glb)
        throw Error(ErrorCode::usage, command.output + ": its name must end in .glb");
    const Character character = in_file(command.mesh.file, [&] { return make_character(command); });
    const auto animation = follow_clip(command.clip, character.rig);
    const auto names = *io::joint_names_named(command.names);
    in_file(command.output, [&] {
        io::write_file_atomically(command.output, rig_to_glb(character.rig, names, character.looks, {animation}));
    });
    if (!command.quiet) print_warnings(command.mesh.file, character.skeleton);
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
    sub->add_option("--names", command->names, "Whose names the joints get")
        ->check(CLI::IsMember({"skelgen", "smpl", "mixamo", "vrm"}))
        ->capture_default_str();
    sub->add_option("--component", command->component, "Which of several bodies that stand apart; 1 is the largest")
        ->check(CLI::Range(1, 1000));
    sub->add_flag("-q,--quiet", command->quiet, "No warnings");
    sub->footer("Example:\n  skelgen animate body.off --bvh walk.bvh -o walking.glb");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
