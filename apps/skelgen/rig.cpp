#include <map>
#include <memory>

#include <skelgen/io/rig_formats.hpp>

#include "character.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "fitted_file.hpp"
#include "waiting_line.hpp"

namespace skelgen::cli {
namespace {

using applications::RestPose;

struct RigCommand {
    MeshInput mesh;
    std::string output;
    std::string names = "skelgen";
    std::string rest; ///< empty: as the format wants it
    std::string fingers = "auto";
    int component = 0;
    bool quiet = false;
};

const std::map<std::string, RestPose> rest_poses{
    {"as-is", RestPose::as_is}, {"t-pose", RestPose::t_pose}, {"a-pose", RestPose::a_pose}};

/// The wanted rest pose; by default as the body is, but for VRM, which knows the T-pose alone.
RestPose rest_pose(const RigCommand& command, io::RigFormat format) {
    const bool is_vrm = format == io::RigFormat::vrm;
    if (command.rest.empty()) return is_vrm ? RestPose::t_pose : RestPose::as_is;
    const RestPose rest = rest_poses.at(command.rest);
    if (is_vrm && rest != RestPose::t_pose)
        throw Error(ErrorCode::usage, "--rest " + command.rest + ": VRM's rest pose is the T-pose; leave it out");
    return rest;
}

void run(const RigCommand& command) {
    require_different_files(command.mesh.file, command.output);
    require_folder_of(command.output);
    const auto format = io::rig_format_of(command.output);
    if (!format) throw Error(ErrorCode::usage, command.output + ": its name must end in .glb, .vrm or .bvh");
    const CharacterOptions options{command.component, rest_pose(command, *format),
                                   fingers_by_name().at(command.fingers)};
    const Character character = in_file(command.mesh.file, [&] {
        const WaitingLine waiting(command.mesh.file.string(), !command.quiet);
        return make_character(command.mesh, options);
    });
    in_file(command.output, [&] {
        write_rig(command.output, character.rig, *io::joint_names_named(command.names), character.kept.looks);
    });
    if (!command.quiet) print_warnings(command.mesh.file, character);
}

} // namespace

void add_rig_command(CLI::App& app) {
    auto command = std::make_shared<RigCommand>();
    CLI::App* sub = app.add_subcommand("rig", "Bind the mesh of a body to its skeleton: a character that moves");
    add_mesh_input(*sub, command->mesh, "Mesh of one body");
    sub->add_option("-o,--output", command->output, "Character (.glb, .vrm) or skeleton alone (.bvh) to write")
        ->required();
    add_joint_names_option(*sub, command->names, "Whose names the joints get; VRM's own in .vrm");
    sub->add_option("--rest", command->rest, "Pose at rest: as-is, or un-posed (default: as-is; in .vrm t-pose)")
        ->check(CLI::IsMember({"as-is", "t-pose", "a-pose"}));
    sub->add_option("--fingers", command->fingers, "Bones of the fingers: where the surface shows some, or none")
        ->check(CLI::IsMember({"auto", "off", "on"}))
        ->capture_default_str();
    add_component_option(*sub, command->component);
    sub->add_flag("-q,--quiet", command->quiet, "No warnings");
    sub->footer("Examples:\n  skelgen rig body.off -o body.glb\n"
                "  skelgen rig scan.ply -o avatar.vrm\n"
                "  skelgen rig body.off -o body.glb --rest t-pose --names mixamo");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
